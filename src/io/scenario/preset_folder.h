// preset_folder.h -- where the presets are.

#pragma once

#include <filesystem>

namespace insonify {

/// The folder that INSONIFY_PRESETS names; else the one installed with this library, wherever its installation has been
/// moved to; else that of the source tree it was built from.
/// @throws Error where INSONIFY_PRESETS names no folder.
[[nodiscard]] std::filesystem::path preset_folder();

}  // namespace insonify

// output_folder.h -- the folder that a run writes into.

#pragma once

#include <filesystem>

namespace insonify {

/// The one that was chosen, or else the scenario's name + _pings; it need not be there yet.
/// @throws Error where it cannot be made or written to. Asked before the world is loaded, which can take long.
[[nodiscard]] std::filesystem::path output_folder(const std::filesystem::path& chosen,
                                                  const std::filesystem::path& scenario);

/// @throws Error
void make_output_folder(const std::filesystem::path& folder);

}  // namespace insonify

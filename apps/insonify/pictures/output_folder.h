// output_folder.h -- chooses and checks the folder that a run writes to.

#pragma once

#include <filesystem>

namespace insonify {

/// The requested folder, or the scenario's name + "_pings"; it need not exist yet.
/// @throws Error if it cannot be made or written to. Checked before the world is loaded, which can take long.
[[nodiscard]] std::filesystem::path output_folder(const std::filesystem::path& chosen,
                                                  const std::filesystem::path& scenario);

/// @throws Error
void make_output_folder(const std::filesystem::path& folder);

}  // namespace insonify

// recorded_folders.h -- where the files of a recorded scenario may be.

#pragma once

#include <filesystem>
#include <span>
#include <vector>

namespace insonify {

/// Folders that file names in the scenario may be relative to: `folder` only, or where that is empty those of the
/// recordings, their parents and the current one.
[[nodiscard]] std::vector<std::filesystem::path> recorded_folders(std::span<const std::filesystem::path> recordings,
                                                                  const std::filesystem::path& folder);

}  // namespace insonify

// recorded_folders.cpp -- lists folders without repeating one.

#include "pictures/recorded_folders.h"

#include <algorithm>

namespace insonify {

std::vector<std::filesystem::path> recorded_folders(std::span<const std::filesystem::path> recordings,
                                                    const std::filesystem::path& folder) {
  if (!folder.empty()) {
    return {folder};
  }
  std::vector<std::filesystem::path> folders;
  const auto add = [&](const std::filesystem::path& one) {
    if (std::ranges::find(folders, one) == folders.end()) {
      folders.push_back(one);
    }
  };
  for (const std::filesystem::path& recording : recordings) {
    const std::filesystem::path beside = std::filesystem::absolute(recording).lexically_normal().parent_path();
    add(beside);
    add(beside.parent_path());
  }
  add(std::filesystem::current_path());
  return folders;
}

}  // namespace insonify

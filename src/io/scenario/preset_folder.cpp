// preset_folder.cpp -- folders from the environment, and the shipped one.

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>
#include <string>

#include "insonify/error.h"
#include "io/scenario/preset_file.h"
#include "io/scenario/shipped_folder.h"
#include "io/scenario/yaml_value.h"

namespace insonify {
namespace {

// The entries of INSONIFY_PRESETS without empty ones, as in "a::b" or after a final colon.
std::vector<std::filesystem::path> own_folders() {
  std::vector<std::filesystem::path> folders;
  const char* variable = std::getenv("INSONIFY_PRESETS");
  std::istringstream list(variable == nullptr ? "" : variable);
  for (std::string entry; std::getline(list, entry, ':');) {
    std::error_code ignored;
    if (!entry.empty() && !std::filesystem::is_directory(entry, ignored)) {
      throw Error(fmt::format("INSONIFY_PRESETS = {} must be a folder of presets", quoted_text(entry)));
    }
    if (!entry.empty()) {
      folders.emplace_back(entry);
    }
  }
  return folders;
}

}  // namespace

std::vector<std::filesystem::path> preset_folders() {
  std::vector<std::filesystem::path> folders = own_folders();
  folders.push_back(shipped_folder("presets"));
  return folders;
}

std::filesystem::path find_preset_file(const std::string& name) {
  for (const std::filesystem::path& folder : preset_folders()) {
    std::error_code ignored;
    if (std::filesystem::path file = folder / (name + ".yaml"); std::filesystem::exists(file, ignored)) {
      return file;
    }
  }
  return {};
}

}  // namespace insonify

// scene_files.cpp -- looks up shipped scenes in their folder.

#include "insonify/scene_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "base/names.h"
#include "insonify/error.h"
#include "io/scenario/shipped_folder.h"

namespace insonify {

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(shipped_folder("scenes"), ignored)) {
    if (entry.path().extension() == ".yaml") {
      names.push_back(entry.path().stem().string());
    }
  }
  std::ranges::sort(names);
  return names;
}

std::filesystem::path scenario_file(const std::filesystem::path& scenario) {
  std::error_code ignored;
  if (scenario.empty() || scenario.has_parent_path() || scenario.has_extension() ||
      std::filesystem::exists(std::filesystem::symlink_status(scenario, ignored))) {
    return scenario;
  }
  const std::vector<std::string> names = scene_names();
  const std::string name = scenario.string();
  if (names.empty()) {
    return scenario;
  }
  if (std::ranges::find(names, name) == names.end()) {
    const std::string hint = suggestion(name, names);
    throw Error(fmt::format("{}: no such file, nor a scene that comes with insonify{}", name,
                            hint.empty() ? " (insonify scenes lists them)" : hint));
  }
  return shipped_folder("scenes") / (name + ".yaml");
}

std::string scene_title(const std::string& name) {
  std::ifstream file(shipped_folder("scenes") / (name + ".yaml"));
  std::string line;
  std::getline(file, line);
  if (!line.starts_with("# ")) {
    return "";
  }
  return line.substr(2, std::min(line.find(": "), line.find_last_not_of(".") + 1) - 2);
}

}  // namespace insonify

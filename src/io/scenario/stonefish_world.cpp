// stonefish_world.cpp -- writes the sonars of a Stonefish scenario into the tree of one of ours.

#include "io/scenario/stonefish_world.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <utility>
#include <vector>

#include "base/log_line.h"
#include "insonify/files.h"
#include "insonify/printable.h"
#include "io/file/input_file.h"
#include "io/scenario/world_sonars.h"
#include "io/stonefish/stonefish_sonars.h"

namespace insonify {
namespace {

namespace fs = std::filesystem;
using Kind = YamlValue::Kind;

// One sonar as an entry of `sonars`, all of it at the place of its sensor.
YamlValue entry_of(const StonefishSonar& from) {
  Scenario only;
  only.model = EchoModel::kPaper;  // So that the gain is written.
  only.sonars = {from.sonar};
  const YamlValue tree = parse_yaml(to_yaml(only), from.place.file);
  YamlValue entry = tree.find("sonars")->items.front();
  set_place(entry, from.place);
  return entry;
}

}  // namespace

bool is_stonefish_file(const fs::path& path) {
  return ending_of(path) == ".scn";
}

bool add_stonefish_sonars(YamlValue& scenario, const fs::path& path, std::span<const std::string> settings,
                          const Log& log) {
  const std::string world = world_of_scenario(scenario, settings);
  if (scenario.kind != Kind::kMap || !is_stonefish_file(world) || is_given(scenario, "sonars")) {
    return false;
  }
  const fs::path file = (is_stream(path) ? fs::path() : path.parent_path()) / world;
  const StonefishSonars found = load_stonefish_sonars(file, is_given(scenario, "trajectory"));
  if (found.sonars.empty()) {
    throw Error(
        fmt::format("{}: has no sensor of type fls, msis or sss; list sonars in a scenario that says world: {}{}",
                    file.string(), printable(world, kLongestName),
                    found.missing.empty() ? "" : "; missing parts may be the cause: " + found.missing));
  }
  YamlValue sonars;
  sonars.kind = Kind::kList;
  sonars.place = found.sonars.front().place;
  std::vector<std::string> names;
  for (const StonefishSonar& sonar : found.sonars) {
    sonars.items.push_back(entry_of(sonar));
    names.push_back(printable(sonar.sonar.name));
  }
  std::erase_if(scenario.entries, [](const YamlValue::Entry& entry) { return entry.key == "sonars"; });
  scenario.entries.push_back({"sonars", std::move(sonars)});
  log_line(log, Severity::kInfo,
           fmt::format("{}: sonars after its sensors: {}; insonify's own receiver makes their noise", file.string(),
                       fmt::join(names, ", ")));
  return true;
}

void remove_idle_stonefish_gains(YamlValue& scenario) {
  const YamlValue* model = scenario.find("model");
  YamlValue* sonars = scenario.find("sonars");
  if (sonars == nullptr || (model != nullptr && model->scalar == "paper")) {
    return;
  }
  for (YamlValue& sonar : sonars->items) {
    std::erase_if(sonar.entries, [](const YamlValue::Entry& entry) {
      return entry.key == "gain" && is_stonefish_file(entry.value.place.file);
    });
  }
}

}  // namespace insonify

// scenes.cpp -- insonify scenes: lists the scenes that come with it.

#include <algorithm>
#include <string_view>

#include "console/commands.h"
#include "console/console.h"
#include "console/outcome.h"
#include "insonify/error.h"
#include "insonify/scene_files.h"

namespace insonify {
namespace {

constexpr std::string_view kTwin = "_calibrated";

// Scenes of the paper's model have twins in the default one.
std::string shown_title(const std::string& name, const std::vector<std::string>& names) {
  const bool is_twin =
      name.ends_with(kTwin) && std::ranges::find(names, name.substr(0, name.size() - kTwin.size())) != names.end();
  return is_twin ? "the same in the calibrated model" : scene_title(name);
}

int list_scenes() {
  return checked_input([] {
    const std::vector<std::string> names = scene_names();
    if (names.empty()) {
      throw Error("no scenes were installed with insonify");
    }
    std::vector<Row> rows;
    for (const std::string& name : names) {
      rows.push_back({name, shown_title(name, names)});
    }
    print_table(rows);
    say("\nEach is a scenario, to be run or served by its name. Their files, to copy and change: {}\n",
        scenario_file(names.front()).parent_path().string());
    return kDone;
  });
}

}  // namespace

void add_scenes(const Command& program) {
  const Command command = program.add("scenes", "List the scenes that come with insonify");
  command.footer(
      "Examples:\n"
      "  insonify scenes\n"
      "  insonify run ferry -o ferry");
  command.act(list_scenes);
}

}  // namespace insonify

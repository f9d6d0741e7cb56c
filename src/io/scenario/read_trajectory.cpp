// read_trajectory.cpp -- waypoints in a scenario or in a file of its own.

#include "io/scenario/read_trajectory.h"

#include "insonify/files.h"
#include "io/file/input_file.h"
#include "io/scenario/track_choice.h"

namespace insonify {

void read_part(const YamlValue& value, const std::string& name, const Part& part, std::vector<Waypoint>& waypoints,
               Places& places) {
  const bool is_file = value.find("file") != nullptr || value.find("start") != nullptr;
  if (value.kind != YamlValue::Kind::kScalar && !is_file) {
    read_part<Waypoint>(value, name, part, waypoints, places);
    return;
  }
  TrackChoice choice;
  if (value.kind == YamlValue::Kind::kScalar) {
    read_member(value, "", Field{name, "", {}, ""}, choice.file);
  } else {
    read_section(value, name, choice, places);
    if (choice.file.empty()) {
      throw Error(name, "file", " is missing: a CSV or TUM file of waypoints").at(value.place);
    }
  }
  const std::filesystem::path scenario = places[""].file;
  const std::filesystem::path folder = is_stream(scenario) ? std::filesystem::path() : scenario.parent_path();
  with_place(value.place, [&] { waypoints = load_trajectory(folder / choice.file).waypoints; });
  for (Waypoint& waypoint : waypoints) {
    waypoint.time -= choice.start;
  }
}

}  // namespace insonify

// recorded_bed.cpp -- finds the world of recordings, and its heights.

#include "grid/recorded_bed.h"

#include <fmt/format.h>

#include <algorithm>

#include "insonify/error.h"
#include "insonify/files.h"
#include "insonify/recording_info.h"
#include "insonify/stored_tables.h"
#include "pictures/recorded_folders.h"

namespace insonify {
namespace {

// A world that has changed since is not the truth. A sea surface, which a simulation adds, comes last.
bool has_the_same_objects(const Scene& scene, const std::vector<std::string>& recorded) {
  return recorded.empty() ||
         (recorded.size() >= scene.instances.size() &&
          std::ranges::equal(scene.instances, std::span(recorded).first(scene.instances.size()), {}, &Instance::name));
}

// Recordings of one world may differ in all else, such as the lines that were flown.
std::string other_world(std::span<const std::filesystem::path> recordings, const Scenario& first,
                        const std::filesystem::path& folder) {
  for (const std::filesystem::path& recording : recordings.subspan(1)) {
    const std::string text = recording_info(recording).scenario;
    if (text.empty() || parse_scenario(text, folder).world != first.world) {
      return fmt::format("{} and {} are of different worlds", recordings.front().string(), recording.string());
    }
  }
  return "";
}

}  // namespace

RecordedBed recorded_bed(std::span<const std::filesystem::path> recordings, const std::string& sonar,
                         const std::filesystem::path& folder) {
  RecordedBed bed;
  const std::string text = recording_info(recordings.front()).scenario;
  if (text.empty()) {
    return bed;
  }
  const std::vector<std::string> names = StoredTables(recordings.front(), sonar).texts("instance_names");
  for (const std::filesystem::path& base : recorded_folders(recordings, folder)) {
    try {
      Scenario scenario = parse_scenario(text, base);
      bed.scenario = bed.scenario ? bed.scenario : scenario;
      Scene scene = load_scene(scenario);
      bed.scenario = std::move(scenario);
      bed.why = has_the_same_objects(scene, names)
                    ? other_world(recordings, *bed.scenario, base)
                    : fmt::format("the world in {} has other objects than the recording", base.string());
      if (bed.why.empty()) {
        bed.scene = std::move(scene);
      }
      return bed;
    } catch (const Error& error) {
      bed.why = bed.why.empty() ? error.what() : bed.why;
    }
  }
  return bed;
}

}  // namespace insonify

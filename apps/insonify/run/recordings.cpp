// recordings.cpp -- writes each ping to every recording of its sonar.

#include "run/recordings.h"

#include <algorithm>
#include <span>

namespace insonify {

RecordKinds record_kinds(const std::string& text) {
  RecordKinds kinds;
  for (const RecordingFormat& format : recording_formats()) {
    if (text.find(format.name) != std::string::npos) {
      kinds.push_back(&format);
    }
  }
  return kinds;
}

std::vector<std::string> record_choices() {
  std::vector<std::string> choices;
  for (const RecordingFormat& format : recording_formats()) {
    choices.emplace_back(format.name);
  }
  for (const RecordingFormat& first : recording_formats()) {
    for (const RecordingFormat& second : recording_formats()) {
      if (first.name != second.name) {
        choices.push_back(std::string(first.name) + "," + std::string(second.name));
      }
    }
  }
  return choices;
}

std::vector<std::string> endings_of(const RecordKinds& kinds) {
  std::vector<std::string> endings;
  std::ranges::transform(kinds, std::back_inserter(endings), [](const auto* format) { return format->ending(); });
  return endings;
}

SonarRecordings::SonarRecordings(const std::filesystem::path& folder, const Simulator& simulator, int sonar,
                                 const RecordKinds& kinds, const RecordOptions& options) {
  const SonarConfig& config = simulator.sonar(sonar);
  for (const RecordingFormat* format : kinds) {
    files_.push_back(folder / (config.name + format->ending()));
    sinks_.push_back(format->open(files_.back(), {simulator.scenario(), simulator.scene(), {&config, 1}}, options));
  }
}

void SonarRecordings::add(const Ping& ping) {
  for (const auto& sink : sinks_) {
    sink->add(0, ping);
  }
}

void SonarRecordings::close() {
  for (const auto& sink : sinks_) {
    sink->close();
  }
}

std::vector<std::filesystem::path> SonarRecordings::places() const {
  std::vector<std::filesystem::path> places;
  std::ranges::transform(sinks_, std::back_inserter(places), [](const auto& sink) { return sink->place(); });
  return places;
}

}  // namespace insonify

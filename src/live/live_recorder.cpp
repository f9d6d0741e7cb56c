// live_recorder.cpp -- names and writes the recordings of a run.

#include "live/live_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "insonify/error.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

// PATH with something put before its ending.
std::filesystem::path with_suffix(const std::filesystem::path& path, const std::string& suffix) {
  return path.parent_path() / (path.stem().string() + suffix + path.extension().string());
}

}  // namespace

std::vector<std::filesystem::path> live_recording_files(const std::filesystem::path& path,
                                                        std::span<const SonarConfig> sonars) {
  std::vector<std::filesystem::path> files;
  if (path.extension() == ".mcap" || sonars.size() == 1) {
    files.push_back(path);
  } else {
    for (const SonarConfig& sonar : sonars) {
      files.push_back(with_suffix(path, "-" + sonar.name));
    }
  }
  files.push_back(std::filesystem::path(path).replace_extension(".yaml"));
  return files;
}

LiveRecorder::LiveRecorder(const std::filesystem::path& path, int part, const LiveWorld& world, bool replace) {
  const std::filesystem::path base = part == 0 ? path : with_suffix(path, fmt::format("-{}", part + 1));
  const std::string ending = base.extension().string();
  if (ending != ".h5" && ending != ".mcap") {
    throw Error(fmt::format("{}: recordings end in .h5 or .mcap", base.string()));
  }
  paths_ = live_recording_files(base, world.sonars);
  for (const std::filesystem::path& file : paths_) {
    if (!replace && std::filesystem::exists(file)) {
      throw Error(fmt::format("{} is there already", file.string()));
    }
  }
  scenario_path_ = paths_.back();
  paths_.pop_back();
  if (ending == ".mcap") {
    std::vector<MessageSource> sources;
    for (const SonarConfig& sonar : world.sonars) {
      sources.push_back(message_source(world.scenario, sonar));
    }
    const McapOptions options{.run = {.engine = world.scenario.engine, .seed = world.scenario.seed},
                              .replace = replace};
    mcap_.emplace(base, std::move(sources), options);
  } else {
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      recordings_.emplace_back(paths_[i], world.scenario, world.scene, world.sonars[i],
                               RecordingOptions{.replace = replace});
    }
  }
}

void LiveRecorder::add(const LivePing& ping) {
  const auto sonar = static_cast<std::size_t>(ping.sonar);
  if (mcap_) {
    mcap_->add(sonar, ping.ping);
  } else {
    recordings_[sonar].add(ping.ping);
  }
  ++pings_;
}

// Removes files without a ping. Those that they were to replace stay.
void LiveRecorder::remove() {
  std::vector<std::filesystem::path> places;
  std::ranges::transform(recordings_, std::back_inserter(places), &Recording::place);
  if (mcap_) {
    places.push_back(mcap_->place());
  }
  recordings_.clear();
  mcap_.reset();
  for (const std::filesystem::path& place : places) {
    std::filesystem::remove(place);
  }
}

void LiveRecorder::close(const LiveRun& run) {
  if (pings_ == 0) {
    remove();
    return;
  }
  std::string error;
  const auto try_to_close = [&error](auto& recording) {
    try {
      recording.close();
    } catch (const Error& failure) {
      error = error.empty() ? failure.what() : error;
    }
  };
  std::ranges::for_each(recordings_, try_to_close);
  if (mcap_) {
    try_to_close(*mcap_);
  }
  std::ofstream file(scenario_path_);
  file << to_yaml(run.saved());
  if (!file.flush()) {
    throw Error(fmt::format("{}: cannot be written", scenario_path_.string()));
  }
  if (!error.empty()) {
    throw Error(error);
  }
}

LiveRecording LiveRecorder::recording() const {
  LiveRecording recording{.files = paths_, .scenario = scenario_path_, .pings = pings_};
  for (std::size_t i = 0; pings_ > 0 && i < paths_.size(); ++i) {
    std::error_code gone;
    const std::uintmax_t bytes = std::filesystem::file_size(paths_[i], gone);
    recording.bytes += gone ? 0 : bytes;
  }
  return recording;
}

std::string LiveRecorder::names() const {
  std::string names;
  for (const std::filesystem::path& path : paths_) {
    names += (names.empty() ? "" : ", ") + path.string();
  }
  return names;
}

}  // namespace insonify

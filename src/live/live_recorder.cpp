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

LiveRecorder::LiveRecorder(const std::filesystem::path& path, int part, const LiveWorld& world) {
  const std::filesystem::path base = part == 0 ? path : with_suffix(path, fmt::format("-{}", part + 1));
  const std::string ending = base.extension().string();
  if (ending != ".h5" && ending != ".mcap") {
    throw Error(fmt::format("{}: recordings end in .h5 or .mcap", base.string()));
  }
  scenario_path_ = base;
  scenario_path_.replace_extension(".yaml");
  if (std::filesystem::exists(scenario_path_)) {
    throw Error(fmt::format("{}: is there already", scenario_path_.string()));
  }
  if (ending == ".mcap") {
    paths_.push_back(base);
  } else {
    for (const SonarConfig& sonar : world.sonars) {
      paths_.push_back(world.sonars.size() == 1 ? base : with_suffix(base, "-" + sonar.name));
    }
  }
  for (const std::filesystem::path& file : paths_) {
    if (std::filesystem::exists(file)) {
      throw Error(fmt::format("{}: is there already", file.string()));
    }
  }
  if (ending == ".mcap") {
    std::vector<MessageSource> sources;
    for (const SonarConfig& sonar : world.sonars) {
      sources.push_back(message_source(world.scenario, sonar));
    }
    const McapOptions options{.run = {.engine = world.scenario.engine, .seed = world.scenario.seed}};
    mcap_.emplace(base, std::move(sources), options);
  } else {
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      recordings_.emplace_back(paths_[i], world.scenario, world.scene, world.sonars[i]);
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

void LiveRecorder::close(const LiveRun& run) {
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
  if (pings_ == 0) {
    for (const std::filesystem::path& path : paths_) {
      std::filesystem::remove(path);
    }
    return;
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

std::string LiveRecorder::names() const {
  std::string names;
  for (const std::filesystem::path& path : paths_) {
    names += (names.empty() ? "" : ", ") + path.string();
  }
  return names;
}

}  // namespace insonify

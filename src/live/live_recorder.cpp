// live_recorder.cpp -- names and writes the recordings of a run.

#include "live/live_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "insonify/recording_info.h"
#include "io/file/unfinished_file.h"

namespace insonify {
namespace {

// A path with a suffix before its extension.
std::filesystem::path with_suffix(const std::filesystem::path& path, const std::string& suffix) {
  return path.parent_path() / (path.stem().string() + suffix + path.extension().string());
}

// Replaces a file by a text, or leaves it unchanged on failure.
void write_text(const std::filesystem::path& path, const std::string& text) {
  UnfinishedFile file(path, "cannot be written");
  if (!write_at(file.descriptor(), 0, std::as_bytes(std::span(text)))) {
    file.fail_by_errno();
  }
  file.put_in_place();
}

}  // namespace

std::vector<std::filesystem::path> live_recording_files(const std::filesystem::path& path,
                                                        std::span<const SonarConfig> sonars) {
  std::vector<std::filesystem::path> files;
  const RecordingFormat* const format = recording_format(path);
  if (sonars.size() == 1 || (format != nullptr && format->holds_all)) {
    files.push_back(path);
  } else {
    for (const SonarConfig& sonar : sonars) {
      files.push_back(with_suffix(path, "-" + sonar.name));
    }
  }
  files.push_back(std::filesystem::path(path).replace_extension(".yaml"));
  return files;
}

LiveRecorder::LiveRecorder(const std::filesystem::path& path, int part, const LiveWorld& world, bool replace,
                           const MessageOptions& messages, const Log& log) {
  const std::filesystem::path base = part == 0 ? path : with_suffix(path, fmt::format("-{}", part + 1));
  if (recording_format(base) == nullptr) {
    throw Error(fmt::format("{}: recordings end in {}", base.string(), recording_names(".", " or ")));
  }
  paths_ = live_recording_files(base, world.sonars);
  for (const std::filesystem::path& file : paths_) {
    if (!replace && std::filesystem::exists(file)) {
      throw Error(fmt::format("{} exists already", file.string()));
    }
  }
  scenario_path_ = paths_.back();
  paths_.pop_back();
  scenario_is_earlier_ = std::filesystem::exists(scenario_path_);
  try {
    begin(world, replace, messages, log);
  } catch (const Error&) {
    remove();  // Files of the preceding sonars.
    throw;
  }
}

void LiveRecorder::begin(const LiveWorld& world, bool replace, const MessageOptions& messages, const Log& log) {
  const RecordingFormat& format = *recording_format(paths_.front());
  const RecordOptions options{.h5 = {.replace = replace},
                              .mcap = {.messages = messages, .log = log, .replace = replace}};
  const std::span<const SonarConfig> sonars = world.sonars;
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    const auto of_file = format.holds_all ? sonars : sonars.subspan(i, 1);
    sinks_.push_back(format.open(paths_[i], {world.scenario, world.scene, of_file}, options));
  }
}

void LiveRecorder::add(const LivePing& ping) {
  const auto sonar = static_cast<std::size_t>(ping.sonar);
  whole_ = false;  // Until it is written.
  const bool shared = sinks_.size() == 1;
  sinks_[shared ? 0 : sonar]->add(shared ? sonar : 0, ping.ping);
  whole_ = true;
  ++pings_;
}

std::vector<std::filesystem::path> LiveRecorder::places() const {
  std::vector<std::filesystem::path> places;
  std::ranges::transform(sinks_, std::back_inserter(places), [](const auto& sink) { return sink->place(); });
  return places;
}

// Removes files without a ping. Files that they were to replace stay.
void LiveRecorder::remove() {
  std::vector<std::filesystem::path> gone = places();
  gone.push_back(unfinished_path_);
  sinks_.clear();
  for (const std::filesystem::path& place : gone) {
    std::error_code ignored;
    std::filesystem::remove(place, ignored);
  }
  pings_ = 0;
}

// Counts the pings in the files if not all were written.
void LiveRecorder::count_what_is_there() {
  pings_ = 0;
  for (const std::filesystem::path& place : places()) {
    try {
      for (const RecordedSonar& sonar : recording_info(place).sonars) {
        pings_ += sonar.pings;
      }
    } catch (const Error&) {
      continue;  // Without a complete header.
    }
  }
}

bool LiveRecorder::scenario_is_due() const {
  return pings_ > 0 && Clock::now() >= scenario_due_;
}

void LiveRecorder::write_scenario(const LiveRun& run) {
  constexpr std::chrono::seconds kBetween(2);
  constexpr int kShare = 50;  // Long paths take long to write: at most 1/kShare of the time is spent on it.
  const Clock::time_point start = Clock::now();
  try {
    std::filesystem::path path = scenario_path_;
    if (const std::filesystem::path place = places().front(); place != paths_.front()) {
      path = std::filesystem::path(place).replace_extension(".yaml");
    }
    if (!scenario_is_earlier_ || path != scenario_path_) {
      write_text(path, to_yaml(run.saved()));
      unfinished_path_ = path;
    }
  } catch (const Error&) {  // close() reports it.
  }
  const Clock::duration taken = Clock::now() - start;
  scenario_due_ = Clock::now() + std::max<Clock::duration>(kBetween, kShare * taken);
}

void LiveRecorder::close(const LiveRun& run, const std::vector<Marker>& markers) {
  if (pings_ == 0) {
    remove();
    return;
  }
  std::string error;
  const auto try_to = [&error](auto&& act) {
    try {
      act();
    } catch (const Error& failure) {
      error = error.empty() ? failure.what() : error;
    }
  };
  for (const auto& sink : sinks_) {
    sink->mark(markers);
    try_to([&] { sink->close(); });
  }
  if (!whole_ || !error.empty()) {
    count_what_is_there();
    paths_ = places();
  }
  if (pings_ == 0) {
    remove();
  } else {
    try_to([&] { write_text(scenario_path_, to_yaml(run.saved())); });
    if (std::filesystem::exists(scenario_path_) && unfinished_path_ != scenario_path_) {
      std::error_code ignored;
      std::filesystem::remove(unfinished_path_, ignored);
    }
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

// recording_formats.cpp -- the formats of recordings: HDF5, a file a sonar, and MCAP.

#include "insonify/recording_formats.h"

#include <algorithm>

#include "io/file/input_file.h"

namespace insonify {
namespace {

std::unique_ptr<PingSink> open_h5(const std::filesystem::path& path, const RunToRecord& run,
                                  const RecordOptions& options) {
  return std::make_unique<Recording>(path, run.scenario, run.scene, run.sonars.front(), options.h5);
}

std::unique_ptr<PingSink> open_mcap(const std::filesystem::path& path, const RunToRecord& run,
                                    const RecordOptions& options) {
  std::vector<MessageSource> sources;
  for (const SonarConfig& sonar : run.sonars) {
    sources.push_back(message_source(run.scenario, sonar));
  }
  McapOptions mcap = options.mcap;
  mcap.run = run_facts(run.scenario, run.scene);
  return std::make_unique<McapRecording>(path, std::move(sources), mcap);
}

constexpr RecordingFormat kFormats[] = {
    {.name = "h5",
     .title = "HDF5",
     .contents = "the recording (HDF5): intensity [ping, bin, beam] and ground truth",
     .holds_all = false,
     .has_messages = false,
     .can_compress = true,
     .readable = true,
     .open = open_h5,
     .bytes = [](const Scenario& scenario, const SonarConfig& sonar, std::uint64_t pings,
                 const MessageOptions& /*messages*/) { return recording_bytes(scenario, sonar, pings); }},
    {.name = "mcap",
     .title = "MCAP",
     .contents = "ROS 2 messages: sonar image, fan, points, pose, scenario",
     .holds_all = true,
     .has_messages = true,
     .can_compress = false,  // It always is.
     .readable = true,
     .open = open_mcap,
     .bytes = [](const Scenario& /*scenario*/, const SonarConfig& sonar, std::uint64_t pings,
                 const MessageOptions& messages) { return mcap_bytes(sonar, pings, messages); }}};

}  // namespace

std::span<const RecordingFormat> recording_formats() {
  return kFormats;
}

const RecordingFormat* recording_format(const std::filesystem::path& file) {
  const std::string ending = ending_of(file);
  const auto found = std::ranges::find_if(kFormats, [&](const auto& format) { return format.ending() == ending; });
  return found == std::end(kFormats) ? nullptr : &*found;
}

bool is_recording(const std::filesystem::path& file) {
  const RecordingFormat* const format = recording_format(file);
  return format != nullptr ? format->readable : ending_of(file) == ".hdf5";
}

std::string recording_names(std::string_view before, std::string_view between, bool RecordingFormat::*which) {
  std::string names;
  for (const RecordingFormat& format : kFormats) {
    if (which == nullptr || format.*which) {
      names.append(names.empty() ? "" : between).append(before).append(format.name);
    }
  }
  return names;
}

}  // namespace insonify

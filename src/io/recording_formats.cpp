// recording_formats.cpp -- the formats of recordings: HDF5, a file a sonar, and MCAP.

#include "insonify/recording_formats.h"

#include <algorithm>

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
     .holds_all = false,
     .has_messages = false,
     .open = open_h5,
     .bytes = [](const Scenario& scenario, const SonarConfig& sonar, std::uint64_t pings,
                 const MessageOptions& /*messages*/) { return recording_bytes(scenario, sonar, pings); }},
    {.name = "mcap",
     .holds_all = true,
     .has_messages = true,
     .open = open_mcap,
     .bytes = [](const Scenario& /*scenario*/, const SonarConfig& sonar, std::uint64_t pings,
                 const MessageOptions& messages) { return mcap_bytes(sonar, pings, messages); }}};

}  // namespace

std::span<const RecordingFormat> recording_formats() {
  return kFormats;
}

const RecordingFormat* recording_format(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  const auto found = std::ranges::find_if(kFormats, [&](const auto& format) { return format.ending() == ending; });
  return found == std::end(kFormats) ? nullptr : &*found;
}

bool is_recording(const std::filesystem::path& file) {
  return recording_format(file) != nullptr || file.extension() == ".hdf5";
}

std::string recording_names(std::string_view before, std::string_view between) {
  std::string names;
  for (const RecordingFormat& format : kFormats) {
    names.append(names.empty() ? "" : between).append(before).append(format.name);
  }
  return names;
}

}  // namespace insonify

// recordings.cpp -- checks the names of recordings, and describes finished ones.

#include "serve/recordings.h"

#include <fmt/format.h>

#include "console/outcome.h"

namespace insonify {

void refuse_recordings(const std::filesystem::path& recording, std::span<const SonarConfig> sonars, bool replace,
                       const std::filesystem::path& served) {
  const std::vector<std::filesystem::path> files = live_recording_files(recording, sonars);
  for (const std::filesystem::path& file : files) {
    if (!std::filesystem::exists(file)) {
      continue;
    }
    std::error_code error;
    if (std::filesystem::equivalent(file, served, error)) {
      throw InputError(fmt::format(
          "--record {}: the scenario that repeats the recording would replace {}, which is served; give another name",
          recording.string(), file.string()));
    }
    if (!replace) {
      const bool scenario = file == files.back();
      throw InputError(fmt::format("--record {}: {} exists already{}; --force replaces it, or give another name",
                                   recording.string(), file.string(),
                                   scenario ? ", where the scenario that repeats the recording is to be written" : ""));
    }
  }
}

std::string recorded_text(const LiveRecording& recording) {
  std::string names;
  for (const std::filesystem::path& file : recording.files) {
    names += (names.empty() ? "" : ", ") + file.filename().string();
  }
  if (recording.pings == 0) {
    return fmt::format("no ping was recorded, and no file kept as {}", names);
  }
  const std::filesystem::path folder = std::filesystem::absolute(recording.files.front()).parent_path();
  return fmt::format("recorded {} {}, {}: {}, with {}, in {}", recording.pings, recording.pings == 1 ? "ping" : "pings",
                     size_text(recording.bytes), names, recording.scenario.filename().string(),
                     folder.lexically_normal().string());
}

std::string size_text(std::uintmax_t bytes) {
  const auto number = static_cast<double>(bytes);
  return bytes < 1000        ? fmt::format("{} bytes", bytes)
         : number < 999'500  ? fmt::format("{:.0f} kB", number / 1e3)
         : number < 999.95e6 ? fmt::format("{:.1f} MB", number / 1e6)
                             : fmt::format("{:.1f} GB", number / 1e9);
}

}  // namespace insonify

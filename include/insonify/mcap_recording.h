// mcap_recording.h -- records pings as ROS 2 messages in an MCAP file, for Foxglove, ros2 bag and similar tools.

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "insonify/log.h"
#include "insonify/messages.h"
#include "insonify/ping.h"
#include "insonify/ping_sink.h"
#include "insonify/scenario.h"
#include "insonify/scene.h"
#include "insonify/version.h"

namespace insonify {

/// Facts about the run of a recording.
struct RunFacts {
  std::string version = kVersion;  ///< Version of insonify that writes it.
  std::string engine = "cpu";
  std::uint64_t seed = 1;

  /// Names of the scene's instances, "" for removed ones, and materials, by their labels in an HDF5 recording.
  std::vector<std::string> instance_names = {}, material_names = {};
};

/// The facts about a run of the scenario in the scene.
[[nodiscard]] RunFacts run_facts(const Scenario& scenario, const Scene& scene);

struct McapOptions {
  MessageOptions messages = {};
  RunFacts run = {};
  Log log = {};          ///< Receives a warning of clipped values at the end: SonarMessages::cut_text().
  bool replace = false;  ///< Whether an existing file is replaced.

  /// Whether the file appears under its name only when closed, and is removed if it is not.
  bool only_whole = false;
};

/// Writes the pings of one or several sonars of a run to one MCAP file: profile "ros2", schemas "ros2msg", messages
/// "cdr", compressed by zstd in chunks with checksums and indexes. docs/reference/messages.md lists the channels.
///
/// Pings reach the disk within half a second: a killed run leaves a file without an index that is readable up to its
/// last chunk. Existing files are treated as by Recording. RecordedPings reads MCAP files.
class McapRecording final : public PingSink {
 public:
  /// @param sources  One per sonar, with different names.
  /// @throws Error if the file cannot be made, or `path` exists and may not be replaced; for options out of limits.
  McapRecording(const std::filesystem::path& path, std::vector<MessageSource> sources, const McapOptions& options = {});
  ~McapRecording() override;
  McapRecording(McapRecording&&) noexcept;
  McapRecording& operator=(McapRecording&&) noexcept;

  /// @param sonar  Index into the sources.
  /// @throws Error if the disk is full, with earlier pings readable; for a ping that SonarMessages refuses.
  void add(std::size_t sonar, const Ping& ping) override;

  void mark(const std::vector<Marker>& markers) override;

  /// Writes the index, flushes everything to disk and replaces an existing file. The destructor does the same without
  /// reporting errors, but does not replace an existing file.
  void close() override;

  /// Current path of the recording: `path`, or a file beside it until it replaces an existing one.
  [[nodiscard]] const std::filesystem::path& place() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Approximate largest size on disk of an MCAP recording of that many pings [bytes].
[[nodiscard]] std::uint64_t mcap_bytes(const SonarConfig& sonar, std::uint64_t pings,
                                       const MessageOptions& options = {});

}  // namespace insonify

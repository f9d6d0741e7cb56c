// mcap_recording.h -- records pings as ROS 2 messages in an MCAP file, for Foxglove, ros2 bag and their like.

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "insonify/log.h"
#include "insonify/messages.h"
#include "insonify/ping.h"
#include "insonify/scenario.h"
#include "insonify/scene.h"
#include "insonify/version.h"

namespace insonify {

/// What a recording tells of the run that it is from.
struct RunFacts {
  std::string version = kVersion;  ///< Version of insonify that writes it.
  std::string engine = "cpu";
  std::uint64_t seed = 1;

  /// Names of the scene's instances and materials, by the labels that an HDF5 recording of the run has.
  std::vector<std::string> instance_names = {}, material_names = {};
};

/// The facts about a run of the scenario in the scene.
[[nodiscard]] RunFacts run_facts(const Scenario& scenario, const Scene& scene);

struct McapOptions {
  MessageOptions messages = {};
  RunFacts run = {};
  Log log = {};          ///< Is told at the end of values that were cut: SonarMessages::cut_text().
  bool replace = false;  ///< Whether the recording may take the place of a file that is there already.

  /// Whether the file appears under its name only when it is closed, and leaves nothing where it is not.
  bool only_whole = false;
};

/// Writes the pings of one or several sonars of a run to one MCAP file: profile "ros2", schemas "ros2msg", messages
/// "cdr", compressed by zstd in chunks with checksums and indexes. docs/reference/messages.md lists the channels.
///
/// What was added half a second ago is on the disk: a killed run leaves a file that readers can follow to its last
/// chunk, though it has no index. Files that are there already are treated as by Recording. RecordedPings reads them.
class McapRecording {
 public:
  /// @param sources  One a sonar, whose names must differ.
  /// @throws Error when the file cannot be made, or `path` is there and may not be replaced; for options out of limits.
  McapRecording(const std::filesystem::path& path, std::vector<MessageSource> sources, const McapOptions& options = {});
  ~McapRecording();
  McapRecording(McapRecording&&) noexcept;
  McapRecording& operator=(McapRecording&&) noexcept;

  /// @param sonar  Index into the sources.
  /// @throws Error when the disk is full, with what was written before readable; for a ping that SonarMessages refuses.
  void add(std::size_t sonar, const Ping& ping);

  /// Writes the index, has the system put everything on the disk and replaces the earlier file, if there is one. The
  /// destructor does the same without reporting errors, but leaves an earlier file where it is.
  void close();

  /// Where the recording is now: `path`, or beside it until it replaces an earlier file.
  [[nodiscard]] const std::filesystem::path& place() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Bytes on the disk that an MCAP recording of that many pings needs at most, about.
[[nodiscard]] std::uint64_t mcap_bytes(const SonarConfig& sonar, std::uint64_t pings,
                                       const MessageOptions& options = {});

}  // namespace insonify

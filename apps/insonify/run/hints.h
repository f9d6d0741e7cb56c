// hints.h -- hints before and after a run: a full disk, no echoes, pictures that are nearly black.

#pragma once

#include <filesystem>

#include "insonify/ping.h"
#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"
#include "run/run.h"

namespace insonify {

/// Prints the size of a run's recordings and the free space, unless the run is quiet. Warns if the space is too small:
/// the run ends when the disk is full, and keeps the pings made so far.
/// @param messages  What MCAP recordings hold.
/// @param folder  Folder of the recordings; need not exist yet.
void report_disk_space(const Scenario& scenario, const ScenarioRequests& requests, const std::filesystem::path& folder,
                       const RunOptions& options, const MessageOptions& messages);

/// Largest echo of one sonar's pings.
class Loudness {
 public:
  void add(const Ping& ping);

  [[nodiscard]] bool has_echo() const { return loudest_ >= 0; }  ///< Whether there was any echo.
  [[nodiscard]] double loudest() const { return loudest_; }  ///< Intensity of the largest echo; -1 if there was none.
  [[nodiscard]] bool dim() const { return has_echo() && loudest_ < 0.02; }

 private:
  double loudest_ = -1;
};

/// Whether the scenario has echoes without a surface, which have no label: points, the water, or other sonars.
[[nodiscard]] bool receives_more_than_surfaces(const Scenario& scenario);

/// "nothing was received in any ping of fls: ...", with the extent of the world, the sonar's pose, and its
/// settings that silence bins or beams.
[[nodiscard]] std::string silence_text(const Simulator& simulator, int sonar);

/// "the loudest echo of fls is 1.2 % of full scale: ...", with the key that changes it.
[[nodiscard]] std::string dimness_text(const Loudness& loudness, const SonarConfig& sonar);

}  // namespace insonify

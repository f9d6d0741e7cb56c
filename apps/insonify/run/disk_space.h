// disk_space.h -- checks whether the recordings of a run fit on the disk.

#pragma once

#include <filesystem>

#include "insonify/scenario_requests.h"
#include "run/run.h"

namespace insonify {

/// Prints the size of a run's recordings and the free space, unless the run is quiet. Warns if the space is too small:
/// the run ends when the disk is full, and keeps the pings made so far.
/// @param messages  What MCAP recordings hold.
/// @param folder  Folder of the recordings; need not exist yet.
void report_disk_space(const Scenario& scenario, const ScenarioRequests& requests, const std::filesystem::path& folder,
                       const RunOptions& options, const MessageOptions& messages);

}  // namespace insonify

// disk_space.h -- whether the recordings of a run fit on the disk.

#pragma once

#include <filesystem>

#include "commands.h"
#include "insonify/scenario_requests.h"

namespace insonify {

/// Says what the recordings of a run need and what the disk has free, unless the run is quiet. Where that is too little
/// it warns: the run ends when the disk is full, and keeps the pings made so far.
/// @param folder  Where they are written; need not exist yet.
void tell_disk_space(const Scenario& scenario, const ScenarioRequests& requests, const std::filesystem::path& folder,
                     const RunOptions& options);

}  // namespace insonify

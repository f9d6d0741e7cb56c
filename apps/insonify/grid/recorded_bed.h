// recorded_bed.h -- the true bed below recorded soundings, from the scenario that recordings hold.

#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "insonify/scenario.h"
#include "insonify/scene.h"

namespace insonify {

struct RecordedBed {
  std::optional<Scenario> scenario = {};  ///< Of the first recording; absent where it has none that can be read.
  std::optional<Scene> scene = {};        ///< Absent where its world was not found.
  std::string why = {};                   ///< Why there is no scene; "" also for recordings of other programs.
};

/// Reads the scenario and its world.
/// @param sonar   Name; "" for the only one.
/// @param folder  Base of file names in the scenario; empty: searched.
[[nodiscard]] RecordedBed recorded_bed(std::span<const std::filesystem::path> recordings, const std::string& sonar,
                                       const std::filesystem::path& folder);

}  // namespace insonify

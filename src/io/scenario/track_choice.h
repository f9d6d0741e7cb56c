// track_choice.h -- the keys of a trajectory in a file of its own.

#pragma once

#include <filesystem>

#include "insonify/field.h"

namespace insonify {

/// Used in scenario files only: a Trajectory has the file's waypoints.
struct TrackChoice {
  std::filesystem::path file = {};
  double start = 0;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"file", "", {}, "Waypoints: CSV (.csv) or TUM (.tum, .txt), from the scenario's folder."}, self.file);
    visit(Field{"start", "s", from_to(-1e10, 1e10), "Time of the file that is 0 s of the scenario."}, self.start);
  }
};

}  // namespace insonify

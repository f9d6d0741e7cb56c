// file_choices.h -- keys of scenario files that stand for others: the preset of a sonar, the file of a trajectory
// or of a sound-speed profile.

#pragma once

#include <filesystem>
#include <string>

#include "insonify/settings_table.h"

namespace insonify {

/// The preset that a sonar's entry starts from: a SonarConfig has its numbers.
struct PresetChoice {
  std::string preset = {}, mode = {};

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"preset", "", {}, "Instrument to start from: `insonify sonars` lists them."}, self.preset);
    visit(Field{"mode", "", {}, "Mode of the preset; its own default when absent."}, self.mode);
  }
};

/// A trajectory in a file of its own: a Trajectory has its waypoints.
struct TrackChoice {
  std::filesystem::path file = {};
  double start = 0;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"file", "", {}, "Waypoints (.csv, .tum, .txt, .kitti), from the scenario's folder."}, self.file);
    visit(Field{"start", "s", from_to(-1e10, 1e10), "Time of the file that is 0 s of the scenario."}, self.start);
  }
};

/// A column of such a file, an entry of its `columns`.
struct ColumnChoice {
  std::string name = {}, unit = {};
  int sign = 1;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"name", "", {}, "Name of the column in the file's header."}, self.name);
    visit(Field{"unit", "", {}, "Its unit, if the header does not say it: s, ms, us, ns, m, cm, mm, km, ft, rad, deg."},
          self.unit);
    visit(Field{"sign", "", from_to(-1, 1), "1, or -1 for a depth in place of z."}, self.sign);
  }
};

/// A sound-speed profile in a file of its own: a Water has its points.
struct CastChoice {
  std::filesystem::path file = {};

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"file", "", {}, "Cast (.csv, .svp, .asvp), from the scenario's folder."}, self.file);
  }
};

}  // namespace insonify

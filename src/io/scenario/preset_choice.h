// preset_choice.h -- the keys of a sonar's entry that name the preset it starts from.

#pragma once

#include <string>

#include "insonify/field.h"

namespace insonify {

/// Used in files only: a SonarConfig has the preset's numbers.
struct PresetChoice {
  std::string preset = {}, mode = {};

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"preset", "", {}, "Instrument to start from: `insonify sonars` lists them."}, self.preset);
    visit(Field{"mode", "", {}, "Mode of the preset; its own default when absent."}, self.mode);
  }
};

}  // namespace insonify

// sampling.h -- sampling density of the insonified sector: columns per beam, rows per column.

#pragma once

#include <optional>

#include "insonify/settings_table.h"

namespace insonify {

/// Sampling density of the insonified sector. More samples take more time and do not change expected levels. If a
/// number is absent, the calibrated model derives it from the instrument (SonarConfig::sampling_by_rule()), and the
/// paper model uses kColumns and kRows.
struct Sampling {
  static constexpr int kColumns = 4, kRows = 200;

  std::optional<int> columns_per_beam = {};  ///< Azimuths sampled in each beam, 1..256.
  std::optional<int> rows = {};              ///< Elevations sampled in each column, 2..8192; staggered between columns.

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"columns_per_beam", "", from_to(1, 256),
                "Azimuths sampled in each beam; absent: by the width of the beams in the calibrated model, 4 in the "
                "paper's."},
          self.columns_per_beam);
    visit(Field{"rows", "", from_to(2, 8192),
                "Elevations sampled in each column, staggered between columns; absent: by the number of bins in the "
                "calibrated model, 200 in the paper's."},
          self.rows);
  }
};

}  // namespace insonify

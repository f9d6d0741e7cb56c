// put_settings.h -- every setting of a run as a dataset of its recording, with unit and explanation.

#pragma once

#include "insonify/scenario.h"
#include "io/recording/hdf5_writer.h"

namespace insonify {

/// Writes `settings/...` from Scenario's lists of fields and parts: `settings/pings`, `settings/water/salinity`; for a
/// list or map of structs, such as `points`, one dataset per field with a row for each entry. Sonar and water are those
/// of `sonar`. `settings/materials` are the scene's, with the numbers used.
void put_settings(const H5Writer& writer, const Scenario& scenario, const Scene& scene, const SonarConfig& sonar);

}  // namespace insonify

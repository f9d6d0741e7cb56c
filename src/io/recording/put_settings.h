// put_settings.h -- every setting of a run as a dataset of its recording, with unit and explanation.

#pragma once

#include "insonify/scenario.h"
#include "io/recording/hdf5_writer.h"

namespace insonify {

/// Writes `settings/...` by the lists of fields and parts of Scenario: `settings/pings`, `settings/water/salinity`; of
/// a list or map of structs, such as `points`, one dataset a field with a row for each entry. Of the sonars and the
/// waters, `sonar`'s own. `settings/materials` are the scene's, with the numbers that were used.
void put_settings(const H5Writer& writer, const Scenario& scenario, const Scene& scene, const SonarConfig& sonar);

}  // namespace insonify

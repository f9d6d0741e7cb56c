// read_trajectory.h -- a list of waypoints, or the file that has them.

#pragma once

#include "insonify/scenario.h"
#include "io/scenario/yaml_read.h"

namespace insonify {

/// A list of waypoints; the name of a file; or a map of the keys of TrackChoice.
/// @param places  With the place of "", the scenario's file, whose folder is the base of file names.
void read_part(const YamlValue& value, const std::string& name, const Part& part, std::vector<Waypoint>& waypoints,
               Places& places);

}  // namespace insonify

// put_markers.h -- adds an operator's markers to a recording that is closed.

#pragma once

#include <filesystem>
#include <vector>

#include "insonify/marker.h"

namespace insonify {

/// Writes the dataset `markers` of marker_text()s.
/// @throws Error with the path; without room on the disk before anything has been written.
void put_markers(const std::filesystem::path& path, const std::vector<Marker>& markers);

}  // namespace insonify

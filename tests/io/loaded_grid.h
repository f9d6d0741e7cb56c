// loaded_grid.h -- loads a height grid and its log messages for tests.

#pragma once

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "insonify/files.h"

namespace insonify {

/// A grid and the messages logged about its file.
struct LoadedGrid {
  HeightGrid grid;
  std::vector<std::string> notes;
};

inline LoadedGrid load_grid(const std::filesystem::path& path) {
  LoadedGrid loaded;
  loaded.grid = load_height_grid(path, [&](Severity severity, const std::string& note) {
    loaded.notes.push_back((severity == Severity::kWarning ? "warning: " : "info: ") + note);
  });
  return loaded;
}

/// Lowest and highest height, and number of heights.
struct Extent {
  float low = INFINITY, high = -INFINITY;
  std::size_t count = 0;
};

inline Extent extent_of(const HeightGrid& grid) {
  Extent extent;
  for (const float height : grid.heights) {
    if (!std::isnan(height)) {
      extent = {std::min(extent.low, height), std::max(extent.high, height), extent.count + 1};
    }
  }
  return extent;
}

}  // namespace insonify

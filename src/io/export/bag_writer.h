// bag_writer.h -- Bathymetric Attributed Grids.

#pragma once

#include <filesystem>

#include "insonify/sounding_grid_files.h"

namespace insonify {

/// @throws Error with the path.
void write_bag_grid(const SoundingGrid& grid, const std::filesystem::path& file,
                    const SoundingGridFileOptions& options);

}  // namespace insonify

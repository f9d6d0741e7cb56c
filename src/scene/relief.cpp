// relief.cpp -- validates a ReliefConfig, and computes slopes from maps of normals and of heights.

#include "insonify/relief.h"

#include <fmt/format.h>

#include <string_view>

#include "insonify/error.h"

namespace insonify {
namespace {

constexpr double kLeastLength = 1e-3;  // Shortest length of a relief [m]: finer than any sonar resolves.

void require(bool good, const std::string& object, std::string_view key, std::string_view rest) {
  if (!good) {
    throw Error(object, key, fmt::format(" {}", rest));
  }
}

}  // namespace

void ReliefConfig::validate(const std::string& object) const {
  check_fields(object, *this);
  for (const auto& [key, length] : {std::pair{"ripple_wavelength", ripple_wavelength}, {"tile_size", tile_size}}) {
    require(length == 0 || length >= kLeastLength, object, key,
            fmt::format("= {:.10g} m must be 0 or at least {} m", length, kLeastLength));
  }
  const bool has_normals = !normal_map.empty(), has_heights = !height_map.empty();
  require(!has_normals || !has_heights, object, "height_map", "cannot go with normal_map: one shape a surface");
  require(!has_shape() || !has_normals, object, "normal_map",
          "cannot go with ripples or roughness: one shape a surface");
  require(!has_shape() || !has_heights, object, "height_map",
          "cannot go with ripples or roughness: one shape a surface");
  require(!has_heights || height > 0, object, "height_map", "needs height, how far white lies above black [m]");
  require(has_heights || height == 0, object, "height", "needs height_map, the picture that it is for");
  require(has_normals || normal_strength == 1, object, "normal_strength",
          "needs normal_map, the picture that it is for");
  const ReliefConfig usual;
  const bool has_ripples = ripple_height > 0, has_roughness = roughness_height > 0;
  require(has_ripples || ripple_direction == usual.ripple_direction, object, "ripple_direction_deg",
          "needs ripple_height");
  require(has_roughness || roughness_exponent == usual.roughness_exponent, object, "roughness_exponent",
          "needs roughness_height");
  require(has_ripples || has_roughness || relief_seed == usual.relief_seed, object, "relief_seed",
          "needs ripples or roughness");
  require(tile_size == 0 || has_shape() || has_normals || has_heights || !reflectivity_map.empty(), object, "tile_size",
          "needs ripples, roughness or a map");
  require(ripple_wavelength == 0 || ripple_height > 0, object, "ripple_wavelength", "needs ripple_height");
  require(ripple_height == 0 || ripple_wavelength > 0, object, "ripple_height", "needs ripple_wavelength");
  if (ripple_wavelength > 0 && tile_size > 0) {
    constexpr double kLeast = 2, kMost = 128;  // Ripples in a tile; at most 128, so that each has four texels.
    const auto size = fmt::format("= {} m must", tile_size);
    require(tile_size >= kLeast * ripple_wavelength, object, "tile_size",
            fmt::format("{} hold at least {} ripples of {} m, or be 0", size, kLeast, ripple_wavelength));
    require(tile_size <= kMost * ripple_wavelength, object, "tile_size",
            fmt::format("{} be at most {} ripples of {} m", size, kMost, ripple_wavelength));
  }
}

Tile<Eigen::Vector2f> slopes_of_normals(const Tile<Eigen::Vector3f>& normals) {
  Tile<Eigen::Vector2f> slopes{normals.columns, normals.rows, {}};
  slopes.texels.reserve(normals.texels.size());
  for (const Eigen::Vector3f& normal : normals.texels) {
    slopes.texels.emplace_back(-normal.x() / normal.z(), -normal.y() / normal.z());
  }
  return slopes;
}

Tile<Eigen::Vector2f> slopes_of_heights(const Tile<float>& heights) {
  const int columns = heights.columns, rows = heights.rows;
  Tile<Eigen::Vector2f> slopes{columns, rows, {}};
  slopes.texels.reserve(heights.texels.size());
  const auto at = [&](int column, int row) {
    return heights.texels[static_cast<std::size_t>((row + rows) % rows) * columns + (column + columns) % columns];
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      slopes.texels.emplace_back(0.5F * static_cast<float>(columns) * (at(column + 1, row) - at(column - 1, row)),
                                 0.5F * static_cast<float>(rows) * (at(column, row - 1) - at(column, row + 1)));
    }
  }
  return slopes;
}

}  // namespace insonify

// relief.h -- what a surface is like more finely than its triangles say: small slopes, and patches that reflect less.

#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "insonify/field.h"

namespace insonify {

/// Values on a grid that repeats without end in both directions; linear between texels.
template <typename Texel>
struct Tile {
  int columns = 0, rows = 0;
  std::vector<Texel> texels = {};  ///< rows x columns, from the top left; empty: the tile says nothing.

  [[nodiscard]] bool empty() const { return texels.empty(); }

  /// @param u,v  Any finite numbers; the tile covers 0..1 to the right and up.
  [[nodiscard]] Texel at(float u, float v) const;
};

/// The small shape of a surface. Triangles stay where they are: slopes turn the normal that sound meets, and leave
/// ranges and shadows alone.
struct Relief {
  /// Rise of the surface towards the right and the top of the tile.
  Tile<Eigen::Vector2f> slopes = {};

  /// What slopes are: rise over run, both in metres; or metres of rise over the whole tile, which then depends on how
  /// large the tile is laid.
  bool rise_per_tile = false;

  Tile<float> reflectivity = {};  ///< Of the surface's own, 0..1.

  double tile_size = 1;      ///< Side of a tile that is laid by position [m]; 0: never laid so.
  bool by_position = false;  ///< Laid by position even where the mesh has texture coordinates.
};

/// How a relief is described in a scenario: pictures, or a shape to be made up.
struct ReliefConfig {
  std::filesystem::path normal_map = {};  ///< Picture of normals. One shape: these, heights, or ripples and roughness.
  double normal_strength = 1;             ///< Times the slopes of the normal map, >= 0.
  std::filesystem::path height_map = {};  ///< Grey picture of heights.
  double height = 0;                      ///< Of white above black [m].
  double ripple_wavelength = 0;           ///< [m]; 0 for no ripples.
  double ripple_height = 0;               ///< From trough to crest [m].
  double ripple_direction = 0;            ///< Across the crests, from x towards y [rad].
  double roughness_height = 0;            ///< Root mean square [m]; 0 for none.
  double roughness_exponent = 3.25;       ///< Height spectrum falls with this power of the wave number.
  std::uint64_t relief_seed = 1;          ///< Of the made-up shape.
  std::filesystem::path reflectivity_map =
      {};                ///< Grey picture: white as reflective as the material, black not at all.
  double tile_size = 0;  ///< [m]; 0: by texture coordinates where there are some, else a default.

  [[nodiscard]] bool has_shape() const { return ripple_wavelength > 0 || roughness_height > 0; }
  [[nodiscard]] bool empty() const {
    return normal_map.empty() && height_map.empty() && reflectivity_map.empty() && !has_shape();
  }

  /// @param object  In messages: "materials.sand".
  /// @throws Error for numbers out of their limits, more than one shape, or half of one.
  void validate(const std::string& object) const;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"normal_map", "", {}, "Picture (PNG) of the surface's small normals, tangent space, green up."},
          self.normal_map);
    visit(Field{"normal_strength", "", from_to(0, 100), "Times the slopes of the normal map."}, self.normal_strength);
    visit(Field{"height_map", "", {}, "Grey picture (PNG) of the surface's small heights."}, self.height_map);
    visit(Field{"height", "m", from_to(0, 100), "Of white above black in the height map."}, self.height);
    visit(Field{"ripple_wavelength", "m", from_to(0, 1000), "Of ripples all over the surface; 0 for none."},
          self.ripple_wavelength);
    visit(Field{"ripple_height", "m", from_to(0, 100), "Of ripples, from trough to crest."}, self.ripple_height);
    visit(Field{"ripple_direction", "rad", turn(), "Across the ripples' crests, from x towards y of the mesh."},
          self.ripple_direction);
    visit(Field{"roughness_height", "m", from_to(0, 100), "Root mean square height of random roughness; 0 for none."},
          self.roughness_height);
    visit(Field{"roughness_exponent", "", from_to(2, 6),
                "Power of the wave number that the heights' spectrum falls with."},
          self.roughness_exponent);
    visit(Field{"relief_seed", "", at_least(0), "Seed of ripples and roughness."}, self.relief_seed);
    visit(
        Field{"reflectivity_map", "", {}, "Grey picture (PNG): white reflects as the material does, black not at all."},
        self.reflectivity_map);
    visit(Field{"tile_size", "m", from_to(0, 1e6),
                "Side of one picture laid by position; 0: by the mesh's texture coordinates, where it has none 1 m."},
          self.tile_size);
  }
};

/// Ripples and roughness on a tile of `config.tile_size`, or of 24 wavelengths or 4 m where that is 0. Heights are a
/// Gaussian random surface: ripples a narrow band of waves about theirs, roughness all waves that fit. Slopes are those
/// of a surface of the height asked for. docs/concepts/relief.md
[[nodiscard]] Relief make_relief(const ReliefConfig& config);

/// Slopes from normals as pictures keep them: x right, y up, z out of the surface; z must be greater than 0.
[[nodiscard]] Tile<Eigen::Vector2f> slopes_of_normals(const Tile<Eigen::Vector3f>& normals);

/// Slopes of heights, per tile, from the texels on both sides.
[[nodiscard]] Tile<Eigen::Vector2f> slopes_of_heights(const Tile<float>& heights);

// ---------------------------------------------------------------------------------------------------------------------

template <typename Texel>
Texel Tile<Texel>::at(float u, float v) const {
  const float x = (u - std::floor(u)) * static_cast<float>(columns) - 0.5F;
  const float y = (1 - (v - std::floor(v))) * static_cast<float>(rows) - 0.5F;
  const float left = std::floor(x), top = std::floor(y);
  const auto wrapped = [](float at, int count) {
    const int index = static_cast<int>(at);
    return index < 0 ? index + count : index >= count ? index - count : index;
  };
  const int column0 = wrapped(left, columns), column1 = wrapped(left + 1, columns);
  const std::size_t row0 = static_cast<std::size_t>(wrapped(top, rows)) * columns;
  const std::size_t row1 = static_cast<std::size_t>(wrapped(top + 1, rows)) * columns;
  const float right_share = x - left, bottom_share = y - top;
  const Texel upper = (1 - right_share) * texels[row0 + column0] + right_share * texels[row0 + column1];
  const Texel lower = (1 - right_share) * texels[row1 + column0] + right_share * texels[row1 + column1];
  return (1 - bottom_share) * upper + bottom_share * lower;
}

}  // namespace insonify

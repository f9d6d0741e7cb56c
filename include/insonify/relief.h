// relief.h -- small-scale surface structure that triangles do not resolve: slopes and reflectivity, from maps or
// random.

#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "insonify/settings_table.h"

namespace insonify {

/// Values on a grid that repeats periodically in both directions; bilinear between texels.
template <typename Texel>
struct Tile {
  int columns = 0, rows = 0;
  std::vector<Texel> texels = {};  ///< rows x columns, from the top left; empty: no tile.

  [[nodiscard]] bool empty() const { return texels.empty(); }

  /// @param u,v  Any finite numbers; the tile covers 0..1 to the right and up.
  [[nodiscard]] Texel at(float u, float v) const;
};

/// Small-scale slopes and reflectivity of a surface, tiled over it. Slopes tilt the surface normal used for scattering;
/// the geometry, and with it ranges and shadows, is unchanged.
struct Relief {
  /// Slope of the surface towards the right and towards the top of the tile.
  Tile<Eigen::Vector2f> slopes = {};

  /// Unit of `slopes`. False: rise over run. True: metres of rise per side of the tile, so that the slope depends on
  /// the size at which the tile is mapped onto the surface.
  bool rise_per_tile = false;

  Tile<float> reflectivity = {};  ///< Factor on the material's reflectivity, 0..1.

  double tile_size = 1;      ///< Side of a tile that is mapped by position [m]; 0: only by texture coordinates.
  bool by_position = false;  ///< Map by position even if the mesh has texture coordinates.
};

/// Relief as described in a scenario: by maps, or by the parameters of random ripples and roughness.
struct ReliefConfig {
  // The shape: at most one of normal map, height map, and ripples with roughness.
  std::filesystem::path normal_map = {};        ///< Picture of normals.
  double normal_strength = 1;                   ///< Factor on the slopes of the normal map, 0..100.
  std::filesystem::path height_map = {};        ///< Grey picture of heights.
  double height = 0;                            ///< Height of white above black in the height map [m], 0..100.
  double ripple_wavelength = 0;                 ///< [m], 0..1000; 0 for no ripples.
  double ripple_height = 0;                     ///< From trough to crest [m], 0..100.
  double ripple_direction = 0;                  ///< Normal to the crests, from x towards y [rad], within 1e6 deg.
  double roughness_height = 0;                  ///< Root mean square height [m], 0..100; 0 for none.
  double roughness_exponent = 3.25;             ///< The height spectrum falls with this power of wavenumber, 2..6.
  std::uint64_t relief_seed = 1;                ///< Seed of ripples and roughness.
  std::filesystem::path reflectivity_map = {};  ///< Grey picture: factor on reflectivity, white 1, black 0.
  double tile_size = 0;  ///< Side of a tile [m], 0..1e6; 0: by texture coordinates, or a default where there are none.

  [[nodiscard]] bool has_shape() const { return ripple_wavelength > 0 || roughness_height > 0; }
  [[nodiscard]] bool empty() const {
    return normal_map.empty() && height_map.empty() && reflectivity_map.empty() && !has_shape();
  }

  /// @param object  Name in messages: "materials.sand".
  /// @throws Error for numbers out of their limits, for more than one shape, or for an incomplete one.
  void validate(const std::string& object) const;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"normal_map", "", {}, "Normal map (PNG) in tangent space, green up."}, self.normal_map);
    visit(Field{"normal_strength", "", from_to(0, 100), "Factor on the slopes of the normal map."},
          self.normal_strength);
    visit(Field{"height_map", "", {}, "Height map (grey PNG)."}, self.height_map);
    visit(Field{"height", "m", from_to(0, 100), "Height of white above black in the height map."}, self.height);
    visit(Field{"ripple_wavelength", "m", from_to(0, 1000), "Wavelength of ripples; 0 for none."},
          self.ripple_wavelength);
    visit(Field{"ripple_height", "m", from_to(0, 100), "Height of ripples, from trough to crest."}, self.ripple_height);
    visit(
        Field{"ripple_direction", "rad", turn(), "Direction across the ripples' crests, from x towards y of the mesh."},
        self.ripple_direction);
    visit(Field{"roughness_height", "m", from_to(0, 100), "Root mean square height of random roughness; 0 for none."},
          self.roughness_height);
    visit(Field{"roughness_exponent", "", from_to(2, 6),
                "Power of the wavenumber with which the spectrum of heights falls."},
          self.roughness_exponent);
    visit(Field{"relief_seed", "", at_least(0), "Seed of ripples and roughness."}, self.relief_seed);
    visit(Field{"reflectivity_map", "", {}, "Factor on the amplitude reflectivity (grey PNG): white 1, black 0."},
          self.reflectivity_map);
    visit(Field{"tile_size", "m", from_to(0, 1e6),
                "Side of a tile mapped by position; 0: a map follows the mesh's texture coordinates or, without these, "
                "has a side of 1 m."},
          self.tile_size);
  }
};

/// Makes a tile of random ripples and roughness, of the side config.tile_size; where that is 0, of 24 ripple
/// wavelengths or 4 m. Heights are a periodic Gaussian random surface with a given spectrum: a narrow band about the
/// wavelength for ripples, a power law over all wavenumbers that the tile can hold for roughness. See
/// docs/concepts/relief.md.
[[nodiscard]] Relief make_relief(const ReliefConfig& config);

/// Slopes of a map of normals in tangent space: x right, y up, z out of the surface, which must be greater than 0.
[[nodiscard]] Tile<Eigen::Vector2f> slopes_of_normals(const Tile<Eigen::Vector3f>& normals);

/// Slopes of a map of heights by central differences, as rise per side of the tile.
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

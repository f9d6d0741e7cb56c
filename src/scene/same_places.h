// same_places.h -- which vertices of a mesh are at the same place, and which triangles are given twice.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "insonify/mesh.h"

namespace insonify {

/// Vertices nearer to each other than this are one corner [m]: a tenth of the wavelength at 3 MHz, and many times what
/// the texts and floats of mesh files round coordinates by.
inline constexpr float kSamePlace = 5e-5F;

/// kSamePlace, or twice the rounding of floats where coordinates are so large that this is more [m].
[[nodiscard]] float same_place_tolerance(std::span<const Vec3f> places);

/// [place] Number of each place: the lowest index of those within the tolerance of it, if that one has none lower; else
/// its own. NaN is the same as itself only.
/// @param tolerance  [m]
/// @param most       [place] Smaller tolerances of single places [m]; empty: none.
[[nodiscard]] std::vector<std::uint32_t> same_places(std::span<const Vec3f> places, float tolerance,
                                                     std::vector<float> most, Workers& workers);

/// [triangle] Index of the first triangle with the same three corners, in any order; empty if no two have.
[[nodiscard]] std::vector<std::uint32_t> repeated_triangles(const Mesh& mesh, Workers& workers);

}  // namespace insonify

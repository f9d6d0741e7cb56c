// underwater_light.h -- the looks of a camera view: tints of materials, water, light.

#pragma once

#include "insonify/geometry.h"
#include "insonify/material.h"

namespace insonify {

// Colours here are red, green and blue, linear in light, 0..1.

/// A colour from 0xRRGGBB as written for screens.
[[nodiscard]] Vec3f linear_colour(unsigned rgb);

/// What a surface of that material looks like in white light. A name that tells nothing gets a tint of its own, near
/// that of other things as dense.
[[nodiscard]] Vec3f tint_of(const Material& material);

/// The open water seen in a direction: brighter towards the surface.
[[nodiscard]] Vec3f water_colour(const Vec3& direction);

/// Light that reaches a surface from all around.
[[nodiscard]] Vec3f ambient_light(const Vec3& normal);

/// Share of each colour that water lets through over a distance, in units of the distance at which a view turns hazy.
[[nodiscard]] Vec3f transmission(double distance);

/// The same as screens want it, 0..255, not rounded: highlights are rolled off, not clipped.
[[nodiscard]] Vec3f screen_colour(const Vec3f& linear);

}  // namespace insonify

// underwater_light.h -- colours of a camera view: materials, water and light.

#pragma once

#include "insonify/geometry.h"
#include "insonify/material.h"

namespace insonify {

// Colours are linear RGB, 0..1.

/// Converts a screen colour 0xRRGGBB to linear RGB.
[[nodiscard]] Vec3f linear_colour(unsigned rgb);

/// Colour of a material in white light, chosen by words in its name. Other names get a tint by density, varied by a
/// hash of the name.
[[nodiscard]] Vec3f tint_of(const Material& material);

/// Colour of open water in a direction: brighter upwards.
[[nodiscard]] Vec3f water_colour(const Vec3& direction);

/// Ambient light on a surface with this normal.
[[nodiscard]] Vec3f ambient_light(const Vec3& normal);

/// Transmittance of water per colour channel over a distance, in units of the haze's length scale.
[[nodiscard]] Vec3f transmission(double distance);

/// Converts linear RGB to screen values, 0..255, not rounded. Highlights are compressed, not clipped.
[[nodiscard]] Vec3f screen_colour(const Vec3f& linear);

/// Value noise in -1..1 with zero mean: three octaves with grid spacings `size`, half of it and a quarter of it.
[[nodiscard]] float value_noise(const Vec3& point, double size);

}  // namespace insonify

// water_shapes.h -- which shapes of a world are its water: they are to be seen, not to stop sound.

#pragma once

#include <string_view>

#include "insonify/scene.h"

namespace insonify {

/// Whether a full name, "ocean::link::visual", says that its shape is water: ocean, sea_surface, water, waves, Ocean1.
/// The innermost part that is not a general word, such as link or visual, decides: "ocean::seabed" and "water_tank" are
/// not water.
[[nodiscard]] bool is_water_name(std::string_view name);

/// Whether a shape is a sheet that lies level: 20 times as long as high, at least 1 m in both directions.
[[nodiscard]] bool is_level_sheet(const Instance& instance);

}  // namespace insonify

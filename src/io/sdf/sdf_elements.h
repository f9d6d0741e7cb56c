// sdf_elements.h -- questions about the elements of an SDF file, and changes for libsdformat.

#pragma once

#include <string_view>
#include <vector>

#include "io/file/xml_file.h"

namespace insonify {

/// Whether an element has no influence on shapes and poses.
[[nodiscard]] bool is_irrelevant_sdf(pugi::xml_node element);

/// Whether an element is an <include> at a valid place.
[[nodiscard]] bool is_sdf_include(pugi::xml_node element);

/// Whether a file holds only lights or actors.
[[nodiscard]] bool holds_only_sdf_lights(pugi::xml_node root);

/// Whether a pose, a frame or a placement may be relative to something of this name, scoped or not.
[[nodiscard]] bool is_sdf_frame_of_another(pugi::xml_node root, std::string_view name);

/// Whether an element is a visual's look named as water, such as "UUVSimulator/StaticWater".
[[nodiscard]] bool paints_sdf_water(pugi::xml_node element);

/// Alpha of the diffuse colour of a visual's look, from 0, clear, to 1; 1 for anything else.
[[nodiscard]] double sdf_opacity(pugi::xml_node element);

/// Makes a model without links and models static: libsdformat refuses others, and one whose included models are missing
/// has none.
void keep_empty_sdf_model_readable(pugi::xml_node parent);

/// Puts several models at the root into a world, because libsdformat reads only one model at the root. Returns whether
/// it did.
bool put_world_around_sdf_models(pugi::xml_node root);

}  // namespace insonify

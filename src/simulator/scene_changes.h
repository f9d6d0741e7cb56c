// scene_changes.h -- objects that come and go: all others keep their indices.

#pragma once

#include <string_view>

#include "insonify/scene.h"

namespace insonify {

/// Adds instances after all others, and those of their materials that are not there yet.
/// @param objects  With materials assigned.
/// @throws Error for a name that is there already, materials that are not assigned, and where there would be too many;
///         nothing has been added then.
void add_to_scene(const Scene& objects, Scene& scene);

/// Takes the object of this name out, with all its parts: they are no longer `present`.
/// @throws Error where there is none, or it is the sea's surface.
void remove_from_scene(std::string_view name, Scene& scene);

}  // namespace insonify

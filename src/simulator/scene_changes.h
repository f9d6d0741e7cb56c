// scene_changes.h -- adds objects to a scene and removes them; other instances keep their indices.

#pragma once

#include <string_view>

#include "insonify/scene.h"

namespace insonify {

/// @throws Error for an instance without a mesh, or whose materials are not assigned, and for a pose or a reach out of
///         limits.
void check_scene(const Scene& scene);

/// Appends instances to the scene, and those of their materials that it does not have yet.
/// @param objects  With materials assigned.
/// @throws Error for a name that exists already, unassigned materials, or too many instances or materials; the scene is
/// then unchanged.
void add_to_scene(const Scene& objects, Scene& scene);

/// Removes the object of this name and all its parts: they are no longer `present`.
/// @throws Error if there is none, or if it is the sea surface.
void remove_from_scene(std::string_view name, Scene& scene);

}  // namespace insonify

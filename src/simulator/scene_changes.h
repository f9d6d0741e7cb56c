// scene_changes.h -- adds objects to a scene and removes them; all other instances keep their indices.

#pragma once

#include <string_view>

#include "insonify/scene.h"

namespace insonify {

/// @throws Error for an instance without a mesh, or whose materials are not assigned, and for a pose or a reach out of
///         limits.
void check_scene(const Scene& scene);

/// Index that add_to_scene() is to give to the first of so many instances: the lowest from which on as many in a row
/// are removed, or after the last.
[[nodiscard]] std::size_t free_index(const Scene& scene, std::size_t count);

/// Adds instances to the scene, and those of their materials that it does not have yet; these take the places of
/// materials that no instance uses.
/// @param objects  With materials assigned.
/// @param first    From free_index().
/// @throws Error for a name that exists already, unassigned materials, or too many instances or materials; the scene is
/// then unchanged.
void add_to_scene(const Scene& objects, std::size_t first, Scene& scene);

/// Removes the object of this name and all its parts: they are no longer `present`.
/// @throws Error if there is none, or if it is the sea surface.
void remove_from_scene(std::string_view name, Scene& scene);

}  // namespace insonify

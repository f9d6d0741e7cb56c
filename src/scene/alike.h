// alike.h -- which instances of a scene differ in name, pose and motion only, so that what is found on one holds for
// all.

#pragma once

#include <cstddef>
#include <vector>

#include "insonify/scene.h"

namespace insonify {

/// [instance] The first present instance of the same mesh, materials and reliefs: itself if there is none before it.
[[nodiscard]] std::vector<std::size_t> first_alike(const Scene& scene);

}  // namespace insonify

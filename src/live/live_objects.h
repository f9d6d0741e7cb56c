// live_objects.h -- objects that LiveLoop::change_objects() adds and removes.

#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "insonify/scene.h"

namespace insonify {

/// One instance, without materials. A later one of the same name has another serial number.
struct LiveObject {
  std::uint64_t serial = 0;
  Instance instance;
};

/// In the order in which they were added.
using LiveObjectList = std::vector<LiveObject>;

/// Objects of `list` that are not in `other`.
[[nodiscard]] LiveObjectList live_objects_only_in(const LiveObjectList& list, const LiveObjectList& other);

[[nodiscard]] bool has_live_object(const LiveObjectList& list, std::string_view name);

}  // namespace insonify

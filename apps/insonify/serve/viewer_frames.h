// viewer_frames.h -- binary messages of the viewer's protocol (docs/design/viewer.md).

#pragma once

#include <memory>
#include <string>

#include "insonify/live_loop.h"

namespace insonify {

/// Tables of a ping that a client requests, as bits.
enum PingTable : unsigned {
  kLevelTable = 1,
  kInstanceTable = 2,
  kMaterialTable = 4,
  kElevationTable = 8,
  kShadowTable = 16,
  kMultipathTable = 32,
  kSoundingRangeTable = 64,
  kDetectionTable = 128
};

/// The bit of a table's name; 0 for an unknown name.
[[nodiscard]] unsigned ping_table(std::string_view name);

using Bytes = std::shared_ptr<const std::string>;

/// A ping with those of the requested tables that it has.
[[nodiscard]] Bytes ping_frame(const LivePing& ping, unsigned tables);

/// The objects' meshes. Meshes with more than kMostTriangles have their vertices merged on a grid.
[[nodiscard]] Bytes scene_frame(const LiveWorld& world);
inline constexpr std::size_t kMostTriangles = 200'000;

/// Poses of the moving objects.
[[nodiscard]] Bytes moved_frame(const LivePing& ping);

/// Whether two worlds have the same scene_frame() except for names of materials.
[[nodiscard]] bool same_scene(const LiveWorld& a, const LiveWorld& b);

}  // namespace insonify

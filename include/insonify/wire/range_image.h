// range_image.h -- the range images of a Water Linked Sonar 3D-15 as packets of its Range Image Protocol 2.

#pragma once

#include <cstdint>
#include <vector>

namespace insonify {

/// Distances to the surfaces that a sonar sees, by direction. Pixels are rows from below, each from port to starboard;
/// the directions of the outermost are the edges of the field of view. As published: github.com/waterlinked/wlsonar
/// (WaterLinkedSonarIntegrationProtocol.proto) and docs.waterlinked.com, "Integration API Sonar 3D-15".
struct RangeImage {
  std::uint64_t time_ns = 0;   ///< Of transmission, since 1970-01-01T00:00:00Z [ns].
  std::uint32_t sequence = 0;  ///< Number of the image.
  float sound_speed = 0;       ///< [m/s]
  float range = 0;             ///< Longest [m].
  std::uint32_t frequency = 0;
  std::uint32_t width = 0, height = 0;  ///< [pixels]
  float horizontal_fov_deg = 0, vertical_fov_deg = 0;
  float pixel_scale = 0;                   ///< Distance for a pixel's value of 1 [m].
  std::vector<std::uint16_t> pixels = {};  ///< width x height; 0: nothing within range.
};

/// "RIP2", the packet's length, its contents (Protocol Buffers in a Snappy block), and a CRC-32 of all before it.
[[nodiscard]] std::vector<std::uint8_t> encode_rip2(const RangeImage& image);

}  // namespace insonify

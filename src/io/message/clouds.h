// clouds.h -- points of clouds as messages have them: strong echoes, and the soundings of multibeams.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "insonify/sounding.h"

namespace insonify {

/// Type of a field of points, as sensor_msgs/PointField numbers it; gz.msgs.PointCloudPacked begins at 0 with the same
/// order.
enum class CloudType : std::uint8_t { kUint8 = 2, kUint16 = 4, kInt32 = 5, kFloat32 = 7 };

struct CloudField {
  std::string_view name;
  std::uint32_t offset = 0;  ///< From the start of a point [bytes].
  CloudType type = CloudType::kFloat32;
};

/// Points in memory and what their fields are.
struct Cloud {
  std::span<const CloudField> fields;
  std::size_t step = 0;  ///< Length of a point [bytes].
  std::span<const std::byte> points;

  [[nodiscard]] std::size_t count() const { return points.size() / step; }
};

/// A strong echo, in the message's layout.
struct CloudPoint {
  float x = 0, y = 0, z = 0;  ///< [m]
  float intensity = 0;        ///< [dB]
};

/// The sounding of a beam, in the message's layout.
struct SoundingPoint {
  float x = 0, y = 0, z = 0;                        ///< In the frame of the housing [m].
  float intensity = 0;                              ///< Sounding::intensity [dB].
  float uncertainty = 0, quality = 0;               ///< Those of the Sounding.
  std::uint16_t beam = 0;                           ///< Index.
  std::uint8_t detection = 0;                       ///< Sounding::detection as a number.
  std::uint8_t unused = 0;                          ///< Fills up to four bytes.
  std::int32_t snippet_begin = 0, snippet_end = 0;  ///< Those of the Sounding.
};

[[nodiscard]] Cloud cloud_of(std::span<const CloudPoint> points);
[[nodiscard]] Cloud cloud_of(std::span<const SoundingPoint> points);

/// Whether the sounding is at a place: the bottom was found, at a finite range.
[[nodiscard]] bool is_placed(const Sounding& sounding);

/// Intensity as decibels [dB re the source's level at 1 m]; minus infinity for 0.
[[nodiscard]] float decibels_of(float intensity);

/// The points of those soundings that are at a place.
/// @param soundings  [beam]
[[nodiscard]] std::vector<SoundingPoint> sounding_points(std::span<const Sounding> soundings);

/// Sets the soundings of the beams that have a point.
/// @param soundings  [beam], with the azimuths of their beams.
/// @throws Error for a point of a beam that is not there, and for one that was not detected.
void set_soundings(std::span<const SoundingPoint> points, std::span<Sounding> soundings);

}  // namespace insonify

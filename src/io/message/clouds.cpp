// clouds.cpp -- the fields of points; soundings as points, and back.

#include "io/message/clouds.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "insonify/error.h"
#include "insonify/survey/bottom_detection.h"

namespace insonify {
namespace {

constexpr CloudField kPointFields[] = {{"x", offsetof(CloudPoint, x)},
                                       {"y", offsetof(CloudPoint, y)},
                                       {"z", offsetof(CloudPoint, z)},
                                       {"intensity", offsetof(CloudPoint, intensity)}};

constexpr CloudField kSoundingFields[] = {{"x", offsetof(SoundingPoint, x)},
                                          {"y", offsetof(SoundingPoint, y)},
                                          {"z", offsetof(SoundingPoint, z)},
                                          {"intensity", offsetof(SoundingPoint, intensity)},
                                          {"uncertainty", offsetof(SoundingPoint, uncertainty)},
                                          {"quality", offsetof(SoundingPoint, quality)},
                                          {"beam", offsetof(SoundingPoint, beam), CloudType::kUint16},
                                          {"detection", offsetof(SoundingPoint, detection), CloudType::kUint8},
                                          {"snippet_begin", offsetof(SoundingPoint, snippet_begin), CloudType::kInt32},
                                          {"snippet_end", offsetof(SoundingPoint, snippet_end), CloudType::kInt32}};

}  // namespace

Cloud cloud_of(std::span<const CloudPoint> points) {
  return {kPointFields, sizeof(CloudPoint), std::as_bytes(points)};
}

Cloud cloud_of(std::span<const SoundingPoint> points) {
  return {kSoundingFields, sizeof(SoundingPoint), std::as_bytes(points)};
}

bool is_placed(const Sounding& sounding) {
  return sounding.found() && std::isfinite(sounding.range);
}

float decibels_of(float intensity) {
  return static_cast<float>(10 * std::log10(double{intensity}));
}

std::vector<SoundingPoint> sounding_points(std::span<const Sounding> soundings) {
  std::vector<SoundingPoint> points;
  for (std::size_t beam = 0; beam < soundings.size(); ++beam) {
    const Sounding& sounding = soundings[beam];
    if (!is_placed(sounding)) {
      continue;
    }
    const Vec3 place = position_of(sounding, Pose());
    points.push_back({.x = static_cast<float>(place.x()),
                      .y = static_cast<float>(place.y()),
                      .z = static_cast<float>(place.z()),
                      .intensity = decibels_of(sounding.intensity),
                      .uncertainty = sounding.uncertainty,
                      .quality = sounding.quality,
                      .beam = static_cast<std::uint16_t>(beam),
                      .detection = static_cast<std::uint8_t>(sounding.detection),
                      .snippet_begin = sounding.snippet_begin,
                      .snippet_end = sounding.snippet_end});
  }
  return points;
}

void set_soundings(std::span<const SoundingPoint> points, std::span<Sounding> soundings) {
  for (const SoundingPoint& point : points) {
    const auto detection = static_cast<Detection>(point.detection);
    if (point.beam >= soundings.size() || (detection != Detection::kAmplitude && detection != Detection::kPhase)) {
      throw Error(
          fmt::format("its soundings have a point of beam {} and detection {}, must be of a beam below {} and "
                      "detection 1 or 2",
                      point.beam, point.detection, soundings.size()));
    }
    Sounding& sounding = soundings[point.beam];
    sounding.range = static_cast<float>(std::hypot(double{point.x}, double{point.y}, double{point.z}));
    sounding.intensity = static_cast<float>(std::pow(10, double{point.intensity} / 10));
    sounding.uncertainty = point.uncertainty;
    sounding.quality = point.quality;
    sounding.snippet_begin = point.snippet_begin;
    sounding.snippet_end = point.snippet_end;
    sounding.detection = detection;
  }
}

}  // namespace insonify

// bottom_detection.h -- finds the bottom in each beam of a multibeam's pings, by amplitude and by phase.

#pragma once

#include <span>
#include <vector>

#include "insonify/acoustics/sound_speed_profile.h"
#include "insonify/ping.h"
#include "insonify/sonar_config.h"
#include "insonify/sounding.h"

namespace insonify {

struct BeamEcho;
struct Snippet;

struct BottomDetectionOptions {
  double least_range = 0;       ///< Nearest range at which a bottom is looked for [m], >= 0.
  double greatest_range = 1e5;  ///< Farthest [m], > least_range.
  double resolution = 0;        ///< Length along range over which echoes are one [m]: that of the pulse, as
                                ///< Pulse::equivalent_length(); at least a bin.
};

/// Detects the bottom of pings (docs/concepts/multibeam.md). From the beams below the sonar outwards, each echo is
/// looked for around the depth of the beams before it, and beyond the ring of side lobes at the range of the first. In
/// its snippet, where the smoothed intensity is within 10 dB of
/// its peak, the bottom is where the intensity has its centre, or where a line through the phases of Ping::phase
/// crosses 0, whichever is less uncertain (Lurton, An Introduction to Underwater Acoustics (2010), section 8.3).
class BottomDetector {
 public:
  /// @throws Error for a sonar that is not a multibeam, and for options out of limits.
  explicit BottomDetector(const SonarConfig& sonar, const BottomDetectionOptions& options = {});

  /// The bottom in each beam; not found where no echo is 10 dB above the beam's median, where one is cut by the first
  /// or the last bin, and where a beam looks up.
  /// @throws Error for a ping of another shape than the sonar's.
  [[nodiscard]] std::vector<Sounding> detect(const Ping& ping) const;

  /// The same into a vector that is used again.
  void detect(const Ping& ping, std::vector<Sounding>& soundings) const;

 private:
  void set(Sounding& sounding, std::span<const float> intensity, const BeamEcho& echo) const;
  [[nodiscard]] int footprint(int beam, double depth, double cosine) const;
  [[nodiscard]] Snippet gate(double depth, double cosine) const;
  [[nodiscard]] bool is_cut(const Snippet& snippet) const;
  [[nodiscard]] double range_of(double place) const { return sonar_.min_range + place * sonar_.bin_length(); }

  SonarConfig sonar_;
  BearingGrid beams_;
  int first_bin_, last_bin_;  // Searched: [first, last).
  int resolution_, smooth_;   // Bins that are one sample; length of the moving mean [bins], odd.
};

/// Position of a sounding in the world, along a straight ray.
/// @param world_from_sonar  Pose of the beams: Ping::world_from_sonar.
/// @param range_scale       True range / range shown: true sound speed / assumed.
[[nodiscard]] Vec3 position_of(const Sounding& sounding, const Pose& world_from_sonar, double range_scale = 1);

/// The same along the ray that a profile bends, which need not be the true one.
/// @param surface_level  Height of the surface, from which the profile's depths count [m].
/// @param shown_speed    Sound speed by which the sonar shows ranges: SonarConfig::assumed_sound_speed [m/s].
[[nodiscard]] Vec3 position_of(const Sounding& sounding, const Pose& world_from_sonar, const SoundSpeedProfile& profile,
                               double surface_level, double shown_speed);

}  // namespace insonify

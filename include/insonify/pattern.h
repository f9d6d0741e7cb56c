// pattern.h -- how a vehicle surveys an area: parallel lines, turns between them, and the unsteadiness of its motion.

#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "insonify/geometry.h"
#include "insonify/settings_table.h"
#include "insonify/words.h"

namespace insonify {

/// Pitch of the vehicle: along the slope of its path, or none.
enum class PitchControl { kFollow, kLevel };
template <>
constexpr auto words_of<PitchControl>() {
  return EnumWords<PitchControl, 2>{{{"follow", PitchControl::kFollow}, {"level", PitchControl::kLevel}}};
}

/// Whether the sonars ping between lines.
enum class TurnPings { kPing, kSkip };
template <>
constexpr auto words_of<TurnPings>() {
  return EnumWords<TurnPings, 2>{{{"ping", TurnPings::kPing}, {"skip", TurnPings::kSkip}}};
}

/// Shape of the spectrum of a vehicle's motion; see motion_spectrum().
enum class MotionSpectrum { kSwell, kTowfish, kAuv };
template <>
constexpr auto words_of<MotionSpectrum>() {
  return EnumWords<MotionSpectrum, 3>{
      {{"swell", MotionSpectrum::kSwell}, {"towfish", MotionSpectrum::kTowfish}, {"auv", MotionSpectrum::kAuv}}};
}

/// Parallel lines over a rectangle, flown to and fro at constant speed over ground.
///
///       corner + length           Line 1 is the one furthest to starboard, flown along `yaw`; line 2, next to it to
///       +---2-----1--+            port, comes back. Lines are `spacing` apart, centred on the area. Between two, the
///       |   |     ^  |            vehicle turns by arcs of `turn_radius`.
///       |   v     |  |
///       +------------corner
struct SurveyLines {
  std::vector<double> center = {};         ///< Middle of the area, x and y [m], within 1e7; empty: `corner` is given.
  std::vector<double> corner = {};         ///< Its corner beside the start of line 1, x and y [m], within 1e7.
  double length = 100;                     ///< Of the area along the lines [m], in (0, 1e6].
  double width = 0;                        ///< Across the lines [m], 0..1e6; 0: a single line.
  double yaw = 0;                          ///< Of line 1 [rad], within 1e6 deg: 0 along x, 90 deg along y.
  std::optional<double> altitude = {};     ///< Height of the vehicle above the bed [m], in (0, 1e5].
  std::optional<double> height = {};       ///< Instead: its height in the world, z [m], within 1e7.
  std::optional<double> spacing = {};      ///< Between lines [m], in (0, 1e6].
  std::optional<double> overlap = {};      ///< Instead: share of the swath that the next line covers too, 0..0.95.
  double speed = 1.5;                      ///< Over ground [m/s], in (0, 50].
  std::optional<double> turn_radius = {};  ///< [m], in (0, 1e4]; absent: half of the spacing.
  TurnPings turns = TurnPings::kPing;
  double run_in = 0;                            ///< Straight stretch before and after each line [m], 0..1e4.
  double max_pitch = radians_from_degrees(20);  ///< Steepest climb and descent [rad], in (0, 80 deg].
  PitchControl pitch = PitchControl::kFollow;
  double vehicle_length = 2;           ///< Length over which the climb is averaged [m], in (0, 100].
  std::optional<double> ceiling = {};  ///< What is above this height is not the bed: ships, piers, ice [m], within 1e7.

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit);
};

/// Unsteadiness of a vehicle on its path: independent random motions in five directions, each of an exact rms.
struct MotionNoise {
  double roll = 0;   ///< Rms [rad], 0..90 deg.
  double pitch = 0;  ///< Rms [rad], 0..45 deg.
  double yaw = 0;    ///< Rms [rad], 0..90 deg.
  double sway = 0;   ///< Rms across the line [m], 0..100.
  double heave = 0;  ///< Rms of the height [m], 0..100.
  MotionSpectrum spectrum = MotionSpectrum::kAuv;
  std::optional<double> period =
      {};                        ///< Time scale of the spectrum [s], 0.5..1000; absent: 8 (swell), 5 (towfish, auv).
  std::optional<int> seed = {};  ///< Absent: the scenario's.

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"roll", "rad", from_to(0, radians_from_degrees(90)), "Rms of the roll."}, self.roll);
    visit(Field{"pitch", "rad", from_to(0, radians_from_degrees(45)), "Rms of the pitch."}, self.pitch);
    visit(Field{"yaw", "rad", from_to(0, radians_from_degrees(90)), "Rms of the yaw about the path's."}, self.yaw);
    visit(Field{"sway", "m", from_to(0, 100), "Rms of the distance from the line, across it."}, self.sway);
    visit(Field{"heave", "m", from_to(0, 100), "Rms of the height about the path's."}, self.heave);
    visit(Field{"spectrum",
                "",
                {},
                "Spectrum of the motions: swell (Pierson-Moskowitz), towfish (a damped resonance) or auv "
                "(Gauss-Markov)."},
          self.spectrum);
    visit(Field{"period", "s", from_to(0.5, 1000),
                "Peak period of swell (8 when absent), resonance of a towfish (5), correlation time of an auv (5)."},
          self.period);
    visit(Field{"seed", "", at_least(0), "Seed of the motions; the scenario's when absent."}, self.seed);
  }
};

/// A survey, from which flown() makes the vehicle's trajectory once the scene is loaded.
struct SurveyPattern {
  SurveyLines lines = {};
  std::optional<MotionNoise> motion_noise = {};  ///< Absent: none.

  /// Checks what does not depend on the scene.
  /// @throws Error for values out of limits, and where two keys say the same or none says it.
  void validate(std::string_view object) const;

  template <typename Self, typename Visit>
  static void visit_fields(Self& /*self*/, Visit&& /*visit*/) {}

  template <typename Self, typename Visit>
  static void visit_parts(Self& self, Visit&& visit) {
    visit(Part{"lines", "map", "Parallel lines over an area: see `lines`.",
               "Parallel lines over a rectangle, to and fro, centred on it. Line 1 is the one furthest to starboard."},
          self.lines);
    visit(Part{"motion_noise", "map", "Unsteady motion of the vehicle; none when absent: see `motion_noise`.",
               "Random motions of the vehicle about its path, each of an exact rms ([spectra](../how-to/survey.md))."},
          self.motion_noise);
  }
};

/// Times at which sonars ping.
struct PingSpan {
  double begin = 0;  ///< Time of the first ping [s], 0..1e9.
  double end = 1;    ///< Pings are before this time [s], > begin, <= 1e9.

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"begin", "s", from_to(0, 1e9), "Time of the span's first ping."}, self.begin);
    visit(Field{"end", "s", above_to(0, 1e9), "Its pings are before this time."}, self.end);
  }
};

// ---------------------------------------------------------------------------------------------------------------------

template <typename Self, typename Visit>
void SurveyLines::visit_fields(Self& self, Visit&& visit) {
  visit(Field{"center", "m", coordinate(), "Middle of the area: [x, y]. Or `corner`."}, self.center);
  visit(Field{"corner", "m", coordinate(),
              "Corner of the area beside the start of line 1: [x, y]. The area lies ahead of it and to port."},
        self.corner);
  visit(Field{"length", "m", above_to(0, 1e6), "Of the area along the lines."}, self.length);
  visit(Field{"width", "m", from_to(0, 1e6), "Of the area across the lines; 0 is a single line."}, self.width);
  visit(Field{"yaw", "rad", turn(), "Direction of line 1: 0 along x, 90 along y."}, self.yaw);
  visit(Field{"altitude", "m", above_to(0, 1e5), "Height of the vehicle above the bed, which it follows. Or `height`."},
        self.altitude);
  visit(Field{"height", "m", coordinate(), "Constant height of the vehicle in the world (z)."}, self.height);
  visit(Field{"spacing", "m", above_to(0, 1e6), "Distance between lines. Or `overlap`."}, self.spacing);
  visit(Field{"overlap", "", from_to(0, 0.95),
              "Share of the swath that the next line covers too; the swath is that of the first sonar that has one "
              "(type sss or mbes) at this altitude."},
        self.overlap);
  visit(Field{"speed", "m/s", above_to(0, 50), "Speed over ground."}, self.speed);
  visit(Field{"turn_radius", "m", above_to(0, 1e4),
              "Radius of the turns; half of the spacing when absent. A wider one swings out before it turns back."},
        self.turn_radius);
  visit(Field{"turns", "", {}, "Whether the sonars ping during turns (ping) or on lines only (skip)."}, self.turns);
  visit(Field{"run_in", "m", from_to(0, 1e4), "Straight stretch before and after each line, so that it begins steady."},
        self.run_in);
  visit(Field{"max_pitch", "rad", above_to(0, radians_from_degrees(80)),
              "Steepest climb and descent; over steeper ground the vehicle climbs ahead of it."},
        self.max_pitch);
  visit(Field{"pitch", "", {}, "Whether the vehicle pitches along its path (follow) or stays level (level)."},
        self.pitch);
  visit(Field{"vehicle_length", "m", above_to(0, 100), "Length over which climb and descent are averaged."},
        self.vehicle_length);
  visit(Field{"ceiling", "m", coordinate(),
              "What is above this height (z) is not the bed: ships, piers, the roof of a tank."},
        self.ceiling);
}

}  // namespace insonify

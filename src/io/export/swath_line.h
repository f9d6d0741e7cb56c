// swath_line.h -- recordings of multibeams as survey files have them: the soundings of each ping around its navigation.

#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "insonify/acoustics/sound_speed_profile.h"
#include "insonify/sounding.h"
#include "io/export/navigation.h"

namespace insonify {

/// What a survey file says of a sonar.
struct SwathSonar {
  SonarConfig config;
  ReceiverConfig receiver;
  double sound_speed = 0;   ///< Converts time to range [m/s]: as the sonar assumes it.
  double absorption = 0;    ///< [dB/m], one way.
  bool calibrated = false;  ///< Whether SwathBeam::level_db is that of the echo re 1 uPa.
  double surface = 0;       ///< Height of the water's surface in the world [m].
  double ping_period = 0;   ///< Mean time between pings [s]; of a single ping, the time that it takes.
};

/// The sounding of a beam. Without one all but the angles is 0.
struct SwathBeam {
  Sounding sounding;
  Vec3 position = Vec3::Zero();  ///< In the world [m].
  double ahead = 0;              ///< Horizontally from the sonar in the direction of its heading [m].
  double starboard = 0;          ///< Horizontally to its right [m].
  double below = 0;              ///< Below the sonar [m].
  double depth = 0;              ///< Below z = 0 of the world [m].
  double travel_time = 0;        ///< There and back [s].
  double angle = 0;              ///< Of the beam from straight down [deg], 0..180.
  double bearing = 0;            ///< From starboard over ahead [deg], 0..360.

  double level_db = 0;  ///< Without gain; in the calibrated model re 1 uPa, else re full scale.

  // Parts of the range's standard deviation [m].
  double vertical_deviation = 0, horizontal_deviation = 0;
};

struct SwathPing : Navigation {
  std::uint64_t number = 0;
  double z = 0;  ///< Of the sonar in the world [m].
  std::vector<SwathBeam> beams;
  Vec3 velocity = Vec3::Zero();  ///< In the world [m/s].

  [[nodiscard]] std::size_t found() const;  ///< Beams with a sounding.
};

/// Extent of the soundings of a file.
struct SwathExtent {
  std::uint64_t found = 0;
  std::uint64_t first_ns = std::numeric_limits<std::uint64_t>::max(), last_ns = 0;  ///< Times of the pings.
  Eigen::AlignedBox3d places;  ///< Of SwathLine::place_of() and depth below z = 0, where `found` > 0.
};

/// The pings of several multibeams of one run. Positions follow from the sound speed that the sonar assumes, as those
/// that the instrument would write, or from the rays of ExportOptions::profile.
class SwathLine {
 public:
  /// Reads all pings once, for the tracks and the extent.
  /// @throws Error for a recording without soundings, and for a profile that ends above one.
  SwathLine(RecordedSonars recordings, const ExportOptions& options);

  [[nodiscard]] const std::vector<SwathSonar>& sonars() const { return sonars_; }
  [[nodiscard]] const SwathExtent& extent() const { return extent_; }

  /// East and north [m] or longitude and latitude [deg].
  [[nodiscard]] std::array<double, 2> place_of(const Vec3& point) const { return navigator_.place_of(point); }

  /// Depths and sound speeds of the processing: two points of one speed without ExportOptions::profile.
  [[nodiscard]] std::vector<std::array<double, 2>> profile(const SwathSonar& sonar) const;

  /// Gives all pings in the order of their times.
  void for_each(const std::function<void(std::size_t sonar, const SwathPing& ping)>& take) const;

 private:
  void survey(const RecordedTables& recording);
  [[nodiscard]] SwathPing described(std::size_t sonar, const Ping& ping) const;

  RecordedSonars recordings_;
  ExportOptions options_;
  Navigator navigator_;
  std::optional<SoundSpeedProfile> profile_;
  std::vector<SwathSonar> sonars_;
  std::vector<Track> tracks_;
  SwathExtent extent_;
};

}  // namespace insonify

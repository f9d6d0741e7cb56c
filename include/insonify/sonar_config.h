// sonar_config.h -- configuration of a sonar: beams, range bins, transmitter, scanning head and mounting.

#pragma once

#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "insonify/bearing_grid.h"
#include "insonify/geometry.h"
#include "insonify/receiver_config.h"
#include "insonify/scan.h"
#include "insonify/settings_table.h"
#include "insonify/sonar/sampling.h"
#include "insonify/words.h"

namespace insonify {

/// Largest elevation that is sampled, up or down [rad]: straight up every azimuth is the same direction.
inline constexpr double kSteepestElevation = radians_from_degrees(89);

/// Largest width at half power of a transmitter or an element across bearings [rad]; that of a short line tends to 180.
inline constexpr double kWidestElement = radians_from_degrees(175);

/// Forward-looking: each ping insonifies the whole fan. Mechanically scanned: one beam, turned by a step after each
/// ping. Side-scan: two beams, narrow along the track and tall, one to port and one to starboard. Multibeam: a fan
/// across the track that looks down, narrow along it, in each of whose beams the bottom is detected.
enum class SonarType { kForwardLooking, kMechanicallyScanned, kSideScan, kMultibeam };
template <>
constexpr auto words_of<SonarType>() {
  return EnumWords<SonarType, 4>{{{"fls", SonarType::kForwardLooking},
                                  {"msis", SonarType::kMechanicallyScanned},
                                  {"sss", SonarType::kSideScan},
                                  {"mbes", SonarType::kMultibeam}}};
}

/// What the pings of a sonar make: each the picture of a fan, or lines of one picture: sectors of a plan or a slice, or
/// rows of a waterfall.
enum class Product { kImage, kLine, kWaterfall };
template <>
constexpr auto words_of<Product>() {
  return EnumWords<Product, 3>{
      {{"image", Product::kImage}, {"line", Product::kLine}, {"waterfall", Product::kWaterfall}}};
}

/// How the beams of a multibeam are spaced: at equal angles, or at equal distances on a level bottom.
enum class BeamSpacing { kEquiangular, kEquidistant };
template <>
constexpr auto words_of<BeamSpacing>() {
  return EnumWords<BeamSpacing, 2>{
      {{"equiangular", BeamSpacing::kEquiangular}, {"equidistant", BeamSpacing::kEquidistant}}};
}

/// How a fan's beams get their directions: by delays between elements, or by a lens.
enum class Steering { kElectronic, kLens };
template <>
constexpr auto words_of<Steering>() {
  return EnumWords<Steering, 2>{{{"electronic", Steering::kElectronic}, {"lens", Steering::kLens}}};
}

/// How an instrument maps intensities to counts: a power of amplitude, or decibels.
enum class Mapping { kGamma, kLogarithmic };
template <>
constexpr auto words_of<Mapping>() {
  return EnumWords<Mapping, 2>{{{"gamma", Mapping::kGamma}, {"logarithmic", Mapping::kLogarithmic}}};
}

/// An imaging sonar seen as beams cut into range bins.
///
/// One ping insonifies the whole fan at once. Each beam collects the echoes of its own slice of azimuth over the full
/// elevation aperture and sorts them by range into bins.
///
///       azimuth > 0 (port)
///             \   |   /          Sonar frame, right-handed: x along the acoustic axis,
///              \  |  /           y to port, z up.
///        beam 0 \ | / beam N-1   Beam 0 is the one furthest to port.
struct SonarConfig {
  std::string name = "sonar";  ///< Used in messages and file names.
  std::string model;           ///< Make and model of the instrument, for titles; may be empty.
  SonarType type = SonarType::kForwardLooking;

  double frequency = 720e3;                  ///< Carrier frequency [Hz], in (0, 1e8].
  double source_level_db = 200;              ///< SL on the acoustic axis [dB re 1 uPa at 1 m], 100..260.
  double bandwidth = 25e3;                   ///< Receiver bandwidth, for noise, without a pulse [Hz], in (0, 1e8].
  std::optional<double> self_noise_db = {};  ///< Noise of its electronics, as the isotropic noise of the water that
                                             ///< would be as strong [dB re 1 uPa^2/Hz], -100..200; absent: none.

  // What the instrument transmits; ReceiverConfig::pulse may replace it.
  PulseKind pulse = PulseKind::kNone;  ///< kNone: as long as a bin. Not kInstrument.
  double pulse_duration = 50e-6;       ///< Duration, kCw and kLfm [s], in (0, 1].
  double pulse_bandwidth = 200e3;  ///< Bandwidth, kLfm [Hz], in (0, 1e7], < 2 frequency; times pulse_duration >= 10.
  PulseWindow pulse_window = PulseWindow::kRectangular;  ///< Weights of the band, kLfm.

  // Fan of beams.
  int beam_count = 256;                                 ///< Beams across the azimuth aperture, 1..4096; of a
                                                        ///< scanning head 1, of a side-scan sonar 2.
  double azimuth_aperture = radians_from_degrees(120);  ///< Full width of the fan [rad], in (0, 2 pi]; with
                                                        ///< beam_azimuths that of bearings(), see set_bearings(). Of a
                                                        ///< side-scan sonar that of each beam, along the track.
  std::vector<double>
      beam_azimuths;  ///< Explicit centres, falling from port to starboard [rad]; evenly spaced in angle when empty.
  BeamSpacing beam_spacing = BeamSpacing::kEquiangular;  ///< Of a multibeam without beam_azimuths.
  std::vector<double>
      beam_widths;  ///< Full widths of the beams' slices of azimuth, one for all or one for each [rad],
                    ///< in (0, 2 pi]; narrower ones than the spacing leave gaps. Beams touch when empty.
  std::optional<double> azimuth_resolution;  ///< Full width at half power of the unsteered beam, one way [rad], in
                                             ///< (0, pi/2]; the beam spacing when absent.
  double elevation_aperture = radians_from_degrees(20);  ///< Full height of every beam; at half power, one way, where
                                                         ///< it has an elevation pattern [rad], in (0, 170 deg].
  double elevation_center = 0;                           ///< Middle of the elevation aperture [rad].

  // Directivity of its transducers, besides the array's beams (docs/concepts/array-and-pulse.md).
  BeamPattern elevation_pattern = BeamPattern::kTopHat;  ///< Across elevations, if
                                                         ///< ReceiverConfig::elevation_pattern is kInstrument. Not
                                                         ///< kInstrument.
  BeamPattern transmit_elevation_pattern = BeamPattern::kInstrument;  ///< Transmit pattern; kInstrument: the
                                                                      ///< receiver's.
  std::optional<double> transmit_elevation_aperture =
      {};  ///< Height of the transmitter's pattern, as elevation_aperture
           ///< [rad], in (0, 170 deg]; absent: elevation_aperture.

  // Independent errors of the parts, half a wavelength long, of the arrays across elevations: levels are those that
  // arrays with such errors have on average.
  double elevation_element_error_db = 0;  ///< Standard deviation of amplitudes [dB], 0..20.
  double elevation_element_error = 0;     ///< Standard deviation of phases [rad], 0..180 deg.

  bool two_way_array = false;  ///< Whether the array that makes the beam transmits it too, so that azimuth_pattern
                               ///< applies both ways; one beam only. That of a scanning head always does.
  std::optional<double> transmit_width = {};  ///< Full azimuth width at half power of the transmitter of a fan
                                              ///< [rad], in (0, 175 deg]; absent: omnidirectional in azimuth.
  std::optional<double> element_width = {};   ///< Full azimuth width at half power of one element of a fan's
                                              ///< receiver [rad], in (0, 175 deg]; absent: omnidirectional in azimuth.

  /// Range at which the array's beams are focused [m], at most 1e6 and at least the array's length; absent: at every
  /// range.
  std::optional<double> focus_range = {};

  // Range window.
  int bin_count = 500;        ///< Range bins per beam, 1..65536.
  double min_range = 0.2;     ///< Near edge of bin 0 [m], 0..1e5. Nearer echoes are dropped.
  double max_range = 50.0;    ///< Far edge of the last bin [m], > min_range, <= 1e5.
  double blanking_range = 0;  ///< Near field: the gain rises from 0 at min_range to 1 here [m], 0..1e5.
  double gain = 1.0;          ///< Multiplies the displayed intensity before it is clipped to 1, in (0, 1e9].

  // Transmit leak (docs/concepts/transmit-leak.md).
  std::optional<double> leak_db = {};  ///< Level of the outgoing pulse in the receiver [dB re the source's at 1 m],
                                       ///< -300..100; absent: no leak.
  double ring_down = 530e3;            ///< Decay of the transducer's ringing after the pulse [dB/s], 1e3..1e9.
  double leak_spread_db = 0;           ///< Standard deviation of the leak's level between beams, or
                                       ///< directions of a scanning head [dB], 0..20.
  double dead_range = 0;               ///< No echo and no noise is received nearer than this [m], 0..1e5.

  // Channels of the receiver (docs/concepts/channels.md).
  std::vector<double> group_gains_db = {};  ///< Gains of equal groups of neighbouring beams, one value per group, from
                                            ///< port [dB], -300..60; at most one per beam.
  std::vector<int> missing_beams = {};      ///< Indices of beams that deliver nothing, from 0 at port.
  std::optional<double> crosstalk_db = {};  ///< Share of all beams' echoes that each beam receives besides its own
                                            ///< [dB], -200..0; absent: none.

  // Counts, if ReceiverConfig::counts asks for them.
  int bits = 8;  ///< Bits of a count, 1..16.
  Mapping mapping = Mapping::kLogarithmic;
  double mapping_range_db = 60;  ///< kLogarithmic: range from count 0 to full scale [dB], in (0, 300].
  double mapping_exponent = 1;   ///< kGamma: exponent of amplitude, in (0, 4].

  // Time.
  std::optional<double> assumed_sound_speed;  ///< Converts time to range [m/s], 1300..1700; absent: the true one.
  Steering steering = Steering::kElectronic;  ///< kElectronic: bearings depend on assumed_sound_speed too. kLens: beams
                                              ///< have transducers of their own, of independent noise. Fans only.
  std::optional<double> ping_period;          ///< Time between pings [s], 2 max_range / c (when absent) to 1e6.

  RotatingScan head;  ///< How the head turns; scanning sonars only.

  /// Angle of both sides' acoustic axes below the housing's x-y plane [rad], 0..90 deg; side-scan sonars only.
  double depression = radians_from_degrees(30);

  // What beams are steered against, as motion sensors measure it; multibeams only (docs/concepts/multibeam.md).
  bool roll_stabilised = false;   ///< Beams stay at their angles from the vertical.
  bool pitch_stabilised = false;  ///< The swath stays vertical.
  bool yaw_stabilised = false;    ///< The swath stays across the course.

  // Pose on the vehicle, or in the world if there is no trajectory.
  Vec3 position = Vec3::Zero();     ///< [m], within 1e7.
  Vec3 orientation = Vec3::Zero();  ///< Roll, pitch, yaw as in SDF: positive pitch looks down [rad], within 1e6 deg.

  Sampling sampling;

  /// Receiver of this instrument; absent: that of the scenario, from which a file's `receiver` of a sonar starts.
  std::optional<ReceiverConfig> receiver = {};

  [[nodiscard]] double bin_length() const { return (max_range - min_range) / bin_count; }           ///< [m]
  [[nodiscard]] double bin_range(int bin) const { return min_range + (bin + 0.5) * bin_length(); }  ///< Centre [m].

  /// The pulse that this sonar transmits with a receiver: the receiver's pulse, or the sonar's own if that is
  /// kInstrument. Side lobes of a kTaylor window are the receiver's.
  [[nodiscard]] PulseSettings transmitted(const ReceiverConfig& with) const;

  /// The elevation pattern with a receiver: the receiver's, or the sonar's own if that is kInstrument.
  [[nodiscard]] BeamPattern elevation_pattern_beside(const ReceiverConfig& with) const {
    return with.elevation_pattern == BeamPattern::kInstrument ? elevation_pattern : with.elevation_pattern;
  }

  /// Pattern and aperture of the transmitter across elevations.
  [[nodiscard]] BeamPattern sent_elevation_pattern(const ReceiverConfig& with) const {
    return transmit_elevation_pattern == BeamPattern::kInstrument ? elevation_pattern_beside(with)
                                                                  : transmit_elevation_pattern;
  }
  [[nodiscard]] double sent_elevation_aperture() const {  ///< [rad]
    return transmit_elevation_aperture.value_or(elevation_aperture);
  }

  /// Whether the array across bearings transmits too.
  [[nodiscard]] bool is_two_way() const { return two_way_array || scans() || is_side_scan(); }

  /// Elevation of the middle of its beams in the frame of the housing [rad].
  [[nodiscard]] double middle_elevation() const { return is_side_scan() ? -depression : elevation_center; }

  /// Whether beams are evenly spaced in angle.
  [[nodiscard]] bool has_even_beams() const {
    return beam_azimuths.empty() && beam_spacing == BeamSpacing::kEquiangular;
  }

  /// Azimuth of the centre of beam `beam` [rad]; falls from port (beam 0) to starboard.
  [[nodiscard]] double beam_azimuth(int beam) const;

  /// The slices of azimuth that the beams cover. Without beam_widths they touch: edges are midway between centres, the
  /// outermost beams extend as far outwards as inwards, and evenly spaced beams fill the aperture exactly. Those of a
  /// side-scan sonar are azimuth_aperture wide, abeam.
  [[nodiscard]] BearingGrid bearings() const;

  /// Sets beam_count, beam_azimuths, beam_widths and azimuth_aperture to those of a grid, which may have gaps:
  /// bearings() is then this grid, but for rounding. A fan's.
  /// @param grid  Slices of azimuth with their centres in the middle, as BearingGrid::even() makes them.
  void set_bearings(const BearingGrid& grid);

  /// The mounting pose, housing to vehicle. A vertical mounting first rolls the housing by +90 deg about its x, so that
  /// its y, towards which the head turns, points up: positive head angles look up. A multibeam first pitches by 90 deg:
  /// its acoustic axis x points down, z ahead.
  [[nodiscard]] Pose vehicle_from_sonar() const;

  /// How its beams turn from ping to ping.
  [[nodiscard]] Scan scan() const { return type == SonarType::kMechanicallyScanned ? Scan(head) : Scan(FixedScan()); }
  [[nodiscard]] bool scans() const { return std::holds_alternative<RotatingScan>(scan()); }

  /// The only type of sonar that has a setting; none where all do.
  /// @param field  Its name: "step".
  [[nodiscard]] static std::optional<SonarType> only_type(std::string_view field);

  [[nodiscard]] bool is_side_scan() const { return type == SonarType::kSideScan; }
  [[nodiscard]] bool is_multibeam() const { return type == SonarType::kMultibeam; }

  /// Whether its beams are cones whatever ReceiverConfig::beam_shape is: their line arrays look straight down too.
  [[nodiscard]] bool has_cones() const { return is_side_scan() || is_multibeam(); }

  /// What its pings make.
  [[nodiscard]] Product product() const {
    return is_side_scan() ? Product::kWaterfall : scans() ? Product::kLine : Product::kImage;
  }

  // Apertures: transducers of one housing that look elsewhere at the same time. Those of a side-scan sonar are its two
  // sides, beams 0 (port) and 1 (starboard) of its pings; any other sonar is one aperture.
  [[nodiscard]] int aperture_count() const { return is_side_scan() ? 2 : 1; }

  /// An aperture as a sonar by itself: the sonar, or a side as a fan of one beam along x.
  [[nodiscard]] SonarConfig aperture(int index) const;

  /// Pose of an aperture: of a side, turned abeam and down by the depression; else that of the housing.
  [[nodiscard]] Pose housing_from_aperture(int index) const;

  /// Angle of the head at a ping, 0 for a forward-looking sonar [rad].
  [[nodiscard]] double head_angle(std::uint64_t ping) const {
    return std::visit([ping](const auto& scan) { return scan.angle(ping); }, scan());
  }

  /// Number of pings per full turn of a scanning head, or per sweep across its sector; 1 for a forward-looking sonar.
  [[nodiscard]] std::uint64_t pings_per_turn() const {
    return std::visit([](const auto& scan) { return scan.pings_per_turn(); }, scan());
  }

  /// Shortest time between pings: sound must return from max_range first [s].
  /// @param sound_speed  Sound speed that the sonar assumes [m/s].
  [[nodiscard]] double shortest_ping_period(double sound_speed) const { return 2 * max_range / sound_speed; }

  /// `sampling`, with absent numbers filled in by the rule of the calibrated model: columns at most a quarter of a
  /// degree apart, 2 to 64 per beam; one row per two bins, 128 to 1024, more for tall fans
  /// (docs/concepts/beams-and-bins.md, "Samples").
  [[nodiscard]] Sampling sampling_by_rule() const;

  /// Checks every field against the limits written beside it, and the rules between fields.
  /// @param object  Name of this sonar in messages.
  /// @throws Error on the first field out of limits; the message carries its name, value and limit.
  void validate(std::string_view object = "sonar") const;

  /// Calls visit(Field, member) on every field, in order; enums and names included. Defined in sonar/sonar_fields.h.
  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit);

  template <typename Self, typename Visit>
  static void visit_parts(Self& self, Visit&& visit) {
    visit(Part{"sampling", "map", "How finely the fan is sampled: see `sampling`.",
               "Part of a sonar. More samples resolve finer detail and take more time."},
          self.sampling);
    visit(
        Part{"receiver", "map",
             "Receiver of this sonar, as `receiver`; its other keys have the values of the scenario's `receiver`.", ""},
        self.receiver);
  }
};

}  // namespace insonify

#include "insonify/sonar/sonar_fields.h"  // SonarConfig::visit_fields

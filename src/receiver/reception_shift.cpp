// reception_shift.cpp -- computes, for each cell in which an echo is received, the cell in which it was sampled.

#include "receiver/reception_shift.h"

#include <algorithm>
#include <cmath>

namespace insonify {
namespace {

// Least cosine of the fan's elevation that a bearing is taken across: straight up there is none.
constexpr double kLeastLevel = 0.1;
constexpr double kPieceTurn = 0.02;  // [rad]: sines are linear within, to 5e-5.
constexpr double kMostUneven = 1.5;  // Ratio of the widths of a head's cells between which energy moves.

}  // namespace

PingMotion motion_between(const Pose& first, const Pose& last, double time) {
  const Eigen::Quaterniond back = first.orientation.conjugate();
  const Eigen::AngleAxisd turn(back * last.orientation);
  const double angle = std::remainder(turn.angle(), 2 * std::numbers::pi);
  return {.velocity = back * ((last.position - first.position) / time), .turn_rate = angle * turn.axis().z() / time};
}

ReceptionShift::ReceptionShift(const BearingCells& cells, const SonarConfig& sonar, double range_scale,
                               double sound_speed, double bias, bool has_array)
    : cells_(cells.grid),
      bins_(sonar.bin_count),
      min_range_(sonar.min_range),
      bin_length_(sonar.bin_length()),
      elevation_(sonar.elevation_center),
      uneven_(!cells.edge_sines.empty()),
      range_scale_(range_scale),
      sound_speed_(sound_speed),
      bias_(bias),
      has_array_(has_array),
      bearing_share_(sonar.is_two_way() ? 0.5 : 1) {}

// Speed of approach v . d towards an azimuth, at the middle of the elevation aperture [m/s].
double ReceptionShift::approach(double azimuth) const {
  const Vec3& v = motion_.velocity;
  return (v.x() * std::cos(azimuth) + v.y() * std::sin(azimuth)) * std::cos(elevation_) + v.z() * std::sin(elevation_);
}

// By how much an echo from an azimuth appears further to starboard because the sonar has moved to port by u t, with t =
// 2 r / c, when it arrives: u t / r, at the middle of the elevation aperture [rad].
double ReceptionShift::parallax(double azimuth) const {
  const Vec3& v = motion_.velocity;
  const double across = v.y() * std::cos(azimuth) - v.x() * std::sin(azimuth);
  const double level_share = std::max(std::cos(elevation_), kLeastLevel);
  return 2 * across / (sound_speed_ * level_share);
}

void ReceptionShift::prepare(const PingMotion& motion, Workers& workers) {
  motion_ = motion;
  source_.resize(static_cast<std::size_t>(cells_.count()) * bins_);
  workers.for_each(cells_.count(), [&](int cell, int) { prepare_cell(cell); });
}

// For each bin of a cell: inverts the equations of the class comment, from reception back to transmission. Azimuth and
// speed of approach are computed at the ends of pieces in which the sonar turns little, and are linear within.
void ReceptionShift::prepare_cell(int cell) {
  struct End {
    double azimuth, speed;
  };
  const double per_bin = 2 * range_scale_ * bin_length_ / sound_speed_;  // Time from bin to bin [s].
  const auto end_at = [&](double bin) {
    const double time = 2 * range_scale_ * range_at(bin + 0.5) / sound_speed_;
    const double shown = cells_.centres[cell] + bearing_share_ * motion_.turn_rate * time;
    const double azimuth = shown + bearing_share_ * parallax(shown);
    return End{azimuth, approach(azimuth)};
  };
  const double turn = bearing_share_ * std::abs(motion_.turn_rate) * per_bin * bins_;
  const int pieces = std::clamp(static_cast<int>(std::ceil(turn / kPieceTurn)), 1, bins_);
  End first = end_at(0);
  int from = cell;
  for (int piece = 0; piece < pieces; ++piece) {
    const int begin = static_cast<int>(std::int64_t{bins_} * piece / pieces);
    const int end = static_cast<int>(std::int64_t{bins_} * (piece + 1) / pieces);
    const End last = end_at(end);
    const double share = 1.0 / (end - begin);
    for (int bin = begin; bin < end; ++bin) {
      const double part = share * (bin - begin);
      from = set_source(cell, bin, first.azimuth + part * (last.azimuth - first.azimuth),
                        first.speed + part * (last.speed - first.speed), from);
    }
    first = last;
  }
}

// Sets the source of one bin. The search for the source cell continues from that of the bin before, since azimuths
// change little from bin to bin.
// @return  The source cell.
inline int ReceptionShift::set_source(int cell, int bin, double azimuth, double speed, int from) {
  from = cells_.last_before(azimuth, from);
  // Cells move whole. The energy of a wide outer cell of a scanning head does not fit a narrow one, nor the other way
  // round: of the far side lobes, what crosses that border is lost.
  const auto fits = [&] {
    const double ratio = cells_.width(cell) / cells_.width(from);
    return ratio < kMostUneven && ratio > 1 / kMostUneven;
  };
  const bool inside = cells_.has(from, azimuth) && (!uneven_ || fits());
  const double received = range_scale_ * range_at(bin + 0.5);
  const double range = (received + bias_ * speed) / (1 - speed / sound_speed_);
  const double position = (range / range_scale_ - min_range_) / bin_length_;
  const bool within = position >= 0 && position < bins_;
  source_[static_cast<std::size_t>(cell) * bins_ + bin] =
      inside && within ? from * bins_ + static_cast<int>(position) : -1;
  return from;
}

DiscreteEcho ReceptionShift::moved(DiscreteEcho echo) const {
  const double range = range_scale_ * range_at(echo.bin + 0.5), azimuth = std::asin(double{echo.bearing_sine});
  const bool is_ours = echo.order > 0;  // Order 0: another sonar's pulse, not timed by ours.
  const double speed = is_ours ? approach(azimuth) : 0;
  const double received = range - speed * (range / sound_speed_ + bias_);
  const double position = (received / range_scale_ - min_range_) / bin_length_;
  const double turned = motion_.turn_rate * 2 * received / sound_speed_;
  const double bearing = azimuth - (is_ours ? bearing_share_ * (parallax(azimuth) + turned) : turned);
  echo.bearing_sine = static_cast<float>(std::sin(bearing));
  const int cell = cells_.last_before(bearing, echo.beam);
  const bool within = position >= 0 && position < bins_ && (has_array_ || cells_.has(cell, bearing));
  echo.bin = within ? static_cast<int>(position) : -1;
  echo.beam = within ? cell : echo.beam;
  return echo;
}

}  // namespace insonify

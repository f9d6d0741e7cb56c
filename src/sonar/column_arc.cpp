// column_arc.cpp -- integrates solid angle and beam pattern numerically along the arc of a lattice column.

#include "sonar/column_arc.h"

#include <algorithm>
#include <cmath>

namespace insonify {
namespace {

constexpr int kSteps = 2048;

// Angle t along the arc of a cone of bearing a at which it reaches an elevation: sin(elevation) = cos a sin t. Where
// the cone does not reach it, t is straight up or down.
double arc_angle(double bearing, double elevation) {
  return std::asin(std::clamp(std::sin(elevation) / std::cos(bearing), -1.0, 1.0));
}

}  // namespace

void ColumnArc::set(BeamShape shape, double bearing, const ElevationPatterns& patterns) {
  const bool wedge = shape == BeamShape::kWedge;
  low_ = wedge ? patterns.low() : arc_angle(bearing, patterns.low());
  high_ = wedge ? patterns.high() : arc_angle(bearing, patterns.high());
  const double step = (high_ - low_) / kSteps, cos_bearing = std::cos(bearing);
  for (std::vector<double>* sums : {&rows_, &sent_, &received_, &both_}) {
    sums->assign(kSteps + 1, 0.0);
  }
  for (int i = 0; i < kSteps; ++i) {
    const double t = low_ + (i + 0.5) * step;
    const double angle = step * (wedge ? std::cos(t) : 1);  // d(solid angle) = cos t da dt, or d(sin a) dt.
    double sent = 1, received = 1, density = 1;
    if (!patterns.is_top_hat()) {
      const double elevation = wedge ? t : std::asin(cos_bearing * std::sin(t));
      received = gain_at(patterns.received(), elevation);
      sent = patterns.differ() ? gain_at(patterns.sent(), elevation) : received;
      density = patterns.envelope(elevation);
    }
    rows_[i + 1] = rows_[i] + step * density;
    sent_[i + 1] = sent_[i] + angle * sent;
    received_[i + 1] = received_[i] + angle * received;
    both_[i + 1] = both_[i] + angle * sent * received;
  }
}

double ColumnArc::at_share(double share) const {
  const double wanted = share * rows_.back();
  const auto above = std::ranges::upper_bound(rows_, wanted);
  if (above == rows_.end()) {
    return high_;
  }
  const auto end = static_cast<double>(above - rows_.begin());
  const double within = (wanted - *(above - 1)) / (*above - *(above - 1));
  return low_ + (end - 1 + within) / kSteps * (high_ - low_);
}

double ColumnArc::integral(const std::vector<double>& sums, double t) const {
  if (!(high_ > low_)) {
    return 0;
  }
  const double at = std::clamp((t - low_) / (high_ - low_) * kSteps, 0.0, static_cast<double>(kSteps));
  const int below = std::min(static_cast<int>(at), kSteps - 1);
  return std::lerp(sums[below], sums[below + 1], at - below);
}

}  // namespace insonify

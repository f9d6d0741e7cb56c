// water_returns.cpp -- sets up two rays per connection, by the point where the surface reflects, and deposits the
// echoes of those that are clear.

#include "echo/cpu/water_returns.h"

#include <algorithm>
#include <cmath>

#include "echo/laws/laws.h"
#include "echo/model/deposit.h"
#include "echo/model/hit.h"

namespace insonify {

WaterReturns::WaterReturns(const CpuScene& scene) : scene_(scene) {
  for (int lane = 0; lane < kPacketSize; ++lane) {
    to_water_.rays.ray.tnear[lane] = to_sonar_.rays.ray.tnear[lane] = kRayClearance;
    for (RayPacket* packet : {&to_water_, &to_sonar_}) {
      packet->set_origin(lane, Vec3f::Zero());
      packet->set_direction(lane, Vec3f::UnitX());
    }
  }
}

void WaterReturns::start(const FlatPlan& plan, const Vec3f& sonar, const Eigen::Matrix3f& axes, bool bent,
                         EchoGrid& grid, std::vector<Echo>& arrivals, std::vector<RayPacket>* log) {
  plan_ = &plan;
  sonar_ = sonar.cast<double>();
  axes_ = axes;
  grid_ = &grid;
  arrivals_ = &arrivals;
  log_ = log;
  any_ = !bent && scene_.water().exists() && plan.model == EchoModel::kCalibrated && plan.max_surfaces > 2;
}

void WaterReturns::connect(const SecondHit& hit, int column, int row, const Echo& echo) {
  const WaterPlane& water = scene_.water();
  if (water.holds(double{hit.mirror.z()})) {
    return;  // It is the first mirror too: MirrorPowers::twice.
  }
  const float weight = water_weight(*plan_, column, row);
  if (weight == 0) {
    return;
  }
  const std::optional<WaterPath> path = WaterPath::of(*plan_, water, sonar_, hit.point.cast<double>());
  const float across = (hit.point - hit.mirror).norm(), there = hit.range + across;
  if (!path || !(0.5 * (double{there} + path->length) < double{plan_->reach()})) {
    return;
  }
  const Vec3f arrival_direction = axes_.transpose() * path->arrival.cast<float>();
  if (!plan_->receives(arrival_direction)) {
    return;
  }
  const Vec3 normal = hit.normal.cast<double>().normalized();
  const double power = water_intensity(*plan_, *path, plan_->scatter.scattering(hit.surface), double{hit.texture},
                                       double{hit.reflected}, normal, hit.direction.cast<double>(), double{there});
  if (!(power > 0)) {
    return;
  }
  Echo one = echo;
  one.order = 3;
  one.path_length = there + static_cast<float>(path->length);
  one.half_length = path_footprint(hit.above, hit.selected, hit.aside,
                                   {across, triple_of(hit.direction), triple_of(normal.cast<float>()),
                                    triple_of((-path->out).cast<float>()), there, static_cast<float>(path->length)})
                        .once;
  one.weight *= weight;
  echoes_[count_] =
      reciprocal_echoes(*plan_, column, row, one, static_cast<float>(power), plan_->arrival_from(arrival_direction));

  to_water_.set_origin(count_, hit.point);
  to_water_.set_direction(count_, path->out.cast<float>());
  to_sonar_.set_origin(count_, path->bounce.cast<float>());
  to_sonar_.set_direction(count_, (-path->arrival).cast<float>());
  to_sonar_.rays.ray.tfar[count_] = static_cast<float>(path->length - path->first) - kRayClearance;
  const auto near = static_cast<float>(path->near);
  to_water_.rays.ray.tfar[count_] = static_cast<float>(path->first) - near;
  to_sonar_.rays.ray.tnear[count_] = near;
  if (++count_ == kPacketSize) {
    finish();
  }
}

void WaterReturns::finish() {
  if (count_ == 0) {
    return;
  }
  for (RayPacket* packet : {&to_water_, &to_sonar_}) {
    packet->set_count(count_);
    if (log_ != nullptr) {
      log_->push_back(*packet);
    }
    sent_ += static_cast<std::uint64_t>(count_);
    scene_.occlude(*packet, nullptr);
  }
  for (int lane = 0; lane < count_; ++lane) {
    if (!to_water_.blocked(lane) && !to_sonar_.blocked(lane)) {
      deposit(*plan_, echoes_[lane].launched, *grid_);
      arrivals_->push_back(echoes_[lane].arriving);
    }
  }
  count_ = 0;
}

}  // namespace insonify

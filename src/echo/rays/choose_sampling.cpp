// choose_sampling.cpp -- counts the probes whose reflected ray may hit something.

#include "echo/rays/choose_sampling.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "echo/laws/laws.h"
#include "echo/model/hit.h"
#include "echo/model/hit_column.h"

namespace insonify {
namespace {

// If at most this share of the hits may give echoes, using all hits takes at most 4/7 of the rays of `all`, return legs
// included, and less than half if some reflected rays hit nothing.
constexpr float kOpen = 0.4F;

// Samples of the lattice per probe.
constexpr int kSamplesPerProbe = 400;
constexpr int kLeastProbes = 8, kMostProbes = 64;

// Columns are evenly spaced from port to starboard; rows follow the golden section, which spaces them evenly too.
Ray probe_ray(const FlatPlan& plan, const Pose& world_from_sonar, int probe, int probes) {
  const Lattice& lattice = plan.lattice;
  const int column =
      static_cast<int>((2 * static_cast<std::int64_t>(probe) + 1) * lattice.columns / (2 * std::int64_t{probes}));
  const std::uint32_t turn = static_cast<std::uint32_t>(probe) * kGoldenTurn;
  const int row = static_cast<int>(static_cast<std::uint64_t>(turn) * static_cast<std::uint64_t>(lattice.rows) >> 32U);
  const ColumnAxes axes = column_axes(lattice, column, Eigen::Matrix3f::Identity());
  const Vec3f direction =
      axes.along * lattice.cosines(column)[row] + axes.up * lattice.sines(column)[row] + axes.beside;
  return {world_from_sonar.position, (world_from_sonar.orientation * direction.cast<double>()).normalized(), 0,
          double{plan.true_max_range}};
}

// The reflected rays of sixteen probes.
struct alignas(64) ReflectedProbes {
  float origin_x[kRayLanes], origin_y[kRayLanes], origin_z[kRayLanes];
  float direction_x[kRayLanes], direction_y[kRayLanes], direction_z[kRayLanes];
  float near[kRayLanes], far[kRayLanes];

  [[nodiscard]] RayLanes lanes() const {
    return {origin_x, origin_y, origin_z, direction_x, direction_y, direction_z, near, far};
  }
};

// Sets one lane to the reflected ray of a hit.
void set_reflected(const FlatPlan& plan, const Ray& ray, const Hit& hit, const Vec3& origin, int lane,
                   ReflectedProbes& probes) {
  const Vec3f from = (ray.origin + hit.distance * ray.direction - origin).cast<float>();
  const Vec3f reflected = (ray.direction - 2 * ray.direction.dot(hit.normal) * hit.normal).cast<float>();
  const float cosine = ray.direction.cast<float>().dot(reflected);
  probes.origin_x[lane] = from.x();
  probes.origin_y[lane] = from.y();
  probes.origin_z[lane] = from.z();
  probes.direction_x[lane] = reflected.x();
  probes.direction_y[lane] = reflected.y();
  probes.direction_z[lane] = reflected.z();
  probes.near[lane] = kRayClearance;
  probes.far[lane] = reflected_reach(static_cast<float>(hit.distance), cosine, plan.reach());
}

}  // namespace

std::span<const Ray> SamplingProbes::aim(const FlatPlan& plan, const Pose& world_from_sonar) {
  rays_.clear();
  if (plan.secondary == SecondaryEchoes::kSelective) {
    const std::int64_t samples = std::int64_t{plan.lattice.columns} * plan.lattice.rows;
    const int count = static_cast<int>(std::clamp<std::int64_t>(samples / kSamplesPerProbe, kLeastProbes, kMostProbes));
    rays_.reserve(kMostProbes);
    for (int probe = 0; probe < count; ++probe) {
      rays_.push_back(probe_ray(plan, world_from_sonar, probe, count));
    }
  }
  hits_.reserve(kMostProbes);
  hits_.resize(rays_.size());
  return rays_;
}

SecondarySampling SamplingProbes::choose_blindly(const FlatPlan& plan) {
  rays_.clear();
  hits_.clear();
  return plan.secondary == SecondaryEchoes::kNone  ? SecondarySampling::kNone
         : plan.secondary == SecondaryEchoes::kAll ? SecondarySampling::kAll
                                                   : SecondarySampling::kSome;
}

SecondarySampling SamplingProbes::choose(const FlatPlan& plan, const Vec3& origin, const BoxCut& boxes) const {
  if (plan.secondary != SecondaryEchoes::kSelective) {
    return plan.secondary == SecondaryEchoes::kAll ? SecondarySampling::kAll : SecondarySampling::kNone;
  }
  int met = 0, may_meet = 0;
  ReflectedProbes reflected = {};
  for (std::size_t first = 0; first < rays_.size(); first += kRayLanes) {
    unsigned lanes = 0;
    for (std::size_t lane = 0; lane < std::min<std::size_t>(kRayLanes, rays_.size() - first); ++lane) {
      if (const Hit& hit = hits_[first + lane]; std::isfinite(hit.distance)) {
        set_reflected(plan, rays_[first + lane], hit, origin, static_cast<int>(lane), reflected);
        lanes |= 1U << lane;
      }
    }
    met += std::popcount(lanes);
    may_meet += std::popcount(boxes.may_meet(reflected.lanes()) & lanes);
  }
  const bool open = met > 0 && static_cast<float>(may_meet) <= kOpen * static_cast<float>(met);
  return open ? SecondarySampling::kAll : SecondarySampling::kSome;
}

}  // namespace insonify

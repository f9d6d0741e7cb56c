// face_glints.cpp -- finds the faces at normal incidence, traces a line of sight to each, and computes its echo.

#include "echo/targets/face_glints.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/vector_math.h"
#include "echo/mirror/face_return.h"
#include "echo/model/coherent_share.h"
#include "echo/targets/fresnel_reach.h"
#include "echo/targets/point_echoes.h"

namespace insonify {
namespace {

constexpr double kLeastShare = 1e-4;  // Least coherent share that counts.
constexpr double kGap = 2e-3;         // Largest distance of a hit on the face from its plane [m].
constexpr double kInside = 0.99;      // Rays to an edge of a face aim at this share of its half length.

// |integral of exp(i pi u^2 / 2) du|^2
double fresnel_square(double from, double to) {
  constexpr double kNarrow = 0.2;
  const double width = to - from, phase = 0.5 * std::numbers::pi * width * 0.5 * (from + to);
  if (width < kNarrow) {  // The phase is nearly linear over the interval.
    const double sinc = std::abs(phase) < 1e-6 ? 1 : std::sin(phase) / phase;
    return width * width * sinc * sinc;
  }
  const FresnelPair low = FresnelPair::of(static_cast<float>(from)), high = FresnelPair::of(static_cast<float>(to));
  const double c = double{high.c} - double{low.c}, s = double{high.s} - double{low.s};
  return c * c + s * s;
}

INSONIFY_VECTOR_CLONES
void find_near(int count, float x, float y, float z, float wavelength, const GlintingFaces::Group& group,
               std::uint8_t* __restrict__ near) {
  const float *const middle_x = group.middle_x.data(), *const middle_y = group.middle_y.data(),
                     *const middle_z = group.middle_z.data();
  const float *const ax = group.first_x.data(), *const ay = group.first_y.data(), *const az = group.first_z.data();
  const float *const bx = group.second_x.data(), *const by = group.second_y.data(), *const bz = group.second_z.data();
  const float *const a_half = group.first_half.data(), *const b_half = group.second_half.data();
  for (int i = 0; i < count; ++i) {
    const float dx = x - middle_x[i], dy = y - middle_y[i], dz = z - middle_z[i];
    const float a = std::abs(dx * ax[i] + dy * ay[i] + dz * az[i]), b = std::abs(dx * bx[i] + dy * by[i] + dz * bz[i]);
    const float distance = std::sqrt(dx * dx + dy * dy + dz * dz);
    const bool is_near = (a < a_half[i] + fresnel_reach(a_half[i], distance, wavelength)) &
                         (b < b_half[i] + fresnel_reach(b_half[i], distance, wavelength));
    near[i] = is_near ? 1 : 0;
  }
}

}  // namespace

double face_glint(const Eigen::Vector2d& foot, const Eigen::Vector2d& half, double distance, double wavelength) {
  const Eigen::Vector2d nearest = foot.cwiseMax(-half).cwiseMin(half);
  const double range = std::hypot(distance, (nearest - foot).norm());
  double sides = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double along = (nearest[axis] - foot[axis]) / range, bend = 1 - along * along;
    const double middle = nearest[axis] - along * range / bend;  // Point of stationary phase.
    const double scale = 2 * std::sqrt(bend / (wavelength * range));
    sides *= fresnel_square((-half[axis] - middle) * scale, (half[axis] - middle) * scale) / bend;
  }
  const double cosine = distance / range;
  return sides * cosine * cosine / (16 * range * range);
}

FaceGlints::FaceGlints(std::shared_ptr<const GlintingFaces> faces) : faces_(std::move(faces)) {
  if (faces_ && faces_->any()) {
    std::size_t most = 0;
    for (const GlintingFaces::Group& group : faces_->groups) {
      most = std::max(most, group.surface.size());
    }
    near_.resize(most);
    shown_.resize(faces_->count());
    glints_.reserve(GlintingFaces::kMostTogether);
    rays_.reserve(GlintingFaces::kMostTogether);
    hits_.resize(GlintingFaces::kMostTogether);
    ends_.reserve(GlintingFaces::kMostTogether);
    sight_rays_ = SightRays(GlintingFaces::kMostTogether);
  }
}

// Adds glints and rays of the faces of one instance that are at normal incidence.
void FaceGlints::find(const PingPlan& plan, const Pose& world_from_sonar, const Pose& world_from_mesh,
                      const GlintingFaces::Group& group) {
  const Vec3 sonar = world_from_mesh.inverse() * world_from_sonar.position;
  const Pose sonar_from_mesh = world_from_sonar.inverse() * world_from_mesh;
  const Vec3f at = sonar.cast<float>();
  const auto count = static_cast<int>(group.surface.size());
  find_near(count, at.x(), at.y(), at.z(), plan.wavelength(), group, near_.data());
  for (int i = 0; i < count; ++i) {
    if (near_[i] == 0 || glints_.size() == GlintingFaces::kMostTogether) {
      continue;
    }
    const Vec3 middle = Vec3f(group.middle_x[i], group.middle_y[i], group.middle_z[i]).cast<double>(),
               first = Vec3f(group.first_x[i], group.first_y[i], group.first_z[i]).cast<double>(),
               second = Vec3f(group.second_x[i], group.second_y[i], group.second_z[i]).cast<double>();
    const Vec3 from = sonar - middle;
    const Eigen::Vector2d foot(from.dot(first), from.dot(second)), half(group.first_half[i], group.second_half[i]);
    const double distance = std::abs(from.dot(first.cross(second)));
    const Eigen::Vector2d nearest = foot.cwiseMax(-kInside * half).cwiseMin(kInside * half);
    const Vec3 place = middle + nearest[0] * first + nearest[1] * second;
    const double range = (sonar - place).norm();
    const Vec3f direction = (sonar_from_mesh * place).normalized().cast<float>();
    if (!(distance > kGap) || plan.bin_of(static_cast<float>(range)) < 0 || !plan.receives(direction)) {
      continue;
    }
    const double cosine = distance / range, share = coherent_share(plan, group.surface[i], cosine);
    if (share < kLeastShare) {
      continue;
    }
    const PingPlan::Arrival arrival = plan.arrival_from(direction);
    const double reflectance = plan.scatter.scattering(group.surface[i]).reflectance(std::min(cosine, 1.0));
    glints_.push_back({group.instance, group.first_number + static_cast<std::size_t>(i), range,
                       reflectance * share * face_glint(foot, half, distance, double{plan.wavelength()}) *
                           std::exp(-4 * double{plan.neper_per_metre} * range) * arrival.both_ways(),
                       arrival});
    const Vec3 towards = world_from_sonar.orientation * direction.cast<double>();
    rays_.push_back({world_from_sonar.position, towards.normalized(), 0, range + kGap});
    ends_.push_back({range - kGap, static_cast<std::uint16_t>(group.instance)});
  }
}

void FaceGlints::add(const PingPlan& plan, const Pose& world_from_sonar, std::span<const Pose> world_from_mesh,
                     Engine& engine, EchoGrid& grid) {
  for (const Glint& glint : glints_) {
    shown_[glint.number] = 0;
  }
  glints_.clear();
  rays_.clear();
  ends_.clear();
  if (!faces_ || !faces_->any() || plan.rough_mirrors) {
    return;
  }
  for (const GlintingFaces::Group& group : faces_->groups) {
    find(plan, world_from_sonar, world_from_mesh[group.instance], group);
  }
  sight_rays_.trace(plan, engine, rays_, std::span(hits_).first(rays_.size()), ends_);
  for (std::size_t i = 0; i < glints_.size(); ++i) {
    const Glint& glint = glints_[i];
    if (hits_[i].instance == glint.instance && hits_[i].distance > glint.range - kGap) {
      shown_[glint.number] = 1;
      const double passed = sight_rays_.passed(i);
      add_discrete_echo(plan, glint.arrival, 1, glint.range, glint.intensity * passed * passed,
                        plan.turns_per_metre * glint.range, grid);
    }
  }
}

}  // namespace insonify

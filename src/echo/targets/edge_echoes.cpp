// edge_echoes.cpp -- finds the edges at broadside, asks whether each is hidden, and computes its echo.

#include "echo/targets/edge_echoes.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "acoustics/diffraction.h"
#include "base/vector_math.h"
#include "echo/model/flat_plan.h"
#include "echo/targets/glint_window.h"
#include "echo/targets/point_echoes.h"

namespace insonify {
namespace {

constexpr double kLeastPart = 1e-4;  // Least e^-g that counts.
constexpr double kBefore = 2e-3;     // Hits nearer to an edge than this do not hide it [m].
constexpr double kLobe = 3;          // Half-width of the lobe of a face without a glint [rms slopes of its facets].
constexpr double kEnds = 0.99;       // Rays to an end of an edge aim at this share of its half length.

INSONIFY_VECTOR_CLONES
void find_broadside(int count, float x, float y, float z, float wavelength, const StraightEdges::Group& group,
                    std::uint8_t* __restrict__ near) {
  const float *const middle_x = group.middle_x.data(), *const middle_y = group.middle_y.data(),
                     *const middle_z = group.middle_z.data();
  const float *const ax = group.along_x.data(), *const ay = group.along_y.data(), *const az = group.along_z.data();
  const float *const nx = group.first_x.data(), *const ny = group.first_y.data(), *const nz = group.first_z.data();
  const float *const mx = group.second_x.data(), *const my = group.second_y.data(), *const mz = group.second_z.data();
  const float* const half = group.half.data();
  for (int i = 0; i < count; ++i) {
    const float dx = x - middle_x[i], dy = y - middle_y[i], dz = z - middle_z[i];
    const float along = std::abs(dx * ax[i] + dy * ay[i] + dz * az[i]);
    const float distance = std::sqrt(dx * dx + dy * dy + dz * dz);
    const float first = dx * nx[i] + dy * ny[i] + dz * nz[i], second = dx * mx[i] + dy * my[i] + dz * mz[i];
    const bool is_near =
        (along < half[i] + fresnel_reach(half[i], distance, wavelength)) & ((first > 0) | (second > 0));
    near[i] = is_near ? 1 : 0;
  }
}

// S of wedge_backscatter() for an edge, and the share of it that roughness leaves coherent.
struct EdgeScattering {
  double scattered, share;
};

// @param angle     Of the sonar about the edge from its first face.
// @param distance  From the sonar to the edge's line [m].
// @param range     From the sonar to the edge's nearest point [m].
// @param shown     1 for faces whose glints are shown, which include their terms of the edge.
EdgeScattering edge_scattering(const FlatPlan& plan, const StraightEdges::Edge& edge, double angle, double distance,
                               double range, std::span<const std::uint8_t> shown) {
  double roughness = 0, passed = 0;
  std::array<WedgeFace, 2> faces;
  for (int k = 0; k < 2; ++k) {
    const StraightEdges::Side& side = edge.sides[k];
    const Scattering& scattering = plan.scatter.scattering(side.surface);
    faces[k].angle = k == 0 ? angle : edge.exterior * std::numbers::pi - angle;
    const double cosine = std::min(std::abs(std::sin(faces[k].angle)) * distance / range, 1.0);
    const bool mirrors =
        side.face == StraightEdges::kNoGlint
            ? std::abs(std::tan(0.5 * std::numbers::pi - faces[k].angle)) < kLobe * scattering.rms_slope
            : shown[side.face] != 0;
    faces[k].reflection = mirrors ? 0 : side.sign * std::sqrt(scattering.reflectance(cosine));
    roughness += 0.5 * scattering.roughness;
    passed += 0.5 * std::sqrt(scattering.transmittance(cosine));
  }
  const double share = std::exp(-roughness);
  if (share < kLeastPart) {
    return {0, share};
  }
  // Angle from the specular direction within which the face's glint replaces its term.
  const double mirror = 0.5 * kFresnelReach * std::sqrt(2 / plan.turns_per_metre / range);
  double scattered = wedge_backscatter(edge.exterior, faces, mirror);
  if (passed > 0) {  // The term without R is the shadow's, which transmission fills by T.
    scattered -= passed * wedge_backscatter(edge.exterior, {WedgeFace{faces[0].angle, 0}, {faces[1].angle, 0}}, mirror);
  }
  return {scattered, share};
}

}  // namespace

EdgeEcho edge_integral(double foot, double half, double distance, double wavelength) {
  // Argument u of Fresnel's integrals: 2 k (range - distance) = pi u^2/2, without expanding the range, so that the
  // phases at the ends are exact.
  const auto place = [&](double along) {
    const double range = std::hypot(distance, along);
    return along * std::sqrt(8 / (wavelength * (range + distance)));
  };
  const std::complex<double> sum = fresnel_between(place(-half - foot), place(half - foot));
  const double range = std::hypot(distance, std::max(std::abs(foot) - half, 0.0));
  return {0.5 * std::sqrt(wavelength * distance) * std::abs(sum) / (range * range),
          std::arg(sum) / (2 * std::numbers::pi) - 2 * (range - distance) / wavelength};
}

EdgeEchoes::EdgeEchoes(std::shared_ptr<const StraightEdges> edges, const FaceGlints* glints)
    : edges_(std::move(edges)), glints_(glints), near_(edges_->most_of_a_group()) {}

// Adds the edges of one group that are at broadside, and a ray to each.
void EdgeEchoes::find(const FlatPlan& plan, const Pose& world_from_sonar, const Pose& world_from_group,
                      const StraightEdges::Group& group, RayList& rays) {
  const std::span<const std::uint8_t> shown = glints_ != nullptr ? glints_->shown() : std::span<const std::uint8_t>();
  const Vec3 sonar = world_from_group.inverse() * world_from_sonar.position;
  const Pose sonar_from_group = world_from_sonar.inverse() * world_from_group;
  const Vec3f at = sonar.cast<float>();
  const double wavelength = 2 / plan.turns_per_metre;
  const auto count = static_cast<int>(group.edges.size());
  find_broadside(count, at.x(), at.y(), at.z(), plan.wavelength(), group, near_.data());
  for (int i = 0; i < count && broadside_.size() < kMostTogether; ++i) {
    if (near_[i] == 0) {
      continue;
    }
    const StraightEdges::Edge& edge = group.edges[i];
    const Vec3 from = sonar - edge.middle;
    const double foot = from.dot(edge.along);
    const Vec3 off = from - foot * edge.along;
    const double distance = off.norm();
    const double ahead = edge.sides[0].inwards.dot(off), above = edge.sides[0].normal.dot(off);
    const double angle = std::atan2(above, ahead) + (above < 0 ? 2 * std::numbers::pi : 0.0);
    const Vec3 nearest = edge.middle + std::clamp(foot, -kEnds * edge.half, kEnds * edge.half) * edge.along;
    const double range = std::hypot(distance, std::max(std::abs(foot) - edge.half, 0.0));
    const Vec3f direction = (sonar_from_group * nearest).normalized().cast<float>();
    if (!(distance > kBefore) || angle > edge.exterior * std::numbers::pi ||
        plan.bin_of(static_cast<float>(range)) < 0 || !plan.receives(direction)) {
      continue;
    }
    const auto [scattered, share] = edge_scattering(plan, edge, angle, distance, range, shown);
    if (share < kLeastPart) {
      continue;
    }
    const EdgeEcho echo = edge_integral(foot, edge.half, distance, wavelength);
    const double amplitude = scattered * echo.amplitude;
    const FlatPlan::Arrival arrival = plan.arrival_from(direction);
    broadside_.push_back(
        {range,
         amplitude * amplitude * share * std::exp(-4 * double{plan.neper_per_metre} * range) * arrival.both_ways(),
         echo.turns + (scattered < 0 ? 0.5 : 0.0), arrival});
    const Vec3 towards = world_from_sonar.orientation * direction.cast<double>();
    rays.sights.push_back({world_from_sonar.position, towards.normalized(), 0, std::max(range - kBefore, 0.0)});
  }
}

void EdgeEchoes::find_all(const PingView& view, RayList& rays) {
  for (const StraightEdges::Group& group : edges_->groups) {
    find(*view.plan, view.world_from_sonar, StraightEdges::frame(group, *view.placement), group, rays);
  }
  asked_ = true;
}

void EdgeEchoes::ask(const PingView& view, Workers&, RayList& rays) {
  broadside_.clear();
  asked_ = view.plan->rough_mirrors;
  if (!asked_ && (glints_ == nullptr || glints_->is_done())) {
    find_all(view, rays);
  }
}

void EdgeEchoes::answer(const PingView& view, const RayAnswers& hits, Workers&, RayList& more, EchoList& found) {
  if (!asked_ && glints_->is_done()) {
    find_all(view, more);
    return;
  }
  // Removes hidden edges, and all but the strongest kMostEchoes.
  std::size_t seen = 0;
  for (std::size_t i = 0; i < hits.sights.size(); ++i) {
    if (hits.is_clear(i)) {
      const double passed = hits.passed(i);
      broadside_[seen] = broadside_[i];
      broadside_[seen++].intensity *= passed * passed;
    }
  }
  if (seen > kMostEchoes) {
    broadside_.resize(seen);
    std::ranges::nth_element(broadside_, broadside_.begin() + kMostEchoes, std::greater<>(), &Broadside::intensity);
    seen = kMostEchoes;
  }
  for (const Broadside& edge : std::span(broadside_).first(seen)) {
    add_discrete_echo(*view.plan, edge.arrival, 1, edge.range, edge.intensity,
                      view.plan->turns_per_metre * edge.range + edge.turns, found);
  }
}

}  // namespace insonify

// renderer.cpp -- Lambert shading with haze, a light over the camera's shoulder, and a yellow tint where the sonar
// insonifies.

#include "view/renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "view/underwater_light.h"

namespace insonify {
namespace {

constexpr std::size_t kRaysAtOnce = 1 << 16;
constexpr double kEndClearance = 1e-4;  // Fraction of its length that a ray keeps away from surfaces at its ends.
constexpr double kHazyAt = 2.7;         // Length scale of the haze, in median distances of the surfaces in view.
constexpr double kGrainSize = 0.03;     // Size of the coarsest grain, in median distances.
const Vec3f kLightColour{0.98F, 1.06F, 0.98F};
constexpr unsigned kHousingColour = 0xffc530;
constexpr unsigned kTransducerColour = 0x2a2f36;
constexpr unsigned kInsonifiedColour = 0xffb545;

}  // namespace

Renderer::Renderer(Engine& engine, const Scene& scene, const Camera& camera, const InsonifiedSector& sector,
                   const Housing* housing)
    : engine_(engine), camera_(camera), sector_(sector), housing_(housing) {
  for (const Material& material : scene.materials) {
    tints_.push_back(tint_of(material));
  }
}

std::vector<Renderer::Sample> Renderer::render(std::span<const Point> points) {
  std::vector<Sample> samples(points.size());
  for (std::size_t first = 0; first < points.size(); first += kRaysAtOnce) {
    const std::size_t count = std::min(kRaysAtOnce, points.size() - first);
    render_some(points.subspan(first, count), std::span(samples).subspan(first, count));
  }
  return samples;
}

// The light is directional, over the camera's left shoulder. If a surface is in that direction, as in a tank, the light
// is a lamp in front of that surface.
void Renderer::look_around(int width, int height, double otherwise) {
  Vec3 ahead = camera_.forward() - camera_.forward().z() * Vec3::UnitZ();
  ahead = ahead.norm() > 0.1 ? ahead.normalized() : camera_.up();
  to_light_ = (0.8 * Vec3::UnitZ() - 0.75 * camera_.right() - 0.2 * ahead).normalized();
  rays_.assign(1, {camera_.position(), to_light_});
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 32; ++x) {
      rays_.push_back({camera_.position(), camera_.direction((x + 0.5) * width / 32, (y + 0.5) * height / 24)});
    }
  }
  hits_.resize(rays_.size());
  engine_.trace(rays_, hits_);
  lamp_ = std::isfinite(hits_[0].distance);
  lamp_position_ = camera_.position() + 0.85 * (lamp_ ? hits_[0].distance : 0) * to_light_;

  std::vector<double> distances;
  for (const Hit& hit : std::span(hits_).subspan(1)) {
    if (std::isfinite(hit.distance)) {
      distances.push_back(hit.distance);
    }
  }
  double scale = otherwise;
  if (!distances.empty()) {
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    scale = *middle;
  }
  haze_ = kHazyAt * scale;
  grain_ = kGrainSize * std::exp2(std::round(std::log2(scale)));
}

Ray Renderer::ray_to_light(const Vec3& point) const {
  if (!lamp_) {
    return {point, to_light_, 0};
  }
  const Vec3 way = lamp_position_ - point;
  return {point, way.normalized(), 0, way.norm()};
}

// Calls run(i) for each i in 0..count.
template <typename Run>
void Renderer::for_each(std::size_t count, const Run& run) {
  constexpr std::size_t kTogether = 1024;
  workers_.for_each(static_cast<int>((count + kTogether - 1) / kTogether), [&](int task, int) {
    const std::size_t first = static_cast<std::size_t>(task) * kTogether;
    for (std::size_t i = first; i < std::min(count, first + kTogether); ++i) {
      run(i);
    }
  });
}

void Renderer::render_some(std::span<const Point> points, std::span<Sample> samples) {
  rays_.resize(points.size());
  hits_.resize(points.size());
  spots_.resize(points.size());
  for_each(points.size(), [&](std::size_t i) {
    rays_[i] = {camera_.position(), camera_.direction(points[i].x, points[i].y)};
  });
  engine_.trace(rays_, hits_);
  for_each(points.size(), [&](std::size_t i) { spots_[i] = spot_at(i); });
  trace_second_rays();
  for_each(points.size(), [&](std::size_t i) { samples[i] = shade(i); });
}

// Position, incidence of light and sector of a hit. Occlusion follows in trace_second_rays().
Renderer::Spot Renderer::spot_at(std::size_t i) const {
  Spot spot;
  if (std::isfinite(hits_[i].distance)) {
    spot.point = rays_[i].origin + hits_[i].distance * rays_[i].direction;
    spot.lit = hits_[i].normal.dot(ray_to_light(spot.point).direction);
    spot.inside_by = housing_ != nullptr ? sector_.inside_by(spot.point) : -1;
  }
  return spot;
}

// Traces occlusion rays: from the points to the light, and from the sonar to the points.
void Renderer::trace_second_rays() {
  second_rays_.clear();
  const Vec3& sonar = sector_.world_from_sonar().position;
  for (std::size_t i = 0; i < spots_.size(); ++i) {
    Spot& spot = spots_[i];
    const double clear = kEndClearance * hits_[i].distance;
    if (spot.lit > 0) {
      spot.light_ray = static_cast<int>(second_rays_.size());
      second_rays_.push_back(ray_to_light(spot.point));
      second_rays_.back().min_distance = clear;
    }
    if (spot.inside_by > 0) {
      const Vec3 way = spot.point - sonar;
      spot.sonar_ray = static_cast<int>(second_rays_.size());
      second_rays_.push_back({sonar, way.normalized(), 0, way.norm() - 10 * clear});
    }
  }
  second_hits_.resize(second_rays_.size());
  engine_.trace(second_rays_, second_hits_);
}

bool Renderer::is_clear(int second) const {
  return second >= 0 && !std::isfinite(second_hits_[second].distance);
}

Renderer::Sample Renderer::shade(std::size_t i) const {
  const Ray& ray = rays_[i];
  const Hit& hit = hits_[i];
  const Vec3f water = water_colour(ray.direction);
  if (housing_ != nullptr) {
    const Housing::Cut cut = housing_->cut(ray);
    if (cut.distance < hit.distance) {
      const Vec3f tint = linear_colour(cut.transducer ? kTransducerColour : kHousingColour);
      const auto lit = static_cast<float>(std::max(0.0, cut.normal.dot(to_light_)));
      return {screen_colour(tint.cwiseProduct(1.3F * ambient_light(cut.normal) + Vec3f::Constant(0.75F * lit))),
              static_cast<float>(cut.distance)};
    }
  }
  if (!std::isfinite(hit.distance)) {
    return {screen_colour(water), std::numeric_limits<float>::infinity()};
  }
  const Spot& spot = spots_[i];
  Vec3f light = ambient_light(hit.normal);
  if (is_clear(spot.light_ray)) {
    light += static_cast<float>(spot.lit) * kLightColour;
  }
  // Grain fades with distance, where it would be finer than pixels.
  const auto grain = static_cast<float>(0.13 / (1 + hit.distance / haze_)) * value_noise(spot.point, grain_);
  Vec3f colour = (1 + grain) * tint(hit).cwiseProduct(light);
  // Surfaces seen at grazing angles reflect the colour of the water.
  const auto flat = static_cast<float>(1 - std::min(1.0, -hit.normal.dot(ray.direction)));
  colour += 0.16F * flat * flat * flat * flat * water_colour(hit.normal);
  if (is_clear(spot.sonar_ray)) {
    const Vec3 from_sonar = (spot.point - sector_.world_from_sonar().position).normalized();
    const auto facing = static_cast<float>(std::abs(hit.normal.dot(from_sonar)));
    const auto within = static_cast<float>(std::min(1.0, spot.inside_by / radians_from_degrees(0.4)));
    colour += within * (0.06F + 0.30F * std::sqrt(facing)) * (1 + grain) * linear_colour(kInsonifiedColour);
  }
  const Vec3f passed = transmission(hit.distance / haze_);
  colour = colour.cwiseProduct(passed) + water.cwiseProduct(Vec3f::Ones() - passed);
  return {screen_colour(colour), static_cast<float>(hit.distance)};
}

// Tint of the material, with slightly different brightness per instance to distinguish objects.
Vec3f Renderer::tint(const Hit& hit) const {
  const Vec3f base = hit.material < tints_.size() ? tints_[hit.material] : Vec3f::Constant(0.35F);
  return base * (0.92F + 0.16F * static_cast<float>((hit.instance * 2654435761U >> 16U) & 0xffU) / 255.0F);
}

}  // namespace insonify

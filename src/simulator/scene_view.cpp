// scene_view.cpp -- draws what a camera under water would see.

#include "insonify/scene_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "image/canvas.h"
#include "insonify/error.h"
#include "simulator/camera.h"
#include "simulator/grain.h"
#include "simulator/housing.h"
#include "simulator/insonified_sector.h"
#include "simulator/underwater_light.h"

namespace insonify {
namespace {

constexpr std::size_t kRaysAtOnce = 1 << 16;
constexpr double kClearance = 1e-4;     // Share of its length that a ray keeps away from the surfaces at its ends.
constexpr double kHousingSize = 0.011;  // Radius, in widths of the picture.
constexpr double kHazyAt = 2.7;         // Distance at which the view turns hazy, in median distances of what is seen.
constexpr double kGrainSize = 0.03;     // Of the coarsest grain, in median distances.
constexpr float kEdgeContrast = 14;     // Difference of neighbours [0..255] that calls for more samples.
const Vec3f kLightColour{0.98F, 1.06F, 0.98F};
constexpr unsigned kHousingColour = 0xffc530;
constexpr unsigned kTransducerColour = 0x2a2f36;
constexpr unsigned kInsonifiedColour = 0xffb545;

// What a ray ends at, and how far off.
struct Sample {
  Vec3f colour = Vec3f::Zero();  // For screens.
  float distance = 0;            // Infinite for open water.
};

// A point of a surface that a ray ended at.
struct Spot {
  Vec3 point = Vec3::Zero();           // World frame [m].
  double lit = 0;                      // Cosine of the angle at which light falls in, were nothing in the way.
  double inside_by = -1;               // How far in the sonar's sector [rad].
  int light_ray = -1, sonar_ray = -1;  // Index of the rays from there; -1 where none was sent.
};

// Sees and shades one scene from one place.
class Renderer {
 public:
  Renderer(Engine& engine, const Scene& scene, const Camera& camera, const InsonifiedSector& sector,
           const Housing* housing)
      : engine_(engine), camera_(camera), sector_(sector), housing_(housing) {
    for (const Material& material : scene.materials) {
      tints_.push_back(tint_of(material));
    }
    place_light();
  }

  // Distance that is typical of what is seen [m].
  void set_scale(double scale) {
    haze_ = kHazyAt * scale;
    grain_ = kGrainSize * std::exp2(std::round(std::log2(scale)));
  }

  // Renders through points of the picture [pixels].
  std::vector<Sample> render(std::span<const Point> points) {
    std::vector<Sample> samples(points.size());
    for (std::size_t first = 0; first < points.size(); first += kRaysAtOnce) {
      const std::size_t count = std::min(kRaysAtOnce, points.size() - first);
      render_some(points.subspan(first, count), std::span(samples).subspan(first, count));
    }
    return samples;
  }

  // Median distance of what a coarse grid of rays meets.
  double median_distance(int width, int height, double otherwise) {
    rays_.clear();
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 32; ++x) {
        rays_.push_back({camera_.position(), camera_.direction((x + 0.5) * width / 32, (y + 0.5) * height / 24)});
      }
    }
    hits_.resize(rays_.size());
    engine_.trace(rays_, hits_);
    std::vector<double> distances;
    for (const Hit& hit : hits_) {
      if (std::isfinite(hit.distance)) {
        distances.push_back(hit.distance);
      }
    }
    if (distances.empty()) {
      return otherwise;
    }
    std::nth_element(distances.begin(), distances.begin() + distances.size() / 2, distances.end());
    return distances[distances.size() / 2];
  }

 private:
  // Over the camera's left shoulder. Where something is in the way there, as in a tank, it is a lamp before that.
  void place_light() {
    Vec3 ahead = camera_.forward() - camera_.forward().z() * Vec3::UnitZ();
    ahead = ahead.norm() > 0.1 ? ahead.normalized() : camera_.up();
    to_light_ = (0.8 * Vec3::UnitZ() - 0.75 * camera_.right() - 0.2 * ahead).normalized();
    rays_.assign(1, {camera_.position(), to_light_});
    hits_.resize(1);
    engine_.trace(rays_, hits_);
    lamp_ = std::isfinite(hits_[0].distance);
    lamp_position_ = camera_.position() + 0.85 * (lamp_ ? hits_[0].distance : 0) * to_light_;
  }

  [[nodiscard]] Ray ray_to_light(const Vec3& point) const {
    if (!lamp_) {
      return {point, to_light_, 0};
    }
    const Vec3 way = lamp_position_ - point;
    return {point, way.normalized(), 0, way.norm()};
  }

  // Calls run(i) for each i in 0..count.
  template <typename Run>
  void for_each(std::size_t count, const Run& run) {
    constexpr std::size_t kTogether = 1024;
    workers_.for_each(static_cast<int>((count + kTogether - 1) / kTogether), [&](int task, int) {
      const std::size_t first = static_cast<std::size_t>(task) * kTogether;
      for (std::size_t i = first; i < std::min(count, first + kTogether); ++i) {
        run(i);
      }
    });
  }

  void render_some(std::span<const Point> points, std::span<Sample> samples) {
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

  // Finds out what there is to know of a point that was hit, but for what stands in the way of light and sound.
  [[nodiscard]] Spot spot_at(std::size_t i) const {
    Spot spot;
    if (std::isfinite(hits_[i].distance)) {
      spot.point = rays_[i].origin + hits_[i].distance * rays_[i].direction;
      spot.lit = hits_[i].normal.dot(ray_to_light(spot.point).direction);
      spot.inside_by = housing_ != nullptr ? sector_.inside_by(spot.point) : -1;
    }
    return spot;
  }

  // Finds which of the points see the light, and which the sonar.
  void trace_second_rays() {
    second_rays_.clear();
    const Vec3& sonar = sector_.world_from_sonar().position;
    for (std::size_t i = 0; i < spots_.size(); ++i) {
      Spot& spot = spots_[i];
      const double clear = kClearance * hits_[i].distance;
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

  [[nodiscard]] bool is_clear(int second) const { return second >= 0 && !std::isfinite(second_hits_[second].distance); }

  [[nodiscard]] Sample shade(std::size_t i) const {
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
    // Grain fades where it would be finer than pixels.
    const auto grain = static_cast<float>(0.13 / (1 + hit.distance / haze_)) * grain_at(spot.point, grain_);
    Vec3f colour = (1 + grain) * tint(hit).cwiseProduct(light);
    // The sea shines on edges that are seen flat.
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

  // Of the material; each instance a little lighter or darker than the others, so that they can be told apart.
  [[nodiscard]] Vec3f tint(const Hit& hit) const {
    const Vec3f base = hit.material < tints_.size() ? tints_[hit.material] : Vec3f::Constant(0.35F);
    return base * (0.92F + 0.16F * static_cast<float>((hit.instance * 2654435761U >> 16U) & 0xffU) / 255.0F);
  }

  Engine& engine_;
  const Camera& camera_;
  const InsonifiedSector& sector_;
  const Housing* housing_;  // Null: neither it nor what it insonifies is shown.
  std::vector<Vec3f> tints_;
  Vec3 to_light_ = Vec3::UnitZ(), lamp_position_ = Vec3::Zero();
  bool lamp_ = false;
  double haze_ = 1, grain_ = 1;  // [m]
  std::vector<Ray> rays_, second_rays_;
  std::vector<Hit> hits_, second_hits_;
  std::vector<Spot> spots_;
  Workers workers_{0};
};

// A pixel whose neighbours look different, for which one sample is not enough.
std::vector<std::size_t> find_edges(const std::vector<Sample>& samples, int width, int height) {
  std::vector<bool> edge(samples.size());
  const auto compare = [&](std::size_t a, std::size_t b) {
    if ((samples[a].colour - samples[b].colour).cwiseAbs().maxCoeff() > kEdgeContrast) {
      edge[a] = edge[b] = true;
    }
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      if (x + 1 < width) {
        compare(i, i + 1);
      }
      if (y + 1 < height) {
        compare(i, i + width);
      }
    }
  }
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < edge.size(); ++i) {
    if (edge[i]) {
      found.push_back(i);
    }
  }
  return found;
}

// One sample a pixel, then four where it matters.
std::vector<Sample> render_picture(Renderer& renderer, int width, int height) {
  std::vector<Point> points;
  points.reserve(static_cast<std::size_t>(width) * height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      points.push_back({x + 0.5, y + 0.5});
    }
  }
  std::vector<Sample> samples = renderer.render(points);

  constexpr Point kOffsets[] = {{0.375, 0.125}, {0.875, 0.375}, {0.625, 0.875}, {0.125, 0.625}};
  const std::vector<std::size_t> edges = find_edges(samples, width, height);
  points.clear();
  for (const std::size_t i : edges) {
    for (const Point& offset : kOffsets) {
      points.push_back({static_cast<double>(i % width) + offset.x, static_cast<double>(i / width) + offset.y});
    }
  }
  const std::vector<Sample> finer = renderer.render(points);
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const Sample* four = &finer[4 * k];
    samples[edges[k]].colour = (four[0].colour + four[1].colour + four[2].colour + four[3].colour) / 4;
  }
  return samples;
}

// Rounds with an ordered pattern, which hides the steps in slow gradients.
Picture develop(const std::vector<Sample>& samples, int width, int height) {
  constexpr float kPattern[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
  Picture picture{width, height, std::vector<std::uint8_t>(3 * samples.size())};
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const float threshold = (kPattern[i / width % 4][i % width % 4] + 0.5F) / 16;
    for (int channel = 0; channel < 3; ++channel) {
      picture.rgb[3 * i + channel] =
          static_cast<std::uint8_t>(std::clamp(samples[i].colour[channel] + threshold, 0.0F, 255.0F));
    }
  }
  return picture;
}

// Thin lines, each piece drawn where nothing stands before it.
void draw_sector(Picture& picture, const std::vector<Sample>& samples, const Camera& camera,
                 const InsonifiedSector& sector) {
  const double width = std::max(1.0, picture.height / 600.0);
  const double nearest = 1e-3 * sector.max_range();
  for (const auto& [from, to] : sector.edges()) {
    const Camera::Image a = camera.image_of(from);
    const Camera::Image b = camera.image_of(to);
    const Vec3 middle = (from + to) / 2;
    const Camera::Image m = camera.image_of(middle);
    if (a.depth < nearest || b.depth < nearest) {
      continue;
    }
    // A piece that leaves the picture is judged by the last pixel before.
    const auto x = static_cast<std::size_t>(std::clamp(m.x, 0.0, picture.width - 1.0));
    const auto y = static_cast<std::size_t>(std::clamp(m.y, 0.0, picture.height - 1.0));
    const std::size_t pixel = y * picture.width + x;
    const double distance = (middle - camera.position()).norm();
    if (distance < static_cast<double>(samples[pixel].distance) * (1 + 1e-3)) {
      draw_line(picture, {a.x, a.y}, {b.x, b.y}, width, {{255, 214, 110}, 0.75});
    }
  }
}

}  // namespace

Picture draw_scene(Engine& engine, const Scene& scene, const ViewConfig& view, const SonarConfig& sonar,
                   const Pose& world_from_sonar, const ViewOptions& options) {
  check_fields("view", view);
  check_fields("view", options);
  if ((view.look_at - view.position).norm() == 0) {
    throw Error("view.look_at must be another place than view.position");
  }
  const Camera camera(view, options.width, options.height);
  const InsonifiedSector sector(sonar, world_from_sonar);
  const double to_sonar = (world_from_sonar.position - camera.position()).norm();
  const Housing housing(sonar, world_from_sonar, kHousingSize * camera.width_at_one() * to_sonar);
  Renderer renderer(engine, scene, camera, sector, options.sonar_outline ? &housing : nullptr);
  renderer.set_scale(renderer.median_distance(options.width, options.height, sector.max_range()));

  const std::vector<Sample> samples = render_picture(renderer, options.width, options.height);
  Picture picture = develop(samples, options.width, options.height);
  if (options.sonar_outline) {
    draw_sector(picture, samples, camera, sector);
  }
  return picture;
}

}  // namespace insonify

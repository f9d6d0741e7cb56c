// scene_view.cpp -- renders the camera view: image, outline of the sector, marks.

#include "insonify/scene_view.h"

#include <algorithm>
#include <cmath>

#include "image/canvas.h"
#include "insonify/error.h"
#include "view/renderer.h"

namespace insonify {
namespace {

constexpr double kHousingSize = 0.011;  // Radius, relative to the width of the picture.
constexpr float kEdgeContrast =
    14;  // Difference between neighbouring pixels [0..255] above which they get more samples.

using Sample = Renderer::Sample;

// Pixels that differ from a neighbour, for which one sample is not enough.
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

// One sample per pixel, then four per edge pixel.
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
    const std::size_t column = i % width, row = i / width;
    for (const Point& offset : kOffsets) {
      points.push_back({static_cast<double>(column) + offset.x, static_cast<double>(row) + offset.y});
    }
  }
  const std::vector<Sample> finer = renderer.render(points);
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const Sample* four = &finer[4 * k];
    samples[edges[k]].colour = (four[0].colour + four[1].colour + four[2].colour + four[3].colour) / 4;
  }
  return samples;
}

// Quantises with ordered dithering, which hides the steps in slow gradients.
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

// Draws lines and marks over the rendered picture where no surface hides them.
class Overlay {
 public:
  Overlay(Picture& picture, const std::vector<Sample>& samples, const Camera& camera, double nearest)
      : picture_(picture), samples_(samples), camera_(camera), nearest_(nearest) {}

  void draw_sector(const InsonifiedSector& sector) {
    for (const auto& [from, to] : sector.edges()) {
      const Camera::Image a = camera_.image_of(from), b = camera_.image_of(to);
      if (a.depth >= nearest_ && b.depth >= nearest_ && is_seen((from + to) / 2)) {
        draw_line(picture_, {a.x, a.y}, {b.x, b.y}, hairline(), {kYellow, 0.75});
      }
    }
  }

  void draw_mark(const Vec3& place) {
    const Camera::Image at = camera_.image_of(place);
    if (at.depth >= nearest_ && is_seen(place)) {
      const double arm = picture_.height / 90.0;
      draw_line(picture_, {at.x - arm, at.y}, {at.x + arm, at.y}, 2 * hairline(), {kRed, 1});
      draw_line(picture_, {at.x, at.y - arm}, {at.x, at.y + arm}, 2 * hairline(), {kRed, 1});
    }
  }

 private:
  static constexpr Rgb kYellow{255, 214, 110}, kRed{255, 96, 80};

  [[nodiscard]] double hairline() const { return std::max(1.0, picture_.height / 600.0); }

  // Points outside the picture are compared with the nearest pixel.
  [[nodiscard]] bool is_seen(const Vec3& place) const {
    const Camera::Image at = camera_.image_of(place);
    const auto x = static_cast<std::size_t>(std::clamp(at.x, 0.0, picture_.width - 1.0));
    const auto y = static_cast<std::size_t>(std::clamp(at.y, 0.0, picture_.height - 1.0));
    const double distance = (place - camera_.position()).norm();
    return distance < static_cast<double>(samples_[y * picture_.width + x].distance) * (1 + 1e-3);
  }

  Picture& picture_;
  const std::vector<Sample>& samples_;
  const Camera& camera_;
  double nearest_;  // Least depth that is drawn [m].
};

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
  renderer.look_around(options.width, options.height, sector.max_range());

  const std::vector<Sample> samples = render_picture(renderer, options.width, options.height);
  Picture picture = develop(samples, options.width, options.height);
  Overlay overlay(picture, samples, camera, 1e-3 * sector.max_range());
  if (options.sonar_outline) {
    overlay.draw_sector(sector);
  }
  for (const Vec3& mark : options.marks) {
    overlay.draw_mark(mark);
  }
  return picture;
}

}  // namespace insonify

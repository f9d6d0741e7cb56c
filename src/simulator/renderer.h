// renderer.h -- what a camera's rays end at, and in which light it is seen.

#pragma once

#include <span>
#include <vector>

#include "base/parallel.h"
#include "echo/engine.h"
#include "image/canvas.h"
#include "simulator/camera.h"
#include "simulator/housing.h"
#include "simulator/insonified_sector.h"

namespace insonify {

/// Sees and shades one scene from one place.
class Renderer {
 public:
  /// What a ray ends at, and how far off.
  struct Sample {
    Vec3f colour = Vec3f::Zero();  // For screens.
    float distance = 0;            // Infinite for open water.
  };

  /// @param housing  Null: neither it nor what it insonifies is shown. All must outlive this.
  Renderer(Engine& engine, const Scene& scene, const Camera& camera, const InsonifiedSector& sector,
           const Housing* housing);

  /// Places the light and finds how hazy the view is; to be called before render(). Haze and grain are in proportion to
  /// the median distance of what a coarse grid of rays meets.
  /// @param otherwise  That distance in open water [m].
  void look_around(int width, int height, double otherwise);

  /// Renders through points of the picture [pixels].
  [[nodiscard]] std::vector<Sample> render(std::span<const Point> points);

 private:
  // A point of a surface that a ray ended at.
  struct Spot {
    Vec3 point = Vec3::Zero();           // World frame [m].
    double lit = 0;                      // Cosine of the angle at which light falls in, were nothing in the way.
    double inside_by = -1;               // How far in the sonar's sector [rad].
    int light_ray = -1, sonar_ray = -1;  // Index of the rays from there; -1 where none was sent.
  };

  [[nodiscard]] Ray ray_to_light(const Vec3& point) const;
  template <typename Run>
  void for_each(std::size_t count, const Run& run);
  void render_some(std::span<const Point> points, std::span<Sample> samples);
  [[nodiscard]] Spot spot_at(std::size_t i) const;
  void trace_second_rays();
  [[nodiscard]] bool is_clear(int second) const;
  [[nodiscard]] Sample shade(std::size_t i) const;
  [[nodiscard]] Vec3f tint(const Hit& hit) const;

  Engine& engine_;
  const Camera& camera_;
  const InsonifiedSector& sector_;
  const Housing* housing_;
  std::vector<Vec3f> tints_;
  Vec3 to_light_ = Vec3::UnitZ(), lamp_position_ = Vec3::Zero();
  bool lamp_ = false;
  double haze_ = 1, grain_ = 1;  // [m]
  std::vector<Ray> rays_, second_rays_;
  std::vector<Hit> hits_, second_hits_;
  std::vector<Spot> spots_;
  Workers workers_{0};
};

}  // namespace insonify

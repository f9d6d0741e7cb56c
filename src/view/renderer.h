// renderer.h -- traces and shades the rays of a camera view.

#pragma once

#include <span>
#include <vector>

#include "base/parallel.h"
#include "echo/engine.h"
#include "image/canvas.h"
#include "view/camera.h"
#include "view/drawn_sonar.h"

namespace insonify {

/// Renders one scene from one camera.
class Renderer {
 public:
  /// Colour and distance of the surface that a ray hits.
  struct Sample {
    Vec3f colour = Vec3f::Zero();  // For display, 0..255: see screen_colour().
    float distance = 0;            // [m]; infinite in open water.
  };

  /// @param housing  Null: neither the housing nor insonified surfaces are shown. All arguments must outlive this.
  Renderer(Engine& engine, const Scene& scene, const Camera& camera, const InsonifiedSector& sector,
           const Housing* housing);

  /// Places the light and sets the scales of haze and grain, which are proportional to the median distance of the
  /// surfaces that a coarse grid of rays hits. To be called before render().
  /// @param otherwise  That distance if no ray hits anything [m].
  void look_around(int width, int height, double otherwise);

  /// Renders the picture at these points [pixels].
  [[nodiscard]] std::vector<Sample> render(std::span<const Point> points);

 private:
  // A surface point that a camera ray hits.
  struct Spot {
    Vec3 point = Vec3::Zero();           // World frame [m].
    double lit = 0;                      // Cosine of the light's angle of incidence, before occlusion.
    double inside_by = -1;               // See InsonifiedSector::inside_by() [rad].
    int light_ray = -1, sonar_ray = -1;  // Indices into second_rays_; -1 where no ray was traced.
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

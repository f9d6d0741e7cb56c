// thickness_gauge.h -- measures the thickness of bodies by rays through them.

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "echo/engine.h"
#include "echo/thin/thin_parts.h"
#include "echo/thin/thin_wall.h"

namespace insonify {

/// Traces rays to the first surface of one instance, through those of others.
class ThinProbe {
 public:
  ThinProbe(int instance, Engine& engine) : instance_(instance), engine_(engine) {}

  /// @param rays  Changed where they pass surfaces of other instances.
  /// @return      [ray] Distance; infinite where nothing of the instance is met.
  std::span<const double> distances(std::vector<Ray>& rays);

 private:
  int instance_;
  Engine& engine_;
  std::vector<Hit> hits_;
  std::vector<double> distances_;
};

/// A wall with an opposite wall within reach, and the pairs of rays across from half-way between them. Where the body
/// is deeper than kThickest, and so round, there are two pairs: around the body and along it.
class ThinBody {
 public:
  /// @param depth      Distance to the opposite wall [m].
  /// @param first_ray  Index of the first of its rays.
  ThinBody(const ThinWall& wall, double depth, std::size_t first_ray);

  [[nodiscard]] const ThinWall& wall() const { return *wall_; }
  [[nodiscard]] std::size_t last_ray() const { return first_ray_ + 2 * static_cast<std::size_t>(directions_); }

  /// Sets the rays from the first to last_ray().
  void aim(std::vector<Ray>& rays) const;

  /// The second smallest extent [m], and the unit vector along the greatest one.
  /// @param sides  [ray] Distances along them.
  [[nodiscard]] std::pair<double, Vec3> measure(const std::vector<Ray>& rays, std::span<const double> sides) const;

 private:
  const ThinWall* wall_;
  double depth_;
  std::size_t first_ray_;
  int directions_;
};

/// Measures the thickness of one instance at many triangles at a time.
class ThicknessGauge {
 public:
  static constexpr std::size_t kTogether = 4096;  ///< Triangles measured together.

  ThicknessGauge(const Scene& scene, int index, Engine& engine, Workers& workers)
      : instance_(scene.instances[index]), through_(index, engine), across_(index, engine), workers_(workers) {}

  /// Adds those of some triangles that belong to thin parts, and of those before, in their order.
  /// @param last  Whether no more will come.
  void measure(std::span<const std::uint32_t> triangles, bool last, std::vector<ThinTriangle>& thin);

 private:
  void measure(std::span<const ThinWall> walls, std::vector<ThinTriangle>& thin);
  void find_walls(std::span<const std::uint32_t> triangles);
  [[nodiscard]] std::optional<ThinTriangle> thin_at(const ThinBody& body, std::span<const double> sides) const;

  const Instance& instance_;
  ThinProbe through_, across_;
  Workers& workers_;
  std::vector<std::optional<ThinWall>> found_;
  std::vector<ThinWall> walls_;  // Not measured yet.
  std::vector<ThinBody> bodies_;
  std::vector<Ray> rays_, cross_rays_;
  std::vector<std::optional<ThinTriangle>> measured_;
};

}  // namespace insonify

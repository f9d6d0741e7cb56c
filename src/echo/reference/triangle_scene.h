// triangle_scene.h -- a Scene as a list of triangles, searched one by one but for objects that a ray cannot meet.

#pragma once

#include <vector>

#include "echo/grid/echo.h"
#include "echo/laws/laws.h"
#include "echo/mirror/faces.h"
#include "echo/mirror/water_path.h"
#include "echo/model/refraction.h"
#include "echo/model/reliefs.h"
#include "insonify/ground_truth.h"
#include "insonify/scene.h"

namespace insonify {

/// First intersection of a ray with the scene.
struct RayHit {
  double distance = 0;             ///< [m]; infinite if nothing was hit.
  Vec3 normal = Vec3::Zero();      ///< Unit shading normal without relief, on the side given by the winding.
  Vec3 bent = Vec3::Zero();        ///< The same with relief.
  Vec3f gradient = Vec3f::Zero();  ///< ReliefPoint::gradient.
  float reflectivity = 0;          ///< That of the material, times `texture`.
  float texture = 1;               ///< ReliefPoint::reflectivity.
  std::uint16_t instance = kNoLabel, material = kNoLabel;
  std::size_t triangle = 0;  ///< Index into the scene's triangles.

  [[nodiscard]] bool met() const { return instance != kNoLabel; }
  [[nodiscard]] SurfaceLabel surface() const { return surface_label(instance, material); }
};

/// All triangles in world coordinates and double precision.
class TriangleScene {
 public:
  /// The scene must outlive this or the next call.
  /// @param origin  World position that reliefs are computed relative to.
  void set(const Scene& scene, const Vec3& origin);
  void move(int instance, const Pose& world_from_mesh);

  /// The water that bends the rays that follow, which are then in apparent space, as their hits are. Null: straight
  /// ones.
  void bend_by(const Refraction* refraction) { refraction_ = refraction; }
  [[nodiscard]] bool bends() const { return refraction_ != nullptr; }

  [[nodiscard]] RayHit nearest(const Ray& ray) const { return refraction_ ? nearest_bent(ray) : nearest_straight(ray); }
  [[nodiscard]] bool blocked(const Ray& ray) const {
    return refraction_ ? nearest_bent(ray).met() : blocked_straight(ray);
  }
  /// Index of the triangle that was hit in the mesh of its instance.
  [[nodiscard]] std::uint32_t in_mesh(const RayHit& hit) const {
    return static_cast<std::uint32_t>(hit.triangle - first_triangle_[hit.instance]);
  }
  /// The water's surface, in world coordinates.
  [[nodiscard]] const WaterPlane& water() const { return water_; }
  [[nodiscard]] bool has_relief() const { return reliefs_.any(); }

  /// Ray-tube spreading by the surface at a hit.
  /// @param direction  Direction of the incident sound, unit length.
  [[nodiscard]] precise::RayTube tube(const RayHit& mirror, const Vec3& direction) const;

  /// The edges of the face that was hit.
  [[nodiscard]] FaceEdges face_edges(const RayHit& mirror, const Vec3& point) const;

  [[nodiscard]] std::size_t bytes() const { return triangles_.capacity() * sizeof(Triangle); }

 private:
  struct Triangle {
    Vec3 corner, edge1, edge2;  // First corner, and the edges from there.
    Vec3 normal[3];
    std::uint16_t instance, material;
  };
  // A ball around an instance.
  struct Ball {
    Vec3 middle = Vec3::Zero();
    double square = 0;  // Square of its radius [m^2].
  };
  void place(int instance, const Pose& world_from_mesh);
  [[nodiscard]] RayHit nearest_straight(const Ray& ray) const;
  [[nodiscard]] RayHit nearest_bent(const Ray& ray) const;
  [[nodiscard]] bool blocked_straight(const Ray& ray) const;
  template <typename Visit>
  void visit_near(const Ray& ray, const Visit& visit) const;

  const Scene* scene_ = nullptr;
  Vec3 origin_ = Vec3::Zero();
  WaterPlane water_;
  std::vector<Triangle> triangles_;
  std::vector<std::size_t> first_triangle_;              // [instance], and at the end the number of triangles.
  std::vector<Ball> balls_;                              // [instance]
  std::vector<float> reflectivity_;                      // [material]
  std::vector<std::shared_ptr<const MeshFaces>> faces_;  // [instance]
  std::vector<Pose> poses_;                              // [instance]
  Reliefs reliefs_;
  const Refraction* refraction_ = nullptr;
};

}  // namespace insonify

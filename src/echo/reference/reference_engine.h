// reference_engine.h -- every ray against every triangle, in double precision: the oracle for the other engines.

#pragma once

#include <memory>

#include "base/parallel.h"
#include "echo/engine.h"
#include "echo/model/box_cut.h"
#include "echo/model/choose_sampling.h"
#include "echo/model/deposit.h"
#include "echo/model/path_footprint.h"
#include "echo/model/ray_tube.h"
#include "echo/model/reliefs.h"

namespace insonify {

class ReferenceEngine final : public Engine {
 public:
  explicit ReferenceEngine(int threads) : workers_(threads) {}

  static const EngineKind kKind;
  [[nodiscard]] const EngineKind& kind() const override { return kKind; }
  void set_scene(const Scene& scene) override;
  void move_instance(int instance, const Pose& world_from_mesh) override;
  void insonify(const PingPlan& plan, const Pose& world_from_sonar, EchoGrid& grid, BeamSink* sink) override;
  void trace(std::span<const Ray> rays, std::span<Hit> hits) override;
  [[nodiscard]] RayCounts ray_counts() const override { return counts_; }
  [[nodiscard]] EngineMemory memory() const override { return {triangles_.capacity() * sizeof(Triangle), 0}; }

 private:
  // One triangle in the world, edges from its first corner.
  struct Triangle {
    Vec3 corner, edge1, edge2;
    Vec3 normal[3];
    std::uint16_t instance, material;
  };

  // What a ray met.
  struct Meeting {
    double distance = 0;             // Infinite where there was nothing.
    Vec3 normal = Vec3::Zero();      // Of the triangles alone, on the side they wind to.
    Vec3 bent = Vec3::Zero();        // With relief.
    Vec3f gradient = Vec3f::Zero();  // Of the relief.
    float reflectivity = 0;
    float texture = 1;  // What relief makes of it.
    std::uint16_t instance = kNoLabel, material = kNoLabel;
    std::size_t triangle = 0;  // Of triangles_.

    [[nodiscard]] bool met() const { return instance != kNoLabel; }
    [[nodiscard]] SurfaceLabel surface() const { return surface_label(instance, material); }
  };

  void place_instance(int instance, const Pose& world_from_mesh);
  [[nodiscard]] Meeting nearest(const Ray& ray) const;
  [[nodiscard]] bool blocked(const Ray& ray) const;
  void insonify_column(const PingPlan& plan, SecondarySampling sampling, int column, const Pose& world_from_sonar,
                       EchoGrid& grid, std::vector<Echo>& arrivals, RayCounts& counts) const;

  // A path of the calibrated model by way of a mirror, up to what it met.
  struct Mirrored {
    Echo echo;  // All but its power.
    PathFootprint footprint;
    float reflectance, share, steepness;  // See MirrorPaths.
    float pattern;                        // |p|^2 of the elevation it was launched at.
    double range;                         // Of the mirror.
    RayTube tube;
    Ray across;
    Meeting second;
  };
  [[nodiscard]] RayTube tube(const Meeting& mirror, const Vec3& direction) const;
  void return_mirrored(const PingPlan& plan, const Pose& world_from_sonar, const Mirrored& mirrored, EchoGrid& grid,
                       std::vector<Echo>& arrivals, RayCounts& counts) const;

  Workers workers_;
  const Scene* scene_ = nullptr;
  std::vector<Triangle> triangles_;
  std::vector<std::size_t> first_triangle_;  // Of each instance.
  Reliefs reliefs_;
  BoxCut boxes_;                     // Only to choose what is followed.
  Vec3 origin_ = Vec3::Zero();       // What reliefs_ and boxes_ are told positions relative to.
  std::vector<float> reflectivity_;  // Of each material.
  SamplingProbes probes_;
  RayCounts counts_;
};

}  // namespace insonify

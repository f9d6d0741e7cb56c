// thin_echoes.h -- primary echoes of parts that are too thin for the sampling lattice.

#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "echo/targets/sight_rays.h"
#include "echo/targets/thin_parts.h"

namespace insonify {

/// Adds the primary echoes of thin parts to a grid of the calibrated model, where Engine::leave_out() has left them
/// out. Each piece is divided along its axis into steps of at most one column of the lattice, half the slope of its
/// facets and a bin. The echo of a step is the integral of the scattering law over the surface that faces the sonar
/// (docs/concepts/scattering.md, "Thin things"). It is not added where something else blocks the way to the sonar.
class ThinEchoes {
 public:
  explicit ThinEchoes(std::shared_ptr<const ThinParts> parts = {});

  static constexpr std::size_t kMostRays =
      4096;  ///< Most rays of a ping: of more steps, only every n-th is tried for sight.
  static constexpr std::size_t kMostSteps =
      32768;  ///< Most steps of a ping: where there would be more, they are longer.

  /// Allocates nothing.
  /// @param world_from_mesh  [instance]
  void add(const PingPlan& plan, const Pose& world_from_sonar, std::span<const Pose> world_from_mesh, Engine& engine,
           Workers& workers, EchoGrid& grid);

 private:
  // The pieces of one instance, and a sphere around them in the frame of its mesh.
  struct Group {
    int instance;
    std::size_t first, last;
    Vec3f middle;
    float radius;
  };

  // A piece that the sonar may receive. Frame of the sonar.
  struct Seen {
    std::uint32_t piece, group;
    std::uint32_t first, count;  // Steps.
    Vec3f middle, half;          // [m]
    float wished;                // Number of steps, if they are not to be longer.
  };

  // One step along a piece. Frame of the sonar, but for `in_mesh`.
  struct Step {
    std::uint32_t piece;
    std::uint32_t count;  // Steps of the piece; 0 for a step that the sonar does not receive.
    Vec3f place;          // On the axis of the piece [m].
    Vec3f in_mesh;        // Unit direction from the sonar, in the frame of the mesh.
    Vec3f axis;           // Unit length, or 0.
    float half_range;     // Half the range interval that the step covers [m].
  };

  void find_seen(const PingPlan& plan, const Pose& world_from_sonar, std::span<const Pose> world_from_mesh);
  void add_seen(const PingPlan& plan, std::uint32_t group, const Pose& sonar_from_mesh);
  [[nodiscard]] bool divide(float longer);
  void find_steps(const PingPlan& plan, Workers& workers);
  void step_along(const PingPlan& plan, const Seen& seen);
  void look(const PingPlan& plan, const Pose& world_from_sonar, Engine& engine);
  [[nodiscard]] bool visible(std::size_t ray) const;
  [[nodiscard]] Echo echo_of(const PingPlan& plan, const Step& step) const;

  std::shared_ptr<const ThinParts> parts_;
  std::vector<Group> groups_;
  std::vector<Eigen::Matrix3f> mesh_from_sonar_;  // [group]: rotation.
  std::vector<Seen> seen_;
  std::vector<Step> steps_;
  std::vector<Echo> echoes_;  // [step]
  std::size_t stride_ = 1;    // Steps per ray.
  std::vector<std::uint64_t> order_;    // Of the rays, by direction: place on a curve x 2^32 + number.
  std::vector<std::uint32_t> ray_of_;   // [number] Index of its ray.
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  std::vector<SightEnd> own_;  // What a ray may hit without being blocked.
  SightRays sight_rays_{kMostRays};
};

}  // namespace insonify

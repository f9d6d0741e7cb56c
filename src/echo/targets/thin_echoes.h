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

  // One step along a piece. Frame of the sonar, but for `in_mesh`.
  struct Step {
    std::uint32_t piece;
    std::uint32_t count;  // Steps of the piece.
    Vec3f place;          // On the axis of the piece [m].
    Vec3f in_mesh;        // Unit direction from the sonar, in the frame of the mesh.
    Vec3f axis;           // Unit length, or 0.
    float half_range;     // Half the range interval that the step covers [m].
  };

  bool find_steps(const PingPlan& plan, const Pose& world_from_sonar, std::span<const Pose> world_from_mesh,
                  float longer);
  bool add_steps(const PingPlan& plan, const Group& group, const Pose& sonar_from_mesh, float longer);
  void look(const PingPlan& plan, const Pose& world_from_sonar, Engine& engine);
  [[nodiscard]] bool visible(std::size_t step) const;
  [[nodiscard]] Echo echo_of(const PingPlan& plan, const Step& step) const;

  std::shared_ptr<const ThinParts> parts_;
  std::vector<Group> groups_;
  std::vector<Step> steps_;
  std::vector<Echo> echoes_;  // [step]
  std::size_t stride_ = 1;    // Steps per ray.
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  std::vector<SightEnd> own_;  // What a ray may hit without being blocked.
  SightRays sight_rays_{kMostRays};
};

}  // namespace insonify

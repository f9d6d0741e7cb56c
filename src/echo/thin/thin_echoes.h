// thin_echoes.h -- primary echoes of parts that are too thin for the sampling lattice.

#pragma once

#include <memory>
#include <span>
#include <vector>

#include "echo/batch/echo_source.h"
#include "echo/thin/thin_parts.h"

namespace insonify {

/// Primary echoes of thin parts, which Engine::leave_out() removes from the echoes of the lattice. Calibrated model
/// only. Each piece is divided along its axis into steps no longer than one column of the lattice, half the slope of
/// its facets, and one bin. The echo of a step is the integral of the scattering law over the surface that faces the
/// sonar (docs/concepts/scattering.md, "Thin things"). A step that is hidden gives no echo. Of pieces thicker than
/// ThinParts::kThickest every patch that faces the sonar has an echo of its own, at its own place, and may be hidden by
/// itself: a ball half in the bed.
class ThinEchoes final : public EchoSource {
 public:
  explicit ThinEchoes(std::shared_ptr<const ThinParts> parts);

  static constexpr std::size_t kMostRays =
      4096;  ///< Most rays per ping; with more parts, each ray tests several neighbouring ones.
  static constexpr std::size_t kMostParts = 32768;  ///< Most parts per ping; beyond that, steps are made longer.

  void ask(const PingView& view, Workers& workers, RayList& rays) override;
  void answer(const PingView& view, const RayAnswers& hits, Workers& workers, RayList& more, EchoList& found) override;

 private:
  // The pieces of one instance, and their bounding sphere in the frame of its mesh.
  struct Group {
    int instance;
    std::size_t first, last;
    Vec3f middle;
    float radius;
  };

  // A piece that the sonar may receive, in the sonar frame.
  struct Seen {
    std::uint32_t piece, group;
    std::uint32_t first, count;  // Steps.
    Vec3f middle, half;          // [m]
    float wished;                // Number of steps, if they are not to be longer.
  };

  // One step along a piece, in the sonar frame except for `in_mesh`.
  struct Step {
    std::uint32_t piece, group;
    std::uint32_t count;  // Number of steps of the piece; 0 for a step that the sonar does not receive.
    Vec3f place;          // On the axis of the piece [m].
    Vec3f in_mesh;        // Unit direction from the sonar, in the frame of the mesh.
    Vec3f axis;           // Unit vector; 0 for a piece without axis.
    float half_range;     // Half the range interval that the step covers [m].
  };

  // What has one echo: all patches of a step, or one of them.
  struct Part {
    std::uint32_t step;
    std::uint32_t first_patch, last_patch;
    bool alone;  // One of several parts of its step.
  };

  void find_seen(const PingView& view);
  void add_seen(const FlatPlan& plan, std::uint32_t group, const Pose& sonar_from_mesh);
  void divide_pieces();
  [[nodiscard]] bool divide(float longer);
  void find_steps(const FlatPlan& plan, Workers& workers);
  void find_parts();
  void step_along(const FlatPlan& plan, const Seen& seen);
  [[nodiscard]] bool parted(const ThinParts::Piece& piece) const;
  [[nodiscard]] Vec3f place_of(const Part& part) const;
  void ask_for_parts(const Pose& world_from_sonar, RayList& rays);
  void ask_for(const Part& part, const Pose& world_from_sonar, RayList& rays) const;
  [[nodiscard]] Echo echo_of(const FlatPlan& plan, const Part& part) const;

  std::shared_ptr<const ThinParts> parts_;
  std::vector<Group> groups_;
  std::vector<Eigen::Matrix3f> mesh_from_sonar_;  // [group]: rotation.
  std::vector<Seen> seen_;
  std::vector<Step> steps_;
  std::vector<Part> parts_of_steps_;
  bool by_patch_ = true;               // Whether thick pieces are parted: there are not too many.
  std::size_t stride_ = 1;             // Parts per ray.
  std::vector<std::uint64_t> order_;   // [ray] Morton code of its direction x 2^32 + its number.
  std::vector<std::uint32_t> ray_of_;  // [number] Index of its ray.
};

}  // namespace insonify

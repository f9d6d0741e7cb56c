// face_glints.h -- coherent echoes of plane faces: plates, walls, boxes.

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/engine.h"
#include "echo/mirror/faces.h"
#include "echo/model/left_out.h"
#include "echo/model/ping_plan.h"
#include "echo/targets/sight_rays.h"

namespace insonify {

/// The plane faces of a scene whose materials have an `rms_height`, and so a coherent reflection; without those with
/// relief and those that belong to thin parts.
struct GlintingFaces {
  static constexpr std::size_t kMostTogether = 1024;  ///< Most glints of one ping: the first that are found.

  /// Faces of one instance, by their planes, in the frame of its mesh.
  struct Group {
    int instance = 0;
    std::vector<float> middle_x, middle_y, middle_z;  ///< [face], as all of these [m].
    std::vector<float> first_x, first_y, first_z;     ///< Unit vector along one side.
    std::vector<float> second_x, second_y, second_z;  ///< Along the other.
    std::vector<float> first_half, second_half;       ///< Half the sides [m].
    std::vector<SurfaceLabel> surface;
    std::vector<std::uint32_t> face;  ///< Index into MeshFaces::faces.
    std::size_t first_number = 0;     ///< Number of the first face of this group among those of all groups.
  };
  std::vector<Group> groups;
  std::vector<std::shared_ptr<const MeshFaces>> of_mesh;  ///< [instance]; null where nothing reflects coherently.

  [[nodiscard]] bool any() const { return !groups.empty(); }
  [[nodiscard]] std::size_t count() const {
    return any() ? groups.back().first_number + groups.back().surface.size() : 0;
  }
};

/// Whether surfaces of a material slot reflect coherently where they are plane: the material has an `rms_height`, and
/// there is no relief.
[[nodiscard]] bool reflects_coherently(const Scene& scene, const Instance& instance, std::size_t slot);

/// Finds them, and marks their triangles in `left_out`.
[[nodiscard]] GlintingFaces find_glinting_faces(const Scene& scene, LeftOut& left_out);

/// Intensity that a plane rectangle returns, relative to |R|^2 of the source's at 1 m: Kirchhoff's integral in
/// Fresnel's approximation about the point nearest to the sonar (docs/concepts/scattering.md, "Glints of plane faces").
/// @param foot        Foot of the perpendicular from the sonar to the plane, from the middle of the face along its
/// sides
///                    [m].
/// @param half        Half the sides [m].
/// @param distance    From the sonar to the plane [m], > 0.
/// @param wavelength  [m]
[[nodiscard]] double face_glint(const Eigen::Vector2d& foot, const Eigen::Vector2d& half, double distance,
                                double wavelength);

/// Adds the coherent echoes of faces that are seen head on to a grid of the calibrated model, as discrete echoes:
/// face_glint() times |R|^2 e^-g, absorption, and the elevation pattern both ways. Those whose nearest point is hidden
/// give none.
class FaceGlints {
 public:
  explicit FaceGlints(std::shared_ptr<const GlintingFaces> faces = {});

  /// Allocates nothing.
  /// @param world_from_mesh  [instance]
  void add(const PingPlan& plan, const Pose& world_from_sonar, std::span<const Pose> world_from_mesh, Engine& engine,
           EchoGrid& grid);

  /// [face, by GlintingFaces::Group::first_number] 1 for those whose glints the last add() has added.
  [[nodiscard]] std::span<const std::uint8_t> shown() const { return shown_; }

 private:
  // A face that is seen head on.
  struct Glint {
    int instance;
    std::size_t number;  // Of the face.
    double range;
    double intensity;
    PingPlan::Arrival arrival;
  };

  void find(const PingPlan& plan, const Pose& world_from_sonar, const Pose& world_from_mesh,
            const GlintingFaces::Group& group);

  std::shared_ptr<const GlintingFaces> faces_;
  std::vector<Glint> glints_;
  std::vector<Ray> rays_;  // [glint]
  std::vector<Hit> hits_;
  std::vector<std::uint8_t> shown_;
  std::vector<SightEnd> ends_;
  SightRays sight_rays_;
  std::vector<std::uint8_t> near_;  // [face of a group] Whether it is seen head on.
};

}  // namespace insonify

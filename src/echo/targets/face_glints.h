// face_glints.h -- coherent echoes of plane faces: plates, walls, boxes.

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/batch/echo_source.h"
#include "echo/engine.h"
#include "echo/mirror/faces.h"
#include "echo/model/flat_plan.h"
#include "echo/model/left_out.h"
#include "echo/targets/glint_window.h"
#include "insonify/scene.h"

namespace insonify {

/// The plane faces of a scene that reflect coherently: their materials have an `rms_height`. Faces with relief and
/// those of thin parts are left out.
struct GlintingFaces {
  static constexpr std::size_t kMostTogether = 1024;  ///< Most glints per ping; later ones are dropped.
  static constexpr float kLeastWidth = 1e-3F;         ///< Narrower faces, such as rims of sheets, have no glint [m].
  static constexpr double kThinnest = 2e-3;           ///< Thinner sheets have the glint of their nearer side only [m].

  /// Faces of one instance as rectangles, in the frame of its mesh.
  struct Group {
    int instance = 0;
    std::vector<float> middle_x, middle_y, middle_z;  ///< [face], like all of these [m].
    std::vector<float> first_x, first_y, first_z;     ///< Unit vector along the first side.
    std::vector<float> second_x, second_y, second_z;  ///< Unit vector along the second side.
    std::vector<float> first_half, second_half;       ///< Half lengths of the sides [m].
    std::vector<SurfaceLabel> surface;
    std::vector<std::uint32_t> face;   ///< Index into MeshFaces::faces.
    std::vector<std::int8_t> covered;  ///< Side, +-1 along first x second, on which another surface of its instance
                                       ///< or of the static scene is within kThinnest; 0: none. See cover_faces().
    std::size_t first_number = 0;      ///< Index of this group's first face among the faces of all groups.
  };
  std::vector<Group> groups;                              ///< In the order of their instances.
  std::vector<std::shared_ptr<const MeshFaces>> of_mesh;  ///< [instance]; null if it has no coherent surface.

  [[nodiscard]] bool any() const { return !groups.empty(); }
  [[nodiscard]] const Group* group_of(std::size_t instance) const;  ///< Null: it has none.
  [[nodiscard]] std::size_t count() const {
    return any() ? groups.back().first_number + groups.back().surface.size() : 0;
  }
};

/// Whether plane faces of a material slot reflect coherently: its material has an `rms_height`, and no relief.
[[nodiscard]] bool reflects_coherently(const Scene& scene, const Instance& instance, std::size_t slot);

/// Finds the coherent faces of a scene, and marks their triangles in `left_out`.
[[nodiscard]] GlintingFaces find_glinting_faces(const Scene& scene, LeftOut& left_out, Workers& workers);

/// Sets GlintingFaces::Group::covered by rays: of the two sides of a thin sheet, the one away from the sonar is silent.
/// @param engine  Has the scene.
void cover_faces(const Scene& scene, Engine& engine, GlintingFaces& faces);

/// Echo intensity of a plane rectangle with |R| = 1, relative to the source's at 1 m: Kirchhoff's integral in Fresnel's
/// approximation about the point nearest to the sonar (docs/concepts/scattering.md, "Glints of plane faces").
/// @param foot        Foot of the perpendicular from the sonar, relative to the middle, along both sides [m].
/// @param half        Half lengths of the sides [m].
/// @param distance    From the sonar to the plane [m], > 0.
/// @param wavelength  [m]
[[nodiscard]] double face_glint(const Eigen::Vector2d& foot, const Eigen::Vector2d& half, double distance,
                                double wavelength);

/// Coherent echoes of faces at normal incidence, as discrete echoes: face_glint() times |R|^2
/// e^-g, absorption, and the two-way elevation pattern. Calibrated model only. Nine rays look whether a face is hidden:
/// at its nearest point and around it. Where more than one differs, the rays of a GlintWindow say what is left of the
/// glint.
class FaceGlints final : public EchoSource {
 public:
  explicit FaceGlints(std::shared_ptr<const GlintingFaces> faces);

  void ask(const PingView& view, Workers& workers, RayList& rays) override;
  void answer(const PingView& view, const RayAnswers& hits, Workers& workers, RayList& more, EchoList& found) override;

  /// Whether it needs no more rays at this ping.
  [[nodiscard]] bool is_done() const { return stage_ == Stage::kDone; }

  /// [face of all groups] 1 for faces whose glint this ping has, once is_done(); see
  /// GlintingFaces::Group::first_number.
  [[nodiscard]] std::span<const std::uint8_t> shown() const { return shown_; }

 private:
  static constexpr std::size_t kProbes = 9;
  static constexpr std::size_t kMostPartly = 32;  // Later faces that are partly hidden are all there or not at all.

  // A face at normal incidence; something may be before it.
  struct Glint {
    int instance;
    std::size_t number;  // Index of the face among all groups.
    double range;
    double intensity;
    FlatPlan::Arrival arrival;
    GlintWindow window;
    Vec3 middle;         // Middle of the face in the world [m].
    Vec3 first, second;  // Unit vectors along its sides, in the world.

    // Adds a ray to a place on the face.
    void aim(const Vec3& sonar, const Eigen::Vector2d& place, RayList& rays) const;
  };

  enum class Stage { kProbes, kPartly, kDone };  // Whose rays are being traced.

  void find(const FlatPlan& plan, const Pose& world_from_sonar, const Pose& world_from_mesh,
            const GlintingFaces::Group& group, RayList& rays);
  void show(const FlatPlan& plan, const Glint& glint, double share, EchoList& found);
  void answer_probes(const PingView& view, const RayAnswers& hits, RayList& more, EchoList& found);
  void answer_partly(const PingView& view, const RayAnswers& hits, EchoList& found);

  std::shared_ptr<const GlintingFaces> faces_;
  Stage stage_ = Stage::kDone;
  std::vector<Glint> glints_;
  std::vector<std::size_t> partly_;  // Indices of the glints of faces that are partly hidden.
  std::vector<std::uint8_t> shown_;
  std::vector<std::uint8_t> near_;  // [face of a group] 1 at normal incidence.
};

}  // namespace insonify

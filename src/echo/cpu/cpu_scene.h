// cpu_scene.h -- a Scene in Embree, and the normals and materials for shading its hits.

#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "echo/cpu/ray_packet.h"
#include "echo/embree.h"
#include "echo/grid/echo.h"
#include "echo/mirror/faces.h"
#include "echo/mirror/water_path.h"
#include "echo/model/refraction.h"
#include "echo/model/reliefs.h"
#include "echo/rays/box_cut.h"
#include "insonify/scene.h"

namespace insonify {

/// A static instance is an Embree geometry with vertices in scene coordinates. A moving instance is an Embree instance
/// of its mesh's own scene, so that moving it rebuilds only the top level of the hierarchy. So are static instances of
/// one mesh where their copies would take hundreds of megabytes.
class CpuScene {
 public:
  CpuScene();
  ~CpuScene();
  CpuScene(const CpuScene&) = delete;
  CpuScene& operator=(const CpuScene&) = delete;

  /// Builds a scene. Instances with the same index, mesh and pose as in the last scene are not built again if the
  /// middle of the scene, the origin of stored positions, is the same.
  void set(const Scene& scene, bool with_faces, Workers& workers);
  void move(int instance, const Pose& world_from_mesh);

  /// Makes the moves since the last call effective for the rays that follow.
  void commit_moves();

  [[nodiscard]] RTCScene handle() const { return scene_; }

  /// Finds the nearest hit of each ray.
  /// @param refraction  Null: rays are straight. Else they, and the distances of their hits, are in apparent space;
  ///                    normals are still true: see appear().
  void intersect(RayPacket& packet, const Refraction* refraction) const {
    refraction == nullptr ? packet.intersect(scene_) : intersect_bent(packet, *refraction);
  }

  /// Finds whether each ray hits anything. Coherent packets are avoided if there are Embree instances: there, Embree
  /// compiled by GCC 12 may never return, because it reads 64 bits of a mask that has 16
  /// (github.com/RenderKit/embree/pull/574).
  void occlude(RayPacket& packet, const Refraction* refraction) const {
    refraction == nullptr ? packet.occlude(scene_, any_placed_ ? Coherence::kScattered : Coherence::kAlike)
                          : occlude_bent(packet, *refraction);
  }

  /// The water's surface.
  [[nodiscard]] const WaterPlane& water() const { return water_; }

  /// Boxes around all triangles.
  [[nodiscard]] const BoxCut& boxes() const { return boxes_; }

  /// World position that Embree's coordinates are relative to, so that single precision suffices.
  [[nodiscard]] const Vec3& origin() const { return origin_; }

  /// Bytes in addition to the meshes and to what Embree allocates.
  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] std::size_t embree_bytes() const { return static_cast<std::size_t>(embree_bytes_.load()); }

  /// Surfaces hit by sixteen rays. Normals have any length and may point to either side.
  struct alignas(64) Shading {
    float normal_x[kPacketSize], normal_y[kPacketSize], normal_z[kPacketSize];
    float reflectivity[kPacketSize];    ///< 0: no hit.
    float texture[kPacketSize];         ///< ReliefPoint::reflectivity; `reflectivity` includes it.
    SurfaceLabel surface[kPacketSize];  ///< kNoSurface: no hit.

    [[nodiscard]] Vec3f normal(int lane) const { return {normal_x[lane], normal_y[lane], normal_z[lane]}; }
  };
  void shade(const RTCHit16& hits, Shading& shading) const;

  /// Ray-tube spreading by a mirror, see ray_tube().
  /// @param surface, triangle  The mirror's label and triangle.
  [[nodiscard]] RayTube tube(SurfaceLabel surface, std::uint32_t triangle, const Vec3f& direction, const Vec3f& normal,
                             float range) const;

  /// Whether any mesh has plane faces.
  [[nodiscard]] bool any_faces() const { return any_faces_; }

  /// The edges of the face that a triangle belongs to.
  /// @param point  A hit on it, relative to origin().
  [[nodiscard]] FaceEdges face_edges(SurfaceLabel surface, std::uint32_t triangle, const Vec3f& point) const;

  /// Relief of all surfaces.
  [[nodiscard]] const Reliefs& reliefs() const { return reliefs_; }

  /// After shade(): evaluates the relief at the hits of sixteen rays and multiplies reflectivities by it.
  /// @param reliefs  Receives the relief at each hit; flat where nothing was hit.
  void add_relief(const RTCRayHit16& rays, const Refraction* refraction, Shading& shading, ReliefLanes& reliefs) const;

  /// The same, and tilts the normals.
  void bend_normals(const RTCRayHit16& rays, const Refraction* refraction, Shading& shading) const;

  /// Last, with refraction: turns normals and gradients of hits from true to apparent space.
  /// @param reliefs  May be null.
  void appear(const RTCRay16& rays, const Refraction& refraction, Shading& shading, ReliefLanes* reliefs) const;

 private:
  void intersect_bent(RayPacket& packet, const Refraction& refraction) const;
  void occlude_bent(RayPacket& packet, const Refraction& refraction) const;

  // A mesh in its own frame, shared by all that are placed.
  struct MeshScene {
    explicit MeshScene(RTCDevice device) : handle(rtcNewScene(device)) {}
    ~MeshScene() { rtcReleaseScene(handle); }
    MeshScene(const MeshScene&) = delete;
    MeshScene& operator=(const MeshScene&) = delete;

    RTCScene handle;
    std::vector<Vec3f> vertices;
  };
  // One instance of the scene.
  struct Part {
    std::shared_ptr<const Mesh> mesh;  // Null where the instance is not present.
    Pose world_from_mesh;              // Pose of a static part.
    const std::array<std::uint32_t, 3>* triangles = nullptr;
    const Vec3f* vertices = nullptr;
    const Vec3f* normals = nullptr;  // Both in the world frame; of a placed part in its own frame.
    const std::uint16_t* slots = nullptr;
    std::vector<SurfaceLabel> surfaces;  // [material slot]
    std::shared_ptr<const MeshFaces> faces;
    Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();  // World from mesh.
    Vec3f offset = Vec3f::Zero();                            // From the origin to a placed part's mesh [m].
    std::vector<Vec3f> own_vertices, own_normals;
    std::shared_ptr<MeshScene> own_scene;
    RTCGeometry placed = nullptr;  // The Embree instance of a part that moves, or shares its mesh.
  };

  void clear();
  [[nodiscard]] bool has(const Part& part, const Instance& instance) const;
  void set(const Instance& instance, unsigned id, bool with_faces, Workers& workers);
  void remove(unsigned id);
  [[nodiscard]] bool is_placed(const Instance& instance) const;
  void add_copy(const Instance& instance, unsigned id, Workers& workers);
  void add_placed(const Instance& instance, unsigned id);
  [[nodiscard]] std::shared_ptr<MeshScene> scene_of(const Mesh& mesh);
  RTCGeometry make_triangles(const Mesh& mesh, const std::vector<Vec3f>& vertices);

  std::atomic<std::ptrdiff_t> embree_bytes_ = 0;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  std::vector<Part> parts_;
  std::set<const Mesh*> shared_;  // Meshes whose static instances are placed.
  std::map<const Mesh*, std::weak_ptr<MeshScene>> mesh_scenes_;
  BoxCut boxes_;
  Reliefs reliefs_;
  std::vector<float> reflectivity_;
  Vec3 origin_ = Vec3::Zero();
  WaterPlane water_;
  bool any_placed_ = false, moved_ = false, any_faces_ = false;
  bool whole_ = false;  // Whether set() has succeeded.
};

}  // namespace insonify

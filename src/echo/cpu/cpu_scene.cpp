// cpu_scene.cpp -- building and updating the Embree scene.

#include "echo/cpu/cpu_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "base/vector_math.h"
#include "insonify/error.h"

namespace insonify {
namespace {

[[noreturn]] void fail(const std::string& what, RTCError error) {
  if (error == RTC_ERROR_OUT_OF_MEMORY) {
    throw std::bad_alloc();
  }
  throw Error(fmt::format("Embree {} (error {})", what, static_cast<int>(error)));
}

void place(RTCGeometry geometry, const Pose& world_from_mesh, const Vec3& origin) {
  const Eigen::Matrix3f rotation = world_from_mesh.orientation.toRotationMatrix().cast<float>();
  const Vec3f offset = (world_from_mesh.position - origin).cast<float>();
  Eigen::Matrix<float, 3, 4> transform;  // Column-major, as Embree's FLOAT3X4_COLUMN_MAJOR.
  transform << rotation, offset;
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform.data());
  rtcCommitGeometry(geometry);
}

// Normals at the corners of the triangles that sixteen rays hit.
struct alignas(64) Corners {
  float x[3][kPacketSize], y[3][kPacketSize], z[3][kPacketSize];
};

INSONIFY_VECTOR_CLONES
void interpolate(const RTCHit16& __restrict__ hits, const Corners& __restrict__ corners,
                 CpuScene::Shading& __restrict__ shading) {
  for (int lane = 0; lane < kPacketSize; ++lane) {
    const float u = hits.u[lane], v = hits.v[lane], w = 1 - u - v;
    shading.normal_x[lane] = w * corners.x[0][lane] + u * corners.x[1][lane] + v * corners.x[2][lane];
    shading.normal_y[lane] = w * corners.y[0][lane] + u * corners.y[1][lane] + v * corners.y[2][lane];
    shading.normal_z[lane] = w * corners.z[0][lane] + u * corners.z[1][lane] + v * corners.z[2][lane];
  }
}

}  // namespace

CpuScene::CpuScene() {
  device_ = rtcNewDevice(nullptr);  // A thread count here would limit all users of oneTBB in the process.
  if (device_ == nullptr) {
    fail("cannot start", rtcGetDeviceError(nullptr));
  }
  rtcSetDeviceMemoryMonitorFunction(
      device_,
      [](void* sum, ssize_t bytes, bool) {
        *static_cast<std::atomic<std::ptrdiff_t>*>(sum) += bytes;
        return true;
      },
      &embree_bytes_);
}

CpuScene::~CpuScene() {
  clear();
  rtcReleaseDevice(device_);
}

void CpuScene::clear() {
  for (const Part& part : parts_) {
    if (part.placed != nullptr) {
      rtcReleaseGeometry(part.placed);
      rtcReleaseScene(part.own_scene);
    }
  }
  parts_.clear();
  any_moving_ = false;
  if (scene_ != nullptr) {
    rtcReleaseScene(scene_);
    scene_ = nullptr;
  }
}

// Whether a part is what an instance would become.
bool CpuScene::has(const Part& part, const Instance& instance) const {
  if (!instance.present || part.mesh != instance.mesh || (part.placed != nullptr) != instance.moving) {
    return false;
  }
  return instance.moving ||
         (part.world_from_mesh.position == instance.world_from_mesh.position &&
          part.world_from_mesh.orientation.coeffs() == instance.world_from_mesh.orientation.coeffs());
}

void CpuScene::remove(unsigned id) {
  Part& part = parts_[id];
  rtcDetachGeometry(scene_, id);
  if (part.placed != nullptr) {
    rtcReleaseGeometry(part.placed);
    rtcReleaseScene(part.own_scene);
  }
  part = {};
}

void CpuScene::set(const Scene& scene) {
  const Vec3 origin = scene.middle();
  if (!whole_ || origin != origin_ || scene.instances.size() < parts_.size()) {
    clear();
  }
  whole_ = false;
  origin_ = origin;
  water_ = WaterPlane::of(scene, origin_);
  boxes_.set(scene, origin_);
  reliefs_.set(scene, origin_);
  reflectivity_.clear();
  for (const Material& material : scene.materials) {
    reflectivity_.push_back(static_cast<float>(material.effective_reflectivity()));
  }

  // Two levels: a top that is cheap to rebuild, over geometries that are built once at higher quality.
  if (scene_ == nullptr) {
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
  }
  any_moving_ = any_faces_ = false;
  parts_.resize(scene.instances.size());
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const auto id = static_cast<unsigned>(i);
    Part& part = parts_[i];
    if (part.mesh != nullptr && !has(part, instance)) {
      remove(id);
    }
    if (!instance.present) {
      continue;
    }
    part.surfaces.clear();
    for (const std::uint16_t material : instance.materials) {
      part.surfaces.push_back(surface_label(static_cast<std::uint16_t>(i), material));
    }
    any_moving_ |= instance.moving;
    part.rotation = instance.world_from_mesh.orientation.toRotationMatrix().cast<float>();
    part.offset = (instance.world_from_mesh.position - origin_).cast<float>();
    if (part.mesh == nullptr) {
      part.faces = find_faces(*instance.mesh);
    }
    any_faces_ |= !part.faces->faces.empty();
    if (part.mesh != nullptr) {
      if (instance.moving) {
        place(part.placed, instance.world_from_mesh, origin_);
      }
      continue;
    }
    part.mesh = instance.mesh;
    part.world_from_mesh = instance.world_from_mesh;
    part.triangles = instance.mesh->triangles.data();
    part.slots = instance.mesh->material_slots.empty() ? nullptr : instance.mesh->material_slots.data();
    if (instance.moving) {
      add_moving(instance, id);
    } else {
      add_still(instance, id);
    }
  }
  rtcCommitScene(scene_);
  if (const RTCError error = rtcGetDeviceError(device_); error != RTC_ERROR_NONE) {
    fail(fmt::format("cannot build the scene of {} triangles", scene.triangle_count()), error);
  }
  moved_ = false;
  whole_ = true;
}

RTCGeometry CpuScene::make_triangles(const Mesh& mesh, const std::vector<Vec3f>& vertices) {
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices.data(), 0, sizeof(Vec3f),
                             vertices.size() - 1);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             sizeof(mesh.triangles[0]), mesh.triangles.size());
  rtcCommitGeometry(geometry);
  return geometry;
}

void CpuScene::add_still(const Instance& instance, unsigned id) {
  const Mesh& mesh = *instance.mesh;
  Part& part = parts_[id];
  part.own_vertices.reserve(mesh.vertices.size() + 1);
  for (const Vec3f& vertex : mesh.vertices) {
    part.own_vertices.push_back((instance.world_from_mesh * vertex.cast<double>().eval() - origin_).cast<float>());
  }
  part.own_vertices.emplace_back(Vec3f::Zero());  // Embree reads 16 bytes at the last vertex.

  // Normals are only rotated; without rotation those of the mesh are used.
  if (instance.world_from_mesh.orientation.isApprox(Eigen::Quaterniond::Identity())) {
    part.normals = mesh.normals.data();
  } else {
    const Eigen::Matrix3f rotation = instance.world_from_mesh.orientation.toRotationMatrix().cast<float>();
    part.own_normals.reserve(mesh.normals.size());
    for (const Vec3f& normal : mesh.normals) {
      part.own_normals.emplace_back(rotation * normal);
    }
    part.normals = part.own_normals.data();
  }
  RTCGeometry geometry = make_triangles(mesh, part.own_vertices);
  rtcAttachGeometryByID(scene_, geometry, id);
  rtcReleaseGeometry(geometry);
}

void CpuScene::add_moving(const Instance& instance, unsigned id) {
  const Mesh& mesh = *instance.mesh;
  Part& part = parts_[id];
  part.normals = mesh.normals.data();
  part.own_vertices.assign(mesh.vertices.begin(), mesh.vertices.end());
  part.own_vertices.emplace_back(Vec3f::Zero());
  part.own_scene = rtcNewScene(device_);
  RTCGeometry geometry = make_triangles(mesh, part.own_vertices);
  rtcAttachGeometry(part.own_scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(part.own_scene);

  part.placed = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(part.placed, part.own_scene);
  part.rotation = instance.world_from_mesh.orientation.toRotationMatrix().cast<float>();
  place(part.placed, instance.world_from_mesh, origin_);
  rtcAttachGeometryByID(scene_, part.placed, id);
}

// Looks up the corners of each hit in turn, then interpolates all normals in one vector loop.
void CpuScene::shade(const RTCHit16& hits, Shading& shading) const {
  Corners corners;
  std::fill_n(shading.texture, kPacketSize, 1.0F);
  for (int lane = 0; lane < kPacketSize; ++lane) {
    if (hits.geomID[lane] == RTC_INVALID_GEOMETRY_ID) {
      shading.surface[lane] = kNoSurface;
      shading.reflectivity[lane] = 0;
      for (int corner = 0; corner < 3; ++corner) {
        corners.x[corner][lane] = corners.y[corner][lane] = corners.z[corner][lane] = 0;
      }
      continue;
    }
    const bool moves = hits.instID[0][lane] != RTC_INVALID_GEOMETRY_ID;
    const Part& part = parts_[moves ? hits.instID[0][lane] : hits.geomID[lane]];
    const unsigned triangle = hits.primID[lane];
    const SurfaceLabel surface = part.surfaces[part.slots == nullptr ? 0 : part.slots[triangle]];
    shading.surface[lane] = surface;
    shading.reflectivity[lane] = reflectivity_[material_of(surface)];
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3f& own = part.normals[part.triangles[triangle][corner]];
      const Vec3f normal = moves ? Vec3f(part.rotation * own) : own;
      corners.x[corner][lane] = normal.x();
      corners.y[corner][lane] = normal.y();
      corners.z[corner][lane] = normal.z();
    }
  }
  interpolate(hits, corners, shading);
}

RayTube CpuScene::tube(SurfaceLabel surface, std::uint32_t triangle, const Vec3f& direction, const Vec3f& normal,
                       float range) const {
  const Part& part = parts_[instance_of(surface)];
  std::array<Vec3f, 3> corners, normals;
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t vertex = part.triangles[triangle][k];
    corners[k] = part.own_vertices[vertex];
    normals[k] = part.normals[vertex];
  }
  if (part.placed == nullptr) {
    return ray_tube(corners, normals, direction, normal, range);
  }
  const Eigen::Matrix3f turned = part.rotation.transpose();
  return ray_tube(corners, normals, turned * direction, turned * normal, range);
}

FaceEdges CpuScene::face_edges(SurfaceLabel surface, std::uint32_t triangle, const Vec3f& point) const {
  const Part& part = parts_[instance_of(surface)];
  const std::vector<std::uint32_t>& face_of = part.faces->face_of;
  if (face_of.empty() || face_of[triangle] == MeshFaces::kNone) {
    return {};
  }
  const Face& face = part.faces->faces[face_of[triangle]];
  const Eigen::Matrix3f back = part.rotation.transpose();
  const Vec3f& corner = part.own_vertices[face.corner];
  const Vec3f from_corner =
      part.placed == nullptr ? Vec3f(back * (point - corner)) : Vec3f(back * (point - part.offset) - corner);
  return FaceEdges::of(face, from_corner, part.rotation);
}

void CpuScene::add_relief(const RTCRayHit16& rays, Shading& shading, ReliefPoint* reliefs) const {
  const RTCRay16& ray = rays.ray;
  for (int lane = 0; lane < kPacketSize; ++lane) {
    reliefs[lane] = {};
    if (shading.surface[lane] == kNoSurface) {
      continue;
    }
    const Vec3f origin(ray.org_x[lane], ray.org_y[lane], ray.org_z[lane]);
    const Vec3f direction(ray.dir_x[lane], ray.dir_y[lane], ray.dir_z[lane]);
    reliefs[lane] = reliefs_.at(instance_of(shading.surface[lane]), rays.hit.primID[lane],
                                origin + ray.tfar[lane] * direction, shading.normal(lane));
    shading.texture[lane] = reliefs[lane].reflectivity;
    shading.reflectivity[lane] *= reliefs[lane].reflectivity;
  }
}

void CpuScene::bend_normals(const RTCRayHit16& rays, Shading& shading) const {
  ReliefPoint reliefs[kPacketSize];
  add_relief(rays, shading, reliefs);
  for (int lane = 0; lane < kPacketSize; ++lane) {
    if (shading.surface[lane] != kNoSurface) {
      const Vec3f normal = bent_normal(shading.normal(lane), reliefs[lane].gradient);
      shading.normal_x[lane] = normal.x();
      shading.normal_y[lane] = normal.y();
      shading.normal_z[lane] = normal.z();
    }
  }
}

void CpuScene::move(int instance, const Pose& world_from_mesh) {
  Part& part = parts_[instance];
  part.rotation = world_from_mesh.orientation.toRotationMatrix().cast<float>();
  part.offset = (world_from_mesh.position - origin_).cast<float>();
  place(part.placed, world_from_mesh, origin_);
  reliefs_.move(instance, world_from_mesh);
  boxes_.move(instance, {world_from_mesh.position - origin_, world_from_mesh.orientation});
  moved_ = true;
}

void CpuScene::commit_moves() {
  if (moved_) {
    rtcCommitScene(scene_);
    moved_ = false;
  }
}

std::size_t CpuScene::bytes() const {
  std::size_t sum = 0;
  for (const Part& part : parts_) {
    sum += part.own_vertices.capacity() * sizeof(Vec3f) + part.own_normals.capacity() * sizeof(Vec3f);
  }
  return sum;
}

}  // namespace insonify

// cpu_scene.cpp -- building and updating the Embree scene.

#include "echo/cpu/cpu_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "base/parallel_blocks.h"
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

// Large meshes of several static instances, if copies of them would have millions of triangles of 100 bytes. Rays enter
// an Embree instance by a transformation, which takes time and rounds otherwise, so smaller scenes have copies.
std::set<const Mesh*> meshes_to_share(const Scene& scene) {
  constexpr std::size_t kLarge = 500, kMostCopied = 2'000'000;
  std::map<const Mesh*, std::size_t> counts;
  std::size_t copied = 0;
  for (const Instance& instance : scene.instances) {
    const std::size_t triangles = instance.mesh->triangles.size();
    if (instance.present && !instance.moving && triangles >= kLarge && ++counts[instance.mesh.get()] > 1) {
      copied += triangles;
    }
  }
  std::set<const Mesh*> shared;
  for (const auto& [mesh, count] : counts) {
    if (count > 1 && copied > kMostCopied) {
      shared.insert(mesh);
    }
  }
  return shared;
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
    }
  }
  parts_.clear();
  any_placed_ = false;
  if (scene_ != nullptr) {
    rtcReleaseScene(scene_);
    scene_ = nullptr;
  }
}

// Whether a part is what an instance would become.
bool CpuScene::has(const Part& part, const Instance& instance) const {
  if (!instance.present || part.mesh != instance.mesh || (part.placed != nullptr) != is_placed(instance)) {
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
  }
  part = {};
}

bool CpuScene::is_placed(const Instance& instance) const {
  return instance.moving || shared_.contains(instance.mesh.get());
}

// Adds an instance, or keeps the part that it is already.
void CpuScene::set(const Instance& instance, unsigned id, bool with_faces, Workers& workers) {
  Part& part = parts_[id];
  if (part.mesh != nullptr && !has(part, instance)) {
    remove(id);
  }
  if (!instance.present) {
    return;
  }
  part.surfaces.clear();
  for (const std::uint16_t material : instance.materials) {
    part.surfaces.push_back(surface_label(static_cast<std::uint16_t>(id), material));
  }
  any_placed_ |= is_placed(instance);
  part.rotation = instance.world_from_mesh.orientation.toRotationMatrix().cast<float>();
  part.offset = (instance.world_from_mesh.position - origin_).cast<float>();
  const bool is_new = part.mesh == nullptr;
  if (is_new) {
    part.faces = with_faces ? shared_faces(instance.mesh, workers) : nullptr;
    part.mesh = instance.mesh;
    part.world_from_mesh = instance.world_from_mesh;
    part.triangles = instance.mesh->triangles.data();
    part.slots = instance.mesh->material_slots.empty() ? nullptr : instance.mesh->material_slots.data();
  }
  any_faces_ |= part.faces != nullptr && !part.faces->faces.empty();
  if (is_new && is_placed(instance)) {
    add_placed(instance, id);
  } else if (is_new) {
    add_copy(instance, id, workers);
  } else if (instance.moving) {
    place(part.placed, instance.world_from_mesh, origin_);
  }
}

void CpuScene::set(const Scene& scene, bool with_faces, Workers& workers) {
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
  any_placed_ = any_faces_ = false;
  shared_ = meshes_to_share(scene);
  std::erase_if(mesh_scenes_, [](const auto& entry) { return entry.second.expired(); });
  parts_.resize(scene.instances.size());
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    set(scene.instances[i], static_cast<unsigned>(i), with_faces, workers);
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

void CpuScene::add_copy(const Instance& instance, unsigned id, Workers& workers) {
  const Mesh& mesh = *instance.mesh;
  Part& part = parts_[id];
  part.own_vertices.resize(mesh.vertices.size() + 1, Vec3f::Zero());  // Embree reads 16 bytes at the last vertex.
  for_each_block(workers, mesh.vertices.size(), 1 << 14, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      part.own_vertices[i] =
          (instance.world_from_mesh * mesh.vertices[i].cast<double>().eval() - origin_).cast<float>();
    }
  });

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
  part.vertices = part.own_vertices.data();
  RTCGeometry geometry = make_triangles(mesh, part.own_vertices);
  rtcAttachGeometryByID(scene_, geometry, id);
  rtcReleaseGeometry(geometry);
}

std::shared_ptr<CpuScene::MeshScene> CpuScene::scene_of(const Mesh& mesh) {
  std::weak_ptr<MeshScene>& known = mesh_scenes_[&mesh];
  std::shared_ptr<MeshScene> scene = known.lock();
  if (scene == nullptr) {
    scene = std::make_shared<MeshScene>(device_);
    scene->vertices.reserve(mesh.vertices.size() + 1);
    scene->vertices.assign(mesh.vertices.begin(), mesh.vertices.end());
    scene->vertices.emplace_back(Vec3f::Zero());
    RTCGeometry geometry = make_triangles(mesh, scene->vertices);
    rtcAttachGeometry(scene->handle, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene->handle);
    known = scene;
  }
  return scene;
}

void CpuScene::add_placed(const Instance& instance, unsigned id) {
  Part& part = parts_[id];
  part.own_scene = scene_of(*instance.mesh);
  part.vertices = part.own_scene->vertices.data();
  part.normals = instance.mesh->normals.data();
  part.placed = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(part.placed, part.own_scene->handle);
  part.rotation = instance.world_from_mesh.orientation.toRotationMatrix().cast<float>();
  place(part.placed, instance.world_from_mesh, origin_);
  rtcAttachGeometryByID(scene_, part.placed, id);
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
  for (const auto& [mesh, scene] : mesh_scenes_) {
    const std::shared_ptr<MeshScene> in_use = scene.lock();
    sum += in_use == nullptr ? 0 : in_use->vertices.capacity() * sizeof(Vec3f);
  }
  return sum;
}

}  // namespace insonify

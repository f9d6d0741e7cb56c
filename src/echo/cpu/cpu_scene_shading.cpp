// cpu_scene_shading.cpp -- normals, reliefs, ray tubes and faces at hits on the Embree scene.

#include "base/vector_math.h"
#include "echo/cpu/cpu_scene.h"
#include "echo/laws/laws.h"

namespace insonify {
namespace {

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
  const auto& corners = part.triangles[triangle];
  const Vec3f& first = part.vertices[corners[0]];
  const CurvedTriangle mirror = {triple_of(part.vertices[corners[1]] - first),
                                 triple_of(part.vertices[corners[2]] - first), triple_of(part.normals[corners[0]]),
                                 triple_of(part.normals[corners[1]]), triple_of(part.normals[corners[2]])};
  if (part.placed == nullptr) {
    return ray_tube(mirror, triple_of(direction), triple_of(normal), range);
  }
  const Eigen::Matrix3f turned = part.rotation.transpose();
  return ray_tube(mirror, triple_of(turned * direction), triple_of(turned * normal), range);
}

FaceEdges CpuScene::face_edges(SurfaceLabel surface, std::uint32_t triangle, const Vec3f& point) const {
  const Part& part = parts_[instance_of(surface)];
  const std::vector<std::uint32_t>& face_of = part.faces->face_of;
  if (face_of.empty() || face_of[triangle] == MeshFaces::kNone) {
    return {};
  }
  const Face& face = part.faces->faces[face_of[triangle]];
  const Eigen::Matrix3f back = part.rotation.transpose();
  const Vec3f& corner = part.vertices[face.corner];
  const Vec3f from_corner =
      part.placed == nullptr ? Vec3f(back * (point - corner)) : Vec3f(back * (point - part.offset) - corner);
  return FaceEdges::of(face, from_corner, part.rotation);
}

void CpuScene::add_relief(const RTCRayHit16& rays, const Refraction* refraction, Shading& shading,
                          ReliefLanes& reliefs) const {
  const RTCRay16& ray = rays.ray;
  ReliefHits hits;
  for (int lane = 0; lane < kPacketSize; ++lane) {
    const SurfaceLabel surface = shading.surface[lane];
    hits.instance[lane] = surface == kNoSurface ? ReliefHits::kNone : instance_of(surface);
    hits.triangle[lane] = rays.hit.primID[lane];
    hits.x[lane] = ray.org_x[lane] + ray.tfar[lane] * ray.dir_x[lane];
    hits.y[lane] = ray.org_y[lane] + ray.tfar[lane] * ray.dir_y[lane];
    hits.z[lane] = ray.org_z[lane] + ray.tfar[lane] * ray.dir_z[lane];
    hits.normal_x[lane] = shading.normal_x[lane];
    hits.normal_y[lane] = shading.normal_y[lane];
    hits.normal_z[lane] = shading.normal_z[lane];
    if (refraction != nullptr && surface != kNoSurface) {
      const Vec3f sonar = (refraction->sonar() - origin_).cast<float>();
      const Vec3f place = sonar + refraction->true_offset(Vec3f(hits.x[lane], hits.y[lane], hits.z[lane]) - sonar);
      hits.set(lane, hits.instance[lane], hits.triangle[lane], place, shading.normal(lane));
    }
  }
  reliefs_.find(hits, reliefs);
  for (int lane = 0; lane < kPacketSize; ++lane) {
    shading.texture[lane] = reliefs.reflectivity[lane];
    shading.reflectivity[lane] *= reliefs.reflectivity[lane];
  }
}

void CpuScene::bend_normals(const RTCRayHit16& rays, const Refraction* refraction, Shading& shading) const {
  ReliefLanes reliefs;
  add_relief(rays, refraction, shading, reliefs);
  reliefs.bend(shading.normal_x, shading.normal_y, shading.normal_z);
}

}  // namespace insonify

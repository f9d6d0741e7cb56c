// faces.cpp -- groups connected coplanar triangles by union-find, and fits a rectangle to each group.

#include "echo/mirror/faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace insonify {
namespace {

// Normals with a greater cosine between them count as equal (0.8 degrees).
constexpr float kSameNormal = 0.9999F;

// An edge: welded numbers of its vertices, the lower first.
using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge_of(std::uint32_t a, std::uint32_t b) {
  return a < b ? Edge{a, b} : Edge{b, a};
}

struct PlaceHash {
  std::size_t operator()(const std::array<float, 3>& place) const {
    std::size_t hash = 0;
    for (const float x : place) {
      hash = hash * 1000003 + std::hash<float>()(x);
    }
    return hash;
  }
};

// Union-find with path halving.
struct Groups {
  std::vector<std::uint32_t> parent;

  explicit Groups(std::size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), 0U); }
  std::uint32_t root(std::uint32_t i) {
    while (parent[i] != i) {
      i = parent[i] = parent[parent[i]];
    }
    return i;
  }
};

Vec3f area_vector(const Mesh& mesh, std::size_t triangle) {
  const auto& corners = mesh.triangles[triangle];
  const Vec3f& a = mesh.vertices[corners[0]];
  return 0.5F * (mesh.vertices[corners[1]] - a).cross(mesh.vertices[corners[2]] - a);
}

// Rectangle of a group of triangles: aligned with its longest outer edge, with its centroid and area, and with the
// ratio of its extents.
Face measure(const Mesh& mesh, const std::vector<std::uint32_t>& number, const std::vector<std::uint32_t>& group) {
  Face face{.corner = mesh.triangles[group.front()][0]};
  std::map<Edge, int> uses;
  Vec3f normal = Vec3f::Zero();
  for (const std::uint32_t triangle : group) {
    const auto& corners = mesh.triangles[triangle];
    for (int k = 0; k < 3; ++k) {
      ++uses[edge_of(number[corners[k]], number[corners[(k + 1) % 3]])];
    }
    normal = area_vector(mesh, triangle).normalized();
  }
  float longest = 0;
  Vec3f along = normal.unitOrthogonal();
  for (const auto& [edge, times] : uses) {
    const Vec3f side = mesh.vertices[edge.second] - mesh.vertices[edge.first];
    if (times == 1 && side.norm() > longest) {
      longest = side.norm();
      along = side.normalized();
    }
  }
  face.axes = {along, normal.cross(along).normalized()};

  const Vec3f origin = mesh.vertices[face.corner];
  float area = 0, extents[2];
  Vec3f moment = Vec3f::Zero();
  for (const std::uint32_t triangle : group) {
    const auto& corners = mesh.triangles[triangle];
    const float own = area_vector(mesh, triangle).norm();
    area += own;
    moment +=
        own / 3 * (mesh.vertices[corners[0]] + mesh.vertices[corners[1]] + mesh.vertices[corners[2]] - 3 * origin);
  }
  for (int axis = 0; axis < 2; ++axis) {
    float low = 0, high = 0;
    for (const std::uint32_t triangle : group) {
      for (const std::uint32_t vertex : mesh.triangles[triangle]) {
        const float place = face.axes[axis].dot(mesh.vertices[vertex] - origin);
        low = std::min(low, place);
        high = std::max(high, place);
      }
    }
    face.middle[axis] = face.axes[axis].dot(moment) / area;
    extents[axis] = high - low;
  }
  const float fill = std::sqrt(area / (extents[0] * extents[1]));
  face.half = {0.5F * fill * extents[0], 0.5F * fill * extents[1]};
  return face;
}

}  // namespace

std::vector<std::uint32_t> welded_vertices(const Mesh& mesh) {
  std::unordered_map<std::array<float, 3>, std::uint32_t, PlaceHash> numbers;
  std::vector<std::uint32_t> number(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3f& v = mesh.vertices[i];
    number[i] =
        numbers.try_emplace({v.x() + 0.0F, v.y() + 0.0F, v.z() + 0.0F}, static_cast<std::uint32_t>(i)).first->second;
  }
  return number;
}

bool is_flat(const Mesh& mesh, std::size_t triangle, const Vec3f& normal) {
  return std::ranges::all_of(mesh.triangles[triangle], [&](std::uint32_t vertex) {
    return std::abs(mesh.normals[vertex].dot(normal)) > kSameNormal;
  });
}

std::shared_ptr<const MeshFaces> find_faces(const Mesh& mesh) {
  auto found = std::make_shared<MeshFaces>();
  const std::size_t count = mesh.triangles.size();
  std::vector<Vec3f> normals(count, Vec3f::Zero());
  bool any = false;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3f area = area_vector(mesh, i);
    if (area.norm() > 0 && is_flat(mesh, i, area.normalized())) {
      normals[i] = area.normalized();
      any = true;
    }
  }
  if (!any) {
    return found;
  }
  const std::vector<std::uint32_t> number = welded_vertices(mesh);
  Groups groups(count);
  std::map<Edge, std::uint32_t> beside;
  for (std::uint32_t i = 0; i < count; ++i) {
    for (int k = 0; k < 3 && !normals[i].isZero(); ++k) {
      const auto& corners = mesh.triangles[i];
      const auto [entry, is_new] = beside.try_emplace(edge_of(number[corners[k]], number[corners[(k + 1) % 3]]), i);
      const std::uint32_t other = entry->second;
      if (!is_new && std::abs(normals[other].dot(normals[i])) > kSameNormal && mesh.slot_of(other) == mesh.slot_of(i)) {
        groups.parent[groups.root(i)] = groups.root(other);
      }
    }
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> members;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!normals[i].isZero()) {
      members[groups.root(i)].push_back(i);
    }
  }
  found->face_of.assign(count, MeshFaces::kNone);
  for (const auto& [root, group] : members) {
    for (const std::uint32_t triangle : group) {
      found->face_of[triangle] = static_cast<std::uint32_t>(found->faces.size());
    }
    found->faces.push_back(measure(mesh, number, group));
  }
  return found;
}

FaceTilt FaceTilt::of(const FaceEdges& face, std::uint32_t column, std::uint32_t row, std::uint32_t seed,
                      float wavelength, float incidence) {
  constexpr std::uint32_t kOwnSeed = 0x9e3779b9U;  // Independent of the random numbers of roughness.
  constexpr float kLeastTiltCosine = 0.05F;
  if (!face.finite) {
    return {};
  }
  const FacetSlopes slopes = facet_slopes(column, row, seed ^ kOwnSeed);
  const float cosine = std::max(std::abs(incidence), kLeastTiltCosine);
  const float first = slopes.along * diffraction_slope(face.low[0], face.high[0], wavelength, cosine),
              second = slopes.across * diffraction_slope(face.low[1], face.high[1], wavelength, cosine);
  return {first * face.axes[0] + second * face.axes[1]};
}

FaceEdges FaceEdges::of(const Face& face, const Vec3f& from_corner, const Eigen::Matrix3f& turn) {
  FaceEdges edges;
  edges.finite = true;
  for (int axis = 0; axis < 2; ++axis) {
    const Vec3f turned = turn * face.axes[axis];
    const float place = face.middle[axis] - face.axes[axis].dot(from_corner);
    edges.axes[axis] = {turned.x(), turned.y(), turned.z()};
    edges.low[axis] = place - face.half[axis];
    edges.high[axis] = place + face.half[axis];
  }
  return edges;
}

}  // namespace insonify

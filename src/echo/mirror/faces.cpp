// faces.cpp -- groups connected coplanar triangles by union-find, and fits a rectangle to each group.

#include "echo/mirror/faces.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "base/parallel_blocks.h"
#include "echo/mirror/curved_faces.h"
#include "echo/mirror/mesh_sides.h"

namespace insonify {
namespace {

// Normals with a greater cosine between them count as equal (0.8 degrees).
constexpr float kSameNormal = 0.9999F;

constexpr std::size_t kBlock = 1 << 14;  // Triangles or vertices of a task.
constexpr std::uint32_t kNone = MeshFaces::kNone;

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

// The outline of a face.
struct Outline {
  MeshSides::Ends longest = {kNone, kNone};  // Ends of its longest side; of equal ones, the first.
  float length = 0;                          // Length of that side [m].
  float around = 0, layers = 0;              // Length of all sides [m], also as often as its triangles have them.

  // Adds sides that several triangles have.
  void add(const MeshSides::Ends& ends, float own, std::uint32_t times) {
    if (own > length || (own == length && ends < longest)) {
      longest = ends;
      length = own;
    }
    around += own;
    layers += own * static_cast<float>(times);
  }
};

// Sides of an outline that have the same ends.
struct OuterSide {
  std::uint32_t face;
  MeshSides::Ends ends;
  float length;         // [m]
  std::uint32_t times;  // Number of triangles.
};

// Rectangle of a group of triangles: aligned with its longest outer side, with its centroid and area, and with the
// ratio of its extents. The area counts once where triangles cover each other.
Face measure(const Mesh& mesh, const Outline& outline, std::span<const std::uint32_t> group) {
  Face face{.corner = mesh.triangles[group.front()][0]};
  const Vec3f normal = area_vector(mesh, group.back()).normalized();
  const Vec3f along =
      outline.length > 0
          ? Vec3f((mesh.vertices[outline.longest.high] - mesh.vertices[outline.longest.low]).normalized())
          : normal.unitOrthogonal();
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
  const float times = outline.layers > outline.around ? outline.layers / outline.around : 1;
  const float fill = std::sqrt(area / times / (extents[0] * extents[1]));
  face.half = {0.5F * fill * extents[0], 0.5F * fill * extents[1]};
  return face;
}

// [triangle] Unit normals of flat triangles, 0 for others; empty without any.
std::vector<Vec3f> flat_normals(const Mesh& mesh, Workers& workers) {
  std::vector<Vec3f> normals(mesh.triangles.size());
  std::atomic<bool> any = false;
  for_each_block(workers, normals.size(), kBlock, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Vec3f area = area_vector(mesh, i);
      const bool flat = area.norm() > 0 && is_flat(mesh, i, area.normalized());
      normals[i] = flat ? area.normalized() : Vec3f::Zero();
      if (flat) {
        any.store(true, std::memory_order_relaxed);
      }
    }
  });
  if (!any) {
    normals.clear();
  }
  return normals;
}

// [triangle] Root of its group: flat triangles that are connected and coplanar, of whatever winding.
std::vector<std::uint32_t> grouped(const Mesh& mesh, const MeshSides& sides, const std::vector<Vec3f>& normals,
                                   Workers& workers) {
  constexpr std::size_t kMostCompared = 8;                  // First triangles of a side that others are compared with.
  std::vector<std::uint32_t> beside(sides.count(), kNone);  // [side] Triangle that it connects with.
  for_each_block(workers, sides.vertex_count(), kBlock, [&](std::size_t begin, std::size_t end) {
    sides.for_each_edge(begin, end, [&](std::span<const std::uint32_t> together) {
      for (std::size_t k = 1; k < together.size(); ++k) {
        const std::uint32_t i = sides.triangle(together[k]);
        for (const std::uint32_t side : together.first(std::min(k, kMostCompared))) {
          const std::uint32_t other = sides.triangle(side);
          if (std::abs(normals[other].dot(normals[i])) > kSameNormal && mesh.slot_of(other) == mesh.slot_of(i)) {
            beside[together[k]] = other;
            break;
          }
        }
      }
    });
  });
  Groups groups(normals.size());  // In the order of the triangles, on which the roots depend, and the faces' order.
  for (std::uint32_t side = 0; side < beside.size(); ++side) {
    if (beside[side] != kNone) {
      groups.parent[groups.root(sides.triangle(side))] = groups.root(beside[side]);
    }
  }
  for (std::uint32_t i = 0; i < normals.size(); ++i) {
    groups.parent[i] = normals[i].isZero() ? kNone : groups.root(i);
  }
  return std::move(groups.parent);
}

// [triangle] Number of its face, by the order of the roots; returns the number of faces.
std::size_t number_faces(const std::vector<std::uint32_t>& roots, std::vector<std::uint32_t>& face_of) {
  std::uint32_t count = 0;
  face_of.assign(roots.size(), kNone);
  for (const std::uint32_t root : roots) {
    if (root != kNone) {
      face_of[root] = 0;
    }
  }
  for (std::uint32_t& face : face_of) {
    face = face == kNone ? kNone : count++;
  }
  for (std::size_t i = 0; i < roots.size(); ++i) {
    face_of[i] = roots[i] == kNone ? kNone : face_of[roots[i]];
  }
  return count;
}

// The same without groups that are curved surfaces.
std::size_t number_plane_faces(const Mesh& mesh, const std::vector<Vec3f>& normals, std::vector<std::uint32_t> roots,
                               std::vector<std::uint32_t>& face_of) {
  const std::size_t count = number_faces(roots, face_of);
  const std::vector<std::uint8_t> curved = curved_faces(mesh, normals, face_of, count);
  if (!std::ranges::count(curved, 1)) {
    return count;
  }
  for (std::size_t i = 0; i < roots.size(); ++i) {
    roots[i] = face_of[i] != kNone && curved[face_of[i]] != 0 ? kNone : roots[i];
  }
  return number_faces(roots, face_of);
}

// Adds the sides with the same ends that have triangles of a face in one direction only.
// @param by_face  Scratch.
void add_outer_sides(const Mesh& mesh, const MeshSides& sides, const std::vector<Vec3f>& normals,
                     const std::vector<std::uint32_t>& face_of, std::span<const std::uint32_t> together,
                     std::vector<std::pair<std::uint32_t, std::uint32_t>>& by_face, std::vector<OuterSide>& outer) {
  by_face.clear();
  for (const std::uint32_t side : together) {
    by_face.emplace_back(face_of[sides.triangle(side)], side);
  }
  std::ranges::sort(by_face);
  for (std::size_t first = 0, last = 0; first < by_face.size() && by_face[first].first != kNone; first = last) {
    // A triangle lies to the left of its side, seen from the tip of its normal.
    const auto lies_left = [&](std::uint32_t side) {
      const bool same = normals[sides.triangle(side)].dot(normals[sides.triangle(by_face[first].second)]) > 0;
      return sides.runs_upwards(side) == same;
    };
    std::size_t left = 0;
    for (; last < by_face.size() && by_face[last].first == by_face[first].first; ++last) {
      left += lies_left(by_face[last].second) ? 1 : 0;
    }
    if (left == 0 || left == last - first) {
      const MeshSides::Ends ends = sides.ends(together[0]);
      outer.push_back({by_face[first].first, ends, (mesh.vertices[ends.high] - mesh.vertices[ends.low]).norm(),
                       static_cast<std::uint32_t>(last - first)});
    }
  }
}

// [face] Outlines.
std::vector<Outline> outlines_of(const Mesh& mesh, const MeshSides& sides, const std::vector<Vec3f>& normals,
                                 const std::vector<std::uint32_t>& face_of, std::size_t count, Workers& workers) {
  std::vector<std::vector<OuterSide>> outer(sides.vertex_count() / kBlock + 1);
  for_each_block(workers, sides.vertex_count(), kBlock, [&](std::size_t begin, std::size_t end) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> by_face;
    sides.for_each_edge(begin, end, [&](std::span<const std::uint32_t> together) {
      add_outer_sides(mesh, sides, normals, face_of, together, by_face, outer[begin / kBlock]);
    });
  });
  std::vector<Outline> outlines(count);  // Lengths are added in the order of the sides.
  for (const std::vector<OuterSide>& some : outer) {
    for (const OuterSide& side : some) {
      outlines[side.face].add(side.ends, side.length, side.times);
    }
  }
  return outlines;
}

// Measures the faces, given their outlines and which one each triangle belongs to.
void measure_all(const Mesh& mesh, const std::vector<Outline>& outlines, Workers& workers, MeshFaces& found) {
  const std::size_t count = outlines.size();
  std::vector<std::uint32_t> ends(count + 1, 0), members;  // [face] End of its triangles in `members`.
  for (const std::uint32_t face : found.face_of) {
    if (face != kNone) {
      ++ends[face + 1];
    }
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  members.resize(ends.back());
  for (std::uint32_t i = 0; i < found.face_of.size(); ++i) {
    if (found.face_of[i] != kNone) {
      members[ends[found.face_of[i]]++] = i;
    }
  }
  found.faces.resize(count);
  for_each_block(workers, count, 64, [&](std::size_t first, std::size_t last) {
    for (std::size_t face = first; face < last; ++face) {
      const std::uint32_t begin = face == 0 ? 0 : ends[face - 1];
      found.faces[face] = measure(mesh, outlines[face], std::span(members).subspan(begin, ends[face] - begin));
    }
  });
}

}  // namespace

bool is_flat(const Mesh& mesh, std::size_t triangle, const Vec3f& normal) {
  return std::ranges::all_of(mesh.triangles[triangle], [&](std::uint32_t vertex) {
    return std::abs(mesh.normals[vertex].dot(normal)) > kSameNormal;
  });
}

std::shared_ptr<const MeshFaces> find_faces(const Mesh& mesh, Workers& workers) {
  auto found = std::make_shared<MeshFaces>();
  std::vector<Vec3f> normals = flat_normals(mesh, workers);
  if (!normals.empty()) {
    std::optional<MeshSides> sides(std::in_place, mesh, workers);
    const std::size_t count =
        number_plane_faces(mesh, normals, grouped(mesh, *sides, normals, workers), found->face_of);
    const std::vector<Outline> outlines = outlines_of(mesh, *sides, normals, found->face_of, count, workers);
    std::vector<Vec3f>().swap(normals);
    found->edges = find_edge_parts(mesh, *sides, found->face_of, workers);
    sides.reset();
    measure_all(mesh, outlines, workers, *found);
  }
  return found;
}

std::shared_ptr<const MeshFaces> shared_faces(const std::shared_ptr<const Mesh>& mesh, Workers& workers) {
  constexpr std::size_t kFew = 16;
  static std::mutex mutex;
  static std::size_t most = kFew;  // Old entries are erased when there are more.
  static std::map<std::weak_ptr<const Mesh>, std::weak_ptr<const MeshFaces>, std::owner_less<>> known;
  {
    const std::scoped_lock lock(mutex);
    if (known.size() > most) {
      std::erase_if(known, [](const auto& entry) { return entry.first.expired() || entry.second.expired(); });
      most = 2 * known.size() + kFew;
    }
    if (const auto entry = known.find(mesh); entry != known.end()) {
      if (std::shared_ptr<const MeshFaces> faces = entry->second.lock()) {
        return faces;
      }
    }
  }
  std::shared_ptr<const MeshFaces> faces = find_faces(*mesh, workers);
  const std::scoped_lock lock(mutex);
  known[mesh] = faces;
  return faces;
}

FaceTilt FaceTilt::of(const FaceEdges& face, std::uint32_t column, std::uint32_t row, std::uint32_t seed,
                      float wavelength, float incidence) {
  if (!face.finite) {
    return {};
  }
  const FacetSlopes slopes = facet_slopes(column, row, seed ^ kDiffractionSeed);
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

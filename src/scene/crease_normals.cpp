// crease_normals.cpp -- computes vertex normals by grouping the triangles around each vertex into smooth fans.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "scene/mesh_steps.h"
#include "scene/turned_groups.h"

namespace insonify {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

using Triangle = std::array<std::uint32_t, 3>;

// Corners in the order of their vertex: those of vertex v are corners[first[v]] up to corners[first[v + 1]]. A corner
// is 3 * triangle + 0, 1 or 2.
struct CornerLists {
  std::vector<std::size_t> first;
  std::vector<std::size_t> corners;
};

CornerLists corners_by_vertex(const Mesh& mesh) {
  CornerLists lists;
  lists.first.resize(mesh.vertices.size() + 1);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      ++lists.first[vertex + 1];
    }
  }
  std::partial_sum(lists.first.begin(), lists.first.end(), lists.first.begin());

  lists.corners.resize(3 * mesh.triangles.size());
  std::vector<std::size_t> next(lists.first.begin(), lists.first.end() - 1);
  for (std::size_t corner = 0; corner < lists.corners.size(); ++corner) {
    lists.corners[next[mesh.triangles[corner / 3][corner % 3]]++] = corner;
  }
  return lists;
}

// A triangle as seen from one of its corners.
struct CornerSize {
  double angle;  // At the corner [rad].
  double area;   // Twice that of the triangle [m^2].
};

CornerSize corner_size(const Mesh& mesh, std::size_t corner) {
  const Triangle& triangle = mesh.triangles[corner / 3];
  const Vec3 tip = mesh.vertices[triangle[corner % 3]].cast<double>();
  const Vec3 one = mesh.vertices[triangle[(corner % 3 + 1) % 3]].cast<double>() - tip;
  const Vec3 two = mesh.vertices[triangle[(corner % 3 + 2) % 3]].cast<double>() - tip;
  const double area = one.cross(two).norm();
  return {std::atan2(area, one.dot(two)), area};
}

// Triangles count as alike if neither is this many times as large as the other.
constexpr double kAlike = 3;

// Share of a triangle's weight in the normal of a vertex at which the largest triangle is `larger` times as large. A
// face beside much smaller ones is a plane whose edges are rounded: they do not turn its normals, or it would be heard
// as curved.
double share_beside(double larger) {
  constexpr double kWhole = 2, kNone = 4;
  return std::clamp((kNone - larger) / (kNone - kWhole), 0.0, 1.0);
}

// Computes the normals of one vertex at a time; its buffers are reused from vertex to vertex.
class FanSmoother {
 public:
  FanSmoother(Mesh& mesh, double crease_angle)
      : mesh_(mesh),
        vertex_count_(mesh.vertices.size()),
        least_cosine_(static_cast<float>(std::cos(kRounding * crease_angle))),
        least_cosine_unlike_(static_cast<float>(std::cos(kUnlikeCrease * crease_angle))),
        half_way_cosine_(static_cast<float>(std::cos(kUnlikeCrease * crease_angle / 2))) {
    face_normals_.reserve(mesh.triangles.size());
    for (const Triangle& triangle : mesh.triangles) {
      face_normals_.push_back(face_normal(mesh, triangle));
    }
  }

  void smooth(std::span<const std::size_t> corners) {
    groups_.reset(corners.size());
    if (are_all_alike(corners)) {
      join_all(corners);
    } else {
      join_over_flat_edges(corners);
    }
    sum_normals(corners);
    assign_vertices(corners);
  }

 private:
  // The crease angle is that of tubes of eight sides. In bends and by corners in whole millimetres theirs are 41 to 49
  // degrees: a limit of 49.5 makes all of them round, and none of those of seven sides (51) or six.
  static constexpr double kRounding = 1.1;
  // Triangles of unlike sizes share normals up to this part of the crease angle, 35 degrees: a plane and its chamfer of
  // 45 do not, a plane and its rounded edge of two facets or more (22.5) do.
  static constexpr double kUnlikeCrease = 0.78;

  // An edge at the vertex, as an edge of one of its triangles.
  struct Spoke {
    std::uint32_t end;     // Vertex at its far end, before vertices were split.
    std::uint32_t member;  // Index into `corners`.
    bool outgoing;         // Whether the triangle runs along it away from the vertex.
  };

  // Fast test for the common case of a nearly flat surface: if all normals are within half the smallest crease angle
  // of the first, no two differ by more than that angle.
  [[nodiscard]] bool are_all_alike(std::span<const std::size_t> corners) const {
    const Vec3f& first = face_normals_[corners[0] / 3];
    return std::ranges::all_of(
        corners, [&](std::size_t corner) { return first.dot(face_normals_[corner / 3]) >= half_way_cosine_; });
  }

  void join_all(std::span<const std::size_t> corners) {
    for (std::uint32_t member = 1; member < corners.size(); ++member) {
      groups_.join(0, member, false);
    }
  }

  void join_over_flat_edges(std::span<const std::size_t> corners) {
    spokes_.clear();
    for (std::uint32_t member = 0; member < corners.size(); ++member) {
      const Triangle& triangle = mesh_.triangles[corners[member] / 3];
      const std::size_t tip = corners[member] % 3;
      spokes_.push_back({before_split(triangle[(tip + 1) % 3]), member, true});
      spokes_.push_back({before_split(triangle[(tip + 2) % 3]), member, false});
    }
    std::sort(spokes_.begin(), spokes_.end(),
              [](const Spoke& a, const Spoke& b) { return a.end != b.end ? a.end < b.end : a.member < b.member; });

    // Most edges have two triangles. Where many meet, each is compared with the next few only, to stay linear.
    constexpr std::size_t kMostCompared = 4;
    for (std::size_t i = 0; i < spokes_.size(); ++i) {
      for (std::size_t j = i + 1; j < std::min(i + 1 + kMostCompared, spokes_.size()); ++j) {
        if (spokes_[i].end == spokes_[j].end) {
          join_if_flat(corners, spokes_[i], spokes_[j]);
        }
      }
    }
  }

  [[nodiscard]] std::uint32_t before_split(std::uint32_t vertex) const {
    return vertex < vertex_count_ ? vertex : split_from_[vertex - vertex_count_];
  }

  // Joins two triangles that share an edge if they meet flatter than the crease angle. Triangles of the same winding
  // run along their common edge in opposite directions.
  void join_if_flat(std::span<const std::size_t> corners, const Spoke& a, const Spoke& b) {
    const bool turned = a.outgoing == b.outgoing;
    const float dot = face_normals_[corners[a.member] / 3].dot(face_normals_[corners[b.member] / 3]);
    const float cosine = turned ? -dot : dot;
    if (cosine >= least_cosine_unlike_ ||
        (cosine >= least_cosine_ && are_alike(corners[a.member], corners[b.member]))) {
      groups_.join(a.member, b.member, turned);
    }
  }

  // The sizes of triangles that share an edge are as their widths: not alike are a plane and its chamfer.
  [[nodiscard]] bool are_alike(std::size_t a, std::size_t b) const {
    const double one = corner_size(mesh_, a).area;
    const double two = corner_size(mesh_, b).area;
    return std::max(one, two) < kAlike * std::min(one, two);
  }

  void sum_normals(std::span<const std::size_t> corners) {
    sums_.assign(corners.size(), Vec3::Zero());
    largest_.assign(corners.size(), 0);
    sizes_.clear();
    for (std::uint32_t member = 0; member < corners.size(); ++member) {
      sizes_.push_back(corner_size(mesh_, corners[member]));
      double& largest = largest_[groups_.find(member).root];
      largest = std::max(largest, sizes_[member].area);
    }
    for (std::uint32_t member = 0; member < corners.size(); ++member) {
      const TurnedGroups::Member group = groups_.find(member);
      const CornerSize& size = sizes_[member];
      const double weight = size.angle * share_beside(largest_[group.root] / size.area);
      sums_[group.root] += (group.turned ? -weight : weight) * face_normals_[corners[member] / 3].cast<double>();
    }
  }

  // Gives each group of triangles (and each winding within it) its own vertex: the first replaces the
  // original, the others are appended.
  void assign_vertices(std::span<const std::size_t> corners) {
    const std::uint32_t original = mesh_.triangles[corners[0] / 3][corners[0] % 3];
    bool original_taken = false;
    const auto new_vertex = [&](const Vec3f& normal) {
      if (!original_taken) {
        original_taken = true;
        mesh_.normals[original] = normal;
        return original;
      }
      mesh_.vertices.push_back(Vec3f(mesh_.vertices[original]));
      mesh_.normals.push_back(normal);
      split_from_.push_back(original);
      return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
    };

    assigned_.assign(2 * corners.size(), kNone);
    for (std::uint32_t member = 0; member < corners.size(); ++member) {
      const TurnedGroups::Member group = groups_.find(member);
      const Vec3f& own = face_normals_[corners[member] / 3];
      const Vec3f mean = ((group.turned ? -1.0 : 1.0) * sums_[group.root].normalized()).cast<float>();
      std::uint32_t& vertex = mesh_.triangles[corners[member] / 3][corners[member] % 3];
      if (!(mean.dot(own) > 0)) {
        vertex = new_vertex(own);  // The fan bends by more than 90 degrees: its mean does not fit this triangle.
        continue;
      }
      std::uint32_t& shared = assigned_[2 * group.root + (group.turned ? 1 : 0)];
      if (shared == kNone) {
        shared = new_vertex(mean);
      }
      vertex = shared;
    }
  }

  Mesh& mesh_;
  std::size_t vertex_count_;               // Number of vertices before any was split.
  std::vector<std::uint32_t> split_from_;  // For each vertex appended, the one it was split from.
  float least_cosine_;
  float least_cosine_unlike_;
  float half_way_cosine_;
  std::vector<Vec3f> face_normals_;
  TurnedGroups groups_;
  std::vector<Spoke> spokes_;
  std::vector<CornerSize> sizes_;
  std::vector<double> largest_;  // Area of the largest triangle, by the root of its group.
  std::vector<Vec3> sums_;
  std::vector<std::uint32_t> assigned_;
};

}  // namespace

Vec3f face_normal(const Mesh& mesh, const Triangle& triangle) {
  const Vec3 a = mesh.vertices[triangle[0]].cast<double>();
  const Vec3 b = mesh.vertices[triangle[1]].cast<double>();
  const Vec3 c = mesh.vertices[triangle[2]].cast<double>();
  return (b - a).cross(c - a).normalized().cast<float>();
}

void fill_normals(Mesh& mesh, double crease_angle) {
  const CornerLists lists = corners_by_vertex(mesh);
  FanSmoother smoother(mesh, crease_angle);
  for (std::size_t vertex = 0; vertex + 1 < lists.first.size(); ++vertex) {
    const std::size_t first = lists.first[vertex];
    const std::size_t count = lists.first[vertex + 1] - first;
    if (count > 0 && mesh.normals[vertex].isZero(0)) {
      smoother.smooth(std::span(lists.corners).subspan(first, count));
    }
  }
}

std::size_t turn_normals_to_winding(Mesh& mesh) {
  // Cosine between vertex and face normal below which they oppose; rounding alone does not reach it.
  constexpr float kOpposes = -1e-3F;

  // First pass: whether the triangles of each vertex need its normal as it is, reversed, or both.
  constexpr std::uint8_t kKept = 1;
  constexpr std::uint8_t kTurned = 2;
  const std::size_t vertex_count = mesh.vertices.size();
  std::vector<std::uint8_t> asked(vertex_count);
  for (const Triangle& triangle : mesh.triangles) {
    const Vec3f face = face_normal(mesh, triangle);
    for (const std::uint32_t vertex : triangle) {
      asked[vertex] |= mesh.normals[vertex].dot(face) < kOpposes ? kTurned : kKept;
    }
  }

  // Second pass: reverse the normal, or add a copy of the vertex with the reversed normal where both are needed.
  std::size_t turned = 0;
  std::vector<std::uint32_t> copy_of;
  for (std::size_t vertex = 0; vertex < vertex_count; ++vertex) {
    if (asked[vertex] == kTurned) {
      mesh.normals[vertex] = -mesh.normals[vertex];
      ++turned;
    } else if (asked[vertex] == (kKept | kTurned)) {
      copy_of.resize(vertex_count, kNone);
      copy_of[vertex] = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(Vec3f(mesh.vertices[vertex]));
      mesh.normals.push_back(-mesh.normals[vertex]);
      ++turned;
    }
  }

  if (!copy_of.empty()) {
    for (Triangle& triangle : mesh.triangles) {
      const Vec3f face = face_normal(mesh, triangle);
      for (std::uint32_t& vertex : triangle) {
        if (copy_of[vertex] != kNone && mesh.normals[vertex].dot(face) < kOpposes) {
          vertex = copy_of[vertex];
        }
      }
    }
  }
  return turned;
}

}  // namespace insonify

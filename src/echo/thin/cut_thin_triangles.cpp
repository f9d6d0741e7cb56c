// cut_thin_triangles.cpp -- cuts thin parts into short pieces along their axes.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "echo/thin/piece_maker.h"
#include "echo/thin/thin_parts.h"

namespace insonify {
namespace {

constexpr int kWidest = 6;          // Largest extent of a piece across its axis, from its first cell [cells].
constexpr float kFineTurn = 0.13F;  // Largest change of the normal within a facet [rad].
constexpr float kFlat = 1e-3F;      // Differences of unit normals below this are rounding.

struct Vertex {
  Vec3f place = Vec3f::Zero(), normal = Vec3f::Zero();
};
Vertex between(const Vertex& a, const Vertex& b, float share) {
  return {a.place + share * (b.place - a.place), a.normal + share * (b.normal - a.normal)};
}

// A triangle, or what two parallel planes leave of one: 5 corners, or 6 by rounding.
struct Polygon {
  std::array<Vertex, 6> corners;
  std::size_t count = 0;

  void add(const Vertex& corner) { corners[count++] = corner; }
};

// Part of a polygon on one side of the plane x[along] = at; `side` is +1 for above, -1 for below.
Polygon clipped(const Polygon& polygon, int along, float at, float side) {
  Polygon rest;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vertex &a = polygon.corners[i], &b = polygon.corners[(i + 1) % polygon.count];
    const float to_a = side * (a.place[along] - at), to_b = side * (b.place[along] - at);
    if (to_a >= 0) {
      rest.add(a);
    }
    if ((to_a < 0) != (to_b < 0)) {
      rest.add(between(a, b, to_a / (to_a - to_b)));
    }
  }
  return rest;
}

// Bisects a triangle until its normal changes by at most kFineTurn, and calls add(Facet) for each part.
template <typename Add>
void divide(const std::array<Vertex, 3>& corners, bool curved, int depth, const Add& add) {
  constexpr int kDeepest = 12;
  int edge = 0;
  float most = 0;
  for (int k = 0; k < 3; ++k) {
    const float turn = (corners[(k + 1) % 3].normal - corners[k].normal).norm();
    edge = turn > most ? k : edge;
    most = std::max(most, turn);
  }
  if (most > kFineTurn && depth < kDeepest) {
    const Vertex &a = corners[edge], &b = corners[(edge + 1) % 3], &c = corners[(edge + 2) % 3];
    const Vertex half = between(a, b, 0.5F);
    divide({a, half, c}, curved, depth + 1, add);
    divide({half, b, c}, curved, depth + 1, add);
    return;
  }
  const Vec3f cross = (corners[1].place - corners[0].place).cross(corners[2].place - corners[0].place);
  const float area = 0.5F * cross.norm();
  const Vec3f normal = corners[0].normal + corners[1].normal + corners[2].normal;
  if (area > 0 && normal.squaredNorm() > 0) {
    const Vec3f middle = (corners[0].place + corners[1].place + corners[2].place) / 3;
    Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
    for (const Vertex& corner : corners) {  // A triangle's covariance is this sum over its corners.
      spread += (corner.place - middle) * (corner.place - middle).transpose() / 12;
    }
    add(Facet{middle, normal.normalized(), area, spread, curved});
  }
}

// Key of a cell: a box of the mesh frame, one thickness wide across the axis and one slab long along it; or a compact
// body.
struct CellKey {
  SurfaceLabel surface;
  int body;       // ThinTriangle::body
  int along;      // Coordinate of the axis: 0, 1 or 2.
  int thickness;  // In quarter octaves above 1 mm.
  std::array<int, 3> cell;
  auto operator<=>(const CellKey&) const = default;  // NOLINT(modernize-use-nullptr): it means the 0 of an ordering.
};

struct Cell {
  std::vector<Facet> facets;
  bool taken = false;
};

class Cells {
 public:
  // Neighbouring facets mostly fall into one cell.
  void add(const CellKey& key, const Facet& facet) {
    if (last_ == nullptr || last_->first != key) {
      last_ = &*cells_.try_emplace(key).first;
    }
    last_->second.facets.push_back(facet);
  }
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] auto begin() const { return cells_.begin(); }
  [[nodiscard]] auto end() const { return cells_.end(); }

  // Flood fill: moves the facets of a cell, and of all cells connected with it in the same slab, to `facets`.
  void take(const CellKey& seed, const CellKey& key, std::vector<Facet>& facets);

 private:
  std::map<CellKey, Cell> cells_;
  std::pair<const CellKey, Cell>* last_ = nullptr;
};

// The slabs along its axis that a triangle reaches into, numbered from the mesh's origin.
struct Slabs {
  float length;  // Extent of one slab along the axis [m].
  int first, last;

  static Slabs of(const Mesh& mesh, const ThinTriangle& thin, float slab_length) {
    const auto& vertices = mesh.triangles[thin.triangle];
    const float length = slab_length * thin.thickness;
    if (thin.body >= 0) {
      return {length, 0, 0};
    }
    float low = mesh.vertices[vertices[0]][thin.along], high = low;
    for (const std::uint32_t vertex : vertices) {
      low = std::min(low, mesh.vertices[vertex][thin.along]);
      high = std::max(high, mesh.vertices[vertex][thin.along]);
    }
    return {length, static_cast<int>(std::floor(low / length)), static_cast<int>(std::floor(high / length))};
  }
  [[nodiscard]] int count() const { return last - first + 1; }
};

void add_triangle(const Instance& instance, int index, const ThinTriangle& thin, float slab_length, Cells& cells) {
  const Mesh& mesh = *instance.mesh;
  const Slabs slabs = Slabs::of(mesh, thin, slab_length);
  Polygon triangle;
  float turn = 0;
  for (const std::uint32_t vertex : mesh.triangles[thin.triangle]) {
    triangle.add({mesh.vertices[vertex], mesh.normals[vertex]});
    turn = std::max(turn, (mesh.normals[vertex] - triangle.corners[0].normal).norm());
  }
  CellKey key{surface_label(static_cast<std::uint16_t>(index), instance.materials[mesh.slot_of(thin.triangle)]),
              thin.body,
              thin.body >= 0 ? 0 : thin.along,
              static_cast<int>(std::lround(4 * std::log2(thin.thickness / 1e-3F))),
              {}};
  for (int i = slabs.first; i <= slabs.last; ++i) {
    Polygon polygon = triangle;
    if (thin.body < 0) {
      polygon = clipped(polygon, thin.along, slabs.length * static_cast<float>(i), 1);
      polygon = clipped(polygon, thin.along, slabs.length * static_cast<float>(i + 1), -1);
    }
    for (std::size_t k = 2; k < polygon.count; ++k) {
      divide({polygon.corners[0], polygon.corners[k - 1], polygon.corners[k]}, turn > kFlat, 0,
             [&](const Facet& facet) {
               for (int d = 0; d < 3 && thin.body < 0; ++d) {
                 key.cell[d] = d == thin.along ? i : static_cast<int>(std::floor(facet.middle[d] / thin.thickness));
               }
               cells.add(key, facet);
             });
    }
  }
}

void Cells::take(const CellKey& seed, const CellKey& key, std::vector<Facet>& facets) {
  const auto found = cells_.find(key);
  if (found == cells_.end() || found->second.taken) {
    return;
  }
  found->second.taken = true;
  facets.insert(facets.end(), found->second.facets.begin(), found->second.facets.end());
  const int one = (key.along + 1) % 3, two = (key.along + 2) % 3;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      CellKey next = key;
      next.cell[one] += i;
      next.cell[two] += j;
      if (std::abs(next.cell[one] - seed.cell[one]) <= kWidest &&
          std::abs(next.cell[two] - seed.cell[two]) <= kWidest) {
        take(seed, next, facets);
      }
    }
  }
}

}  // namespace

bool cut_thin_triangles(const Instance& instance, int index, const std::vector<ThinTriangle>& thin, float slab,
                        ThinParts& parts) {
  // Each slab gives at least one piece. That there are too many is thus found before a long cable is cut.
  for (const ThinTriangle& triangle : thin) {
    if (Slabs::of(*instance.mesh, triangle, slab).count() >
        static_cast<int>(ThinParts::kMostPieces - parts.pieces.size())) {
      return false;
    }
  }
  Cells cells;
  constexpr std::size_t kCellsPerPiece = 16;
  for (const ThinTriangle& triangle : thin) {
    if (!triangle.copy) {
      add_triangle(instance, index, triangle, slab, cells);
    }
    if (cells.size() > kCellsPerPiece * (ThinParts::kMostPieces - parts.pieces.size())) {
      return false;
    }
  }
  const std::size_t pieces = parts.pieces.size(), patches = parts.patches.size();
  std::vector<Facet> facets;
  for (const auto& [key, cell] : cells) {
    facets.clear();
    cells.take(key, key, facets);
    if (facets.empty()) {
      continue;
    }
    if (parts.pieces.size() == ThinParts::kMostPieces) {
      parts.pieces.resize(pieces);
      parts.patches.resize(patches);
      return false;
    }
    const float thickness = 1e-3F * std::exp2(0.25F * static_cast<float>(key.thickness));
    const PieceMaker maker(facets, key.body >= 0 || thickness > ThinParts::kThickest);
    const auto first_patch = static_cast<std::uint32_t>(parts.patches.size());
    maker.add_patches(parts.patches);
    parts.pieces.push_back({key.surface, maker.middle(), maker.half(), thickness, first_patch,
                            static_cast<std::uint32_t>(parts.patches.size())});
  }
  return true;
}

}  // namespace insonify

// cut_thin_triangles.cpp -- cuts thin parts into short pieces along their axes, and bins each piece's area by normal.

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>

#include "echo/laws/laws.h"
#include "echo/targets/thin_parts.h"

namespace insonify {
namespace {

constexpr int kWidest = 6;            // Largest extent of a piece across its axis, from its first cell [cells].
constexpr float kTurnStep = 0.2618F;  // Spacing of the normals of curved surfaces' bins: 15 degrees [rad].
constexpr float kFineTurn = 0.13F;    // Largest change of the normal within a facet [rad].
constexpr float kFlat = 1e-3F;        // Differences of unit normals below this are rounding.

struct Vertex {
  Vec3f place, normal;
};
Vertex between(const Vertex& a, const Vertex& b, float share) {
  return {a.place + share * (b.place - a.place), a.normal + share * (b.normal - a.normal)};
}

// A small part of the surface with nearly constant normal.
struct Facet {
  Vec3f middle, normal;
  float area;
  Eigen::Matrix3f spread;  // Covariance of its points [m^2].
  bool curved;
};

// Part of a convex polygon on one side of the plane x[along] = at; `side` is +1 for above, -1 for below.
std::vector<Vertex> clipped(const std::vector<Vertex>& polygon, int along, float at, float side) {
  std::vector<Vertex> rest;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const float to_a = side * (a.place[along] - at), to_b = side * (b.place[along] - at);
    if (to_a >= 0) {
      rest.push_back(a);
    }
    if ((to_a < 0) != (to_b < 0)) {
      rest.push_back(between(a, b, to_a / (to_a - to_b)));
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

// Key of a cell: a box of the mesh frame, one thickness wide across the axis and one slab long along it.
struct CellKey {
  SurfaceLabel surface;
  int along;      // Coordinate of the axis: 0, 1 or 2.
  int thickness;  // In quarter octaves above 1 mm.
  std::array<int, 3> cell;
  auto operator<=>(const CellKey&) const = default;  // NOLINT(modernize-use-nullptr): it means the 0 of an ordering.
};

struct Cell {
  std::vector<Facet> facets;
  bool taken = false;
};
using Cells = std::map<CellKey, Cell>;

// The slabs along its axis that a triangle reaches into, numbered from the mesh's origin.
struct Slabs {
  float length;  // Extent of one slab along the axis [m].
  int first, last;

  static Slabs of(const Mesh& mesh, const ThinTriangle& thin, float slab_length) {
    const auto& vertices = mesh.triangles[thin.triangle];
    const float length = slab_length * thin.thickness;
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
  std::vector<Vertex> triangle;
  float turn = 0;
  for (const std::uint32_t vertex : mesh.triangles[thin.triangle]) {
    triangle.push_back({mesh.vertices[vertex], mesh.normals[vertex]});
    turn = std::max(turn, (triangle.back().normal - triangle.front().normal).norm());
  }
  CellKey key{surface_label(static_cast<std::uint16_t>(index), instance.materials[mesh.slot_of(thin.triangle)]),
              thin.along,
              static_cast<int>(std::lround(4 * std::log2(thin.thickness / 1e-3F))),
              {}};
  for (int i = slabs.first; i <= slabs.last; ++i) {
    const std::vector<Vertex> above = clipped(triangle, thin.along, slabs.length * static_cast<float>(i), 1);
    const std::vector<Vertex> polygon = clipped(above, thin.along, slabs.length * static_cast<float>(i + 1), -1);
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      divide({polygon[0], polygon[k - 1], polygon[k]}, turn > kFlat, 0, [&](const Facet& facet) {
        for (int d = 0; d < 3; ++d) {
          key.cell[d] = d == thin.along ? i : static_cast<int>(std::floor(facet.middle[d] / thin.thickness));
        }
        cells[key].facets.push_back(facet);
      });
    }
  }
}

// Flood fill: moves the facets of a cell, and of all cells connected with it in the same slab, to `facets`.
void take(const CellKey& seed, const CellKey& key, Cells& cells, std::vector<Facet>& facets) {
  const auto found = cells.find(key);
  if (found == cells.end() || found->second.taken) {
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
        take(seed, next, cells, facets);
      }
    }
  }
}

// Sums over the facets of one bin of normals, weighted by area.
struct Sorted {
  float area = 0;
  float along = 0, along_square = 0;  // Angle between normal and cross section [rad], and its square.
  Vec3f normal = Vec3f::Zero(), place = Vec3f::Zero();
};

// Computes middle, axis and patches of a piece from its facets.
class PieceMaker {
 public:
  explicit PieceMaker(const std::vector<Facet>& facets) {
    for (const Facet& facet : facets) {
      area_ += facet.area;
      middle_ += facet.area * facet.middle;
    }
    middle_ /= area_;
    Eigen::Matrix3f covariance = Eigen::Matrix3f::Zero();
    for (const Facet& facet : facets) {
      const Vec3f from = facet.middle - middle_;
      covariance += facet.area / area_ * (from * from.transpose() + facet.spread);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver(covariance);
    axis_ = solver.eigenvectors().col(2).normalized();
    // A straight piece of length l has a variance of l^2 / 12 along its axis.
    constexpr float kLong = 2;
    const Vec3f& variance = solver.eigenvalues();
    half_ = variance[2] > kLong * variance[1] ? Vec3f(std::sqrt(3 * variance[2]) * axis_) : Vec3f(Vec3f::Zero());
    one_ = axis_.unitOrthogonal();
    two_ = axis_.cross(one_);
    for (const Facet& facet : facets) {
      sort(facet);
    }
  }

  [[nodiscard]] const Vec3f& middle() const { return middle_; }
  [[nodiscard]] const Vec3f& half() const { return half_; }

  void add_patches(std::vector<ThinParts::Patch>& patches) const {
    for (const auto& [key, sum] : sorted_) {
      const auto [kind, around, along] = key;
      ThinParts::Patch patch{};
      patch.area = sum.area;
      const Vec3f from = sum.place / sum.area - middle_;
      patch.offset = from - (half_.isZero() ? 0.0F : from.dot(axis_)) * axis_;
      if (kind == 0) {
        patch.normal = sum.normal.normalized();
        patch.around = patch.along = Vec3f::Zero();
      } else {
        const float angle = kTurnStep * static_cast<float>(around), rise = sum.along / sum.area;
        const Vec3f out = std::cos(angle) * one_ + std::sin(angle) * two_;
        patch.normal = std::cos(rise) * out + std::sin(rise) * axis_;
        patch.around = kTurnStep * std::cos(rise) * (std::cos(angle) * two_ - std::sin(angle) * one_);
        // Along the axis a bin is uniform: its variance w^2/12 is half the w^2/6 of the triangular bins around the
        // axis.
        const float variance = std::max(sum.along_square / sum.area - rise * rise, 0.0F);
        const float turn = variance < kFlat * kFlat ? 0.0F : std::sqrt(2 * variance / kFootprintVariance);
        patch.along = turn * (std::cos(rise) * axis_ - std::sin(rise) * out);
      }
      patches.push_back(patch);
    }
  }

 private:
  void add(const std::array<int, 3>& key, const Facet& facet, float share, float rise) {
    Sorted& sum = sorted_[key];
    const float area = share * facet.area;
    sum.area += area;
    sum.along += area * rise;
    sum.along_square += area * rise * rise;
    sum.normal += area * facet.normal;
    sum.place += area * facet.middle;
  }

  // Flat facets are binned by their normal. The area of a curved one is shared between the two nearest of the evenly
  // spaced normals around the axis (linear interpolation), so that a round rod's echo does not depend on its roll.
  void sort(const Facet& facet) {
    constexpr float kFlatTurn = 0.01F;
    if (!facet.curved) {
      const Vec3f rounded = facet.normal / kFlatTurn;
      const auto x = static_cast<int>(std::lround(rounded.x())), y = static_cast<int>(std::lround(rounded.y())),
                 z = static_cast<int>(std::lround(rounded.z()));
      add({0, x * 512 + y, z}, facet, 1, 0);
      return;
    }
    constexpr int kAround = 24;
    const float rise = std::asin(std::clamp(facet.normal.dot(axis_), -1.0F, 1.0F));
    const float angle = std::atan2(facet.normal.dot(two_), facet.normal.dot(one_)) / kTurnStep + kAround;
    const int below = static_cast<int>(angle), along = static_cast<int>(std::lround(rise / kTurnStep));
    const float share = angle - static_cast<float>(below);
    add({1, below % kAround, along}, facet, 1 - share, rise);
    add({1, (below + 1) % kAround, along}, facet, share, rise);
  }

  float area_ = 0;
  Vec3f middle_ = Vec3f::Zero(), half_, axis_, one_, two_;
  std::map<std::array<int, 3>, Sorted> sorted_;
};

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
    add_triangle(instance, index, triangle, slab, cells);
    if (cells.size() > kCellsPerPiece * (ThinParts::kMostPieces - parts.pieces.size())) {
      return false;
    }
  }
  const std::size_t pieces = parts.pieces.size(), patches = parts.patches.size();
  std::vector<Facet> facets;
  for (const auto& [key, cell] : cells) {
    facets.clear();
    take(key, key, cells, facets);
    if (facets.empty()) {
      continue;
    }
    if (parts.pieces.size() == ThinParts::kMostPieces) {
      parts.pieces.resize(pieces);
      parts.patches.resize(patches);
      return false;
    }
    const PieceMaker maker(facets);
    const auto first_patch = static_cast<std::uint32_t>(parts.patches.size());
    maker.add_patches(parts.patches);
    parts.pieces.push_back({key.surface, maker.middle(), maker.half(),
                            1e-3F * std::exp2(0.25F * static_cast<float>(key.thickness)), first_patch,
                            static_cast<std::uint32_t>(parts.patches.size())});
  }
  return true;
}

}  // namespace insonify

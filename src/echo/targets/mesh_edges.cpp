// mesh_edges.cpp -- measures the edges between faces of a mesh, and joins those of thin sheets.

#include "echo/targets/mesh_edges.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>

#include "echo/mirror/edge_parts.h"
#include "scene/same_places.h"

namespace insonify {
namespace {

// Parts of edges of a mesh, and the distance below which its corners are one [m].
struct MeshParts {
  const Mesh& mesh;
  double tolerance;
  std::vector<EdgePart> parts;
};

// Extends the edge over all parts of its chain. False if one of their ends is off the edge's line.
bool extend(const MeshParts& found, const std::vector<std::uint32_t>& members, StraightEdges::Edge& edge) {
  const auto each_end = [&](auto&& visit) {
    for (const std::uint32_t i : members) {
      visit(edge_vertex(found.mesh, found.parts[i].low));
      visit(edge_vertex(found.mesh, found.parts[i].high));
    }
  };
  Vec3 first = edge.middle, last = edge.middle;
  each_end([&](const Vec3& end) {
    first = (end - edge.middle).dot(edge.along) < (first - edge.middle).dot(edge.along) ? end : first;
    last = (end - edge.middle).dot(edge.along) > (last - edge.middle).dot(edge.along) ? end : last;
  });
  edge.half = 0.5 * (last - first).norm();
  edge.middle = 0.5 * (first + last);
  edge.along = (last - first).normalized();
  bool straight = true;
  const double off = std::max(StraightEdges::kStraight, 2 * found.tolerance);
  each_end([&](const Vec3& end) { straight = straight && (end - edge.middle).cross(edge.along).norm() < off; });
  return straight && 2 * edge.half >= StraightEdges::kLeastLength;
}

// Sets the directions of both faces from the edge, and the exterior angle between them.
// @param second  Null at a border.
void set_sides(StraightEdges::Edge& edge, const Vec3& first, const Vec3* second) {
  auto& [one, two] = edge.sides;
  one.inwards = first;
  if (second == nullptr) {
    two.inwards = one.inwards;
    one.normal = edge.along.cross(one.inwards).normalized();
    two.normal = -one.normal;
    edge.exterior = 2;
    return;
  }
  two.inwards = *second;
  const double cosine = std::clamp(one.inwards.dot(two.inwards), -1.0, 1.0);
  one.normal = (cosine * one.inwards - two.inwards).normalized();
  two.normal = (cosine * two.inwards - one.inwards).normalized();
  edge.exterior = 2 - std::acos(cosine) / std::numbers::pi;
}

bool is_close(const StraightEdges::Edge& one, const StraightEdges::Edge& two) {
  return (one.middle - two.middle).norm() < StraightEdges::kFree &&
         std::abs(one.half - two.half) < StraightEdges::kFree &&
         one.along.cross(two.along).norm() * one.half < StraightEdges::kFree;
}

// The edge that two close ones are together: without the face between them, of which faces in one direction are the
// two sides of a sheet. None if more than two faces are left, or the two left go on in each other's plane.
std::optional<FaceEdge> joined(const FaceEdge& one, const FaceEdge& two) {
  constexpr double kSame = 0.999;
  std::vector<std::pair<StraightEdges::Side, std::uint32_t>> sides;
  for (const auto& [each, other] : {std::pair(&one, &two), std::pair(&two, &one)}) {
    for (int k = 0; k < (each->face[1] == MeshFaces::kNone ? 1 : 2); ++k) {
      if (std::ranges::find(other->face, each->face[k]) == other->face.end()) {
        sides.emplace_back(each->edge.sides[k], each->face[k]);
      }
    }
  }
  if (sides.size() != 2) {
    return {};
  }
  const double cosine = sides[0].first.inwards.dot(sides[1].first.inwards);
  if (cosine <= -std::cos(EdgePart::kLeastTurn)) {
    return {};
  }
  FaceEdge both = one;
  both.edge.middle = 0.5 * (one.edge.middle + two.edge.middle);
  both.edge.apart = (one.edge.middle - two.edge.middle).norm();
  const Vec3 first = sides[0].first.inwards, second = sides[1].first.inwards;
  set_sides(both.edge, first, cosine > kSame ? nullptr : &second);
  // A border's first side is that of the face whose normal it has.
  if (cosine > kSame && sides[0].first.normal.dot(both.edge.sides[0].normal) < 0) {
    std::swap(sides[0], sides[1]);
  }
  for (int k = 0; k < 2; ++k) {
    StraightEdges::Side& side = both.edge.sides[k];
    side.surface = sides[k].first.surface;
    side.sign = sides[k].first.sign;
    side.face = sides[k].first.face;
    both.face[k] = sides[k].second;
  }
  return both;
}

// Joins edges that are closer to each other than kFree: the two edges of the rim of a sheet, the borders of both sides
// of an open one, the edges of a narrow chamfer.
void join_close(const MeshFaces& faces, std::vector<FaceEdge>& edges) {
  static constexpr double kCell = 2 * StraightEdges::kFree;
  const auto is_narrow = [&](std::uint32_t face) {
    return face == MeshFaces::kNone || faces.faces[face].width() < static_cast<float>(StraightEdges::kFree);
  };
  const auto cell_of = [](const Vec3& place, const Vec3& off) {
    const Vec3 cell = (place / kCell + off).array().floor();
    return std::array{cell.x(), cell.y(), cell.z()};
  };
  std::map<std::array<double, 3>, std::vector<std::uint32_t>> cells;  // [cell] Edges that have found no other yet.
  std::vector<std::uint8_t> gone(edges.size(), 0);
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    if (!is_narrow(edges[i].face[0]) && !is_narrow(edges[i].face[1])) {
      continue;
    }
    for (int corner = 0; corner < 8 && gone[i] == 0; ++corner) {
      const Vec3 off = Vec3(corner & 1, corner >> 1 & 1, corner >> 2) - Vec3::Constant(0.5);
      std::vector<std::uint32_t>& near = cells[cell_of(edges[i].edge.middle, off)];
      const auto other =
          std::ranges::find_if(near, [&](std::uint32_t j) { return is_close(edges[j].edge, edges[i].edge); });
      if (other != near.end()) {
        const std::optional<FaceEdge> both = joined(edges[*other], edges[i]);
        gone[i] = 1;
        gone[*other] = both ? 0 : 1;
        edges[*other] = both.value_or(edges[*other]);
        near.erase(other);
      }
    }
    if (gone[i] == 0) {
      cells[cell_of(edges[i].edge.middle, Vec3::Zero())].push_back(i);
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (gone[i] == 0) {
      edges[kept++] = edges[i];
    }
  }
  edges.resize(kept);
}

// Index among all GlintingFaces by index in MeshFaces, for one instance.
std::map<std::uint32_t, std::size_t> numbers_of(const GlintingFaces& faces, int instance) {
  std::map<std::uint32_t, std::size_t> numbers;
  const GlintingFaces::Group* const group = faces.group_of(instance);
  for (std::size_t i = 0; group != nullptr && i < group->face.size(); ++i) {
    numbers[group->face[i]] = group->first_number + i;
  }
  return numbers;
}

// Parts between faces that reflect coherently.
MeshParts coherent_parts(const Scene& scene, const Instance& instance, const MeshFaces& faces) {
  const Mesh& mesh = *instance.mesh;
  MeshParts found{mesh, double{same_place_tolerance(mesh.vertices)}, {}};
  std::ranges::copy_if(faces.edges, std::back_inserter(found.parts), [&](const EdgePart& part) {
    const auto coherent = [&](int k) { return reflects_coherently(scene, instance, mesh.slot_of(part.triangle(k))); };
    return coherent(0) && (part.is_border() || coherent(1));
  });
  return found;
}

// One side of an edge.
// @param number  Of its face among all GlintingFaces.
void set_face(const Scene& scene, int index, std::uint32_t triangle, std::size_t number, StraightEdges::Side& side) {
  const Instance& instance = scene.instances[index];
  const std::uint16_t slot = instance.materials[instance.mesh->slot_of(triangle)];
  const Material& material = scene.materials[slot];
  side.surface = surface_label(static_cast<std::uint16_t>(index), slot);
  side.sign = !material.reflection && material.reflection_coefficient(kSeaWaterImpedance) < 0 ? -1.0 : 1.0;
  side.face = number;
}

// The edges of one instance, however many edges are close to them.
std::vector<FaceEdge> find_single_edges(const Scene& scene, int index, const GlintingFaces& faces) {
  const Instance& instance = scene.instances[index];
  const Mesh& mesh = *instance.mesh;
  const MeshParts found = coherent_parts(scene, instance, *faces.of_mesh[index]);
  const std::vector<EdgePart>& parts = found.parts;
  const std::map<std::uint32_t, std::size_t> numbers = numbers_of(faces, index);
  std::map<std::uint32_t, std::vector<std::uint32_t>> chains;
  const std::vector<std::uint32_t> chain = chains_of(mesh, parts, found.tolerance);
  for (std::uint32_t i = 0; i < parts.size(); ++i) {
    chains[chain[i]].push_back(i);
  }
  std::vector<FaceEdge> edges;
  for (const auto& [root, members] : chains) {
    const auto length = [&](std::uint32_t i) {
      return (edge_vertex(mesh, parts[i].high) - edge_vertex(mesh, parts[i].low)).norm();
    };
    const EdgePart& longest = parts[*std::ranges::max_element(members, {}, length)];
    StraightEdges::Edge edge;
    edge.middle = 0.5 * (edge_vertex(mesh, longest.low) + edge_vertex(mesh, longest.high));
    edge.along = (edge_vertex(mesh, longest.high) - edge_vertex(mesh, longest.low)).normalized();
    if (!extend(found, members, edge)) {
      continue;
    }
    const auto inwards = [&](int side) -> Vec3 {
      const Vec3 off = opposite_vertex(mesh, longest, side) - edge.middle;
      return (off - off.dot(edge.along) * edge.along).normalized();
    };
    const bool border = longest.is_border();
    const Vec3 second = inwards(border ? 0 : 1);
    set_sides(edge, inwards(0), border ? nullptr : &second);
    for (int k = 0; k < 2; ++k) {
      const int of = border ? 0 : k;
      const auto number = numbers.find(longest.face[of]);
      set_face(scene, index, longest.triangle(of), number == numbers.end() ? StraightEdges::kNoGlint : number->second,
               edge.sides[k]);
    }
    edges.push_back({edge, longest.face});
  }
  return edges;
}

}  // namespace

std::vector<FaceEdge> find_mesh_edges(const Scene& scene, int index, const GlintingFaces& faces) {
  std::vector<FaceEdge> edges = find_single_edges(scene, index, faces);
  join_close(*faces.of_mesh[index], edges);
  return edges;
}

}  // namespace insonify

// find_straight_edges.cpp -- measures the edges between faces, and rejects those that something else touches.

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <numbers>

#include "echo/targets/alike.h"
#include "echo/targets/edge_parts.h"
#include "echo/targets/straight_edges.h"

namespace insonify {
namespace {

using PlacedEdge = std::pair<int, StraightEdges::Edge>;  // Instance and edge.

// Extends the edge over all parts of its chain. False if one of their ends is off the edge's line.
bool extend(const Mesh& mesh, const std::vector<EdgePart>& parts, const std::vector<std::uint32_t>& members,
            StraightEdges::Edge& edge) {
  const auto each_end = [&](auto&& visit) {
    for (const std::uint32_t i : members) {
      visit(edge_vertex(mesh, parts[i].low));
      visit(edge_vertex(mesh, parts[i].high));
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
  each_end([&](const Vec3& end) {
    straight = straight && (end - edge.middle).cross(edge.along).norm() < StraightEdges::kStraight;
  });
  return straight && 2 * edge.half >= StraightEdges::kLeastLength;
}

// Sets the directions of both faces from the edge, and the exterior angle between them.
void set_sides(StraightEdges::Edge& edge, const Vec3& first, const Vec3* second) {
  const auto inwards = [&](const Vec3& corner) -> Vec3 {
    const Vec3 off = corner - edge.middle;
    return (off - off.dot(edge.along) * edge.along).normalized();
  };
  auto& [one, two] = edge.sides;
  one.inwards = inwards(first);
  if (second == nullptr) {
    two.inwards = one.inwards;
    one.normal = edge.along.cross(one.inwards).normalized();
    two.normal = -one.normal;
    edge.exterior = 2;
    return;
  }
  two.inwards = inwards(*second);
  const double cosine = std::clamp(one.inwards.dot(two.inwards), -1.0, 1.0);
  one.normal = (cosine * one.inwards - two.inwards).normalized();
  two.normal = (cosine * two.inwards - one.inwards).normalized();
  edge.exterior = 2 - std::acos(cosine) / std::numbers::pi;
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

// [triangle] 1 if it belongs to a plane face that reflects coherently.
std::vector<std::uint8_t> coherent_triangles(const Scene& scene, const Instance& instance, const MeshFaces& faces) {
  std::vector<std::uint8_t> coherent(instance.mesh->triangles.size(), 0);
  for (std::size_t t = 0; t < faces.face_of.size(); ++t) {
    coherent[t] =
        faces.face_of[t] != MeshFaces::kNone && reflects_coherently(scene, instance, instance.mesh->slot_of(t));
  }
  return coherent;
}

// Adds the edges of one instance.
void add_edges(const Scene& scene, int index, const GlintingFaces& faces, Workers& workers,
               std::vector<PlacedEdge>& edges) {
  const Instance& instance = scene.instances[index];
  const Mesh& mesh = *instance.mesh;
  const MeshFaces& of_mesh = *faces.of_mesh[index];
  const EdgeParts found(mesh, of_mesh, coherent_triangles(scene, instance, of_mesh), StraightEdges::kLeastTurn,
                        workers);
  const std::vector<EdgePart>& parts = found.parts();
  const std::map<std::uint32_t, std::size_t> numbers = numbers_of(faces, index);
  std::map<std::uint32_t, std::vector<std::uint32_t>> chains;
  const std::vector<std::uint32_t> chain = found.chains();
  for (std::uint32_t i = 0; i < parts.size(); ++i) {
    chains[chain[i]].push_back(i);
  }
  for (const auto& [root, members] : chains) {
    const auto length = [&](std::uint32_t i) {
      return (edge_vertex(mesh, parts[i].high) - edge_vertex(mesh, parts[i].low)).norm();
    };
    const EdgePart& longest = parts[*std::ranges::max_element(members, {}, length)];
    StraightEdges::Edge edge;
    edge.middle = 0.5 * (edge_vertex(mesh, longest.low) + edge_vertex(mesh, longest.high));
    edge.along = (edge_vertex(mesh, longest.high) - edge_vertex(mesh, longest.low)).normalized();
    if (!extend(mesh, parts, members, edge)) {
      continue;
    }
    const Vec3 first = found.opposite(longest, 0);
    const bool border = longest.is_border();
    const Vec3 second = border ? first : found.opposite(longest, 1);
    set_sides(edge, first, border ? nullptr : &second);
    bool thin = false;
    for (int k = 0; k < 2; ++k) {
      StraightEdges::Side& side = edge.sides[k];
      const std::uint16_t slot = instance.materials[mesh.slot_of(longest.triangle[border ? 0 : k])];
      const Material& material = scene.materials[slot];
      side.surface = surface_label(static_cast<std::uint16_t>(index), slot);
      side.sign = !material.reflection && material.reflection_coefficient(kSeaWaterImpedance) < 0 ? -1.0 : 1.0;
      const auto number = numbers.find(longest.face[border ? 0 : k]);
      thin = thin || number == numbers.end();
      side.face = number == numbers.end() ? StraightEdges::kNoGlint : number->second;
    }
    if (thin && (border || edge.exterior < 1 + StraightEdges::kSquareTurn / std::numbers::pi)) {
      continue;
    }
    edges.emplace_back(index, edge);
  }
}

// Whether the faces of two instances that are alike glint alike too.
bool glint_alike(const GlintingFaces& faces, std::size_t one, std::size_t other) {
  const GlintingFaces::Group *const a = faces.group_of(one), *const b = faces.group_of(other);
  return a == nullptr || b == nullptr ? a == b : a->face == b->face;
}

// An edge of one instance as that of another that is alike.
PlacedEdge on_other(PlacedEdge placed, std::size_t other, const GlintingFaces& faces) {
  const GlintingFaces::Group *const from = faces.group_of(placed.first), *const to = faces.group_of(other);
  for (StraightEdges::Side& side : placed.second.sides) {
    side.surface = surface_label(static_cast<std::uint16_t>(other), material_of(side.surface));
    side.face = side.face == StraightEdges::kNoGlint ? side.face : side.face - from->first_number + to->first_number;
  }
  placed.first = static_cast<int>(other);
  return placed;
}

// The edges of all instances.
std::vector<PlacedEdge> edges_of(const Scene& scene, const GlintingFaces& faces, Workers& workers) {
  std::vector<PlacedEdge> edges;
  const std::vector<std::size_t> first = first_alike(scene);
  std::vector<std::pair<std::size_t, std::size_t>> own(first.size());  // [instance] The range of its edges.
  for (std::size_t i = 0; i < faces.of_mesh.size(); ++i) {
    if (!faces.of_mesh[i] || faces.of_mesh[i]->faces.empty()) {
      continue;
    }
    own[i].first = edges.size();
    if (first[i] == i || !glint_alike(faces, i, first[i])) {
      add_edges(scene, static_cast<int>(i), faces, workers, edges);
    } else {
      for (std::size_t k = own[first[i]].first; k < own[first[i]].second; ++k) {
        edges.push_back(on_other(edges[k], i, faces));
      }
    }
    own[i].second = edges.size();
  }
  return edges;
}

// Tests with rays whether something touches an edge: an open polygon of rays around it, through the water, at two
// places, and at a third where these differ.
class Surroundings {
 public:
  Surroundings(const Scene& scene, Engine& engine) : scene_(scene), engine_(engine) {}

  // Removes edges where the rays of two places are blocked.
  void remove_touched(std::vector<PlacedEdge>& edges) {
    std::vector<int> open = count_free(edges, {kPlaces[0], kPlaces[1]});
    std::vector<PlacedEdge> unsure;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (open[i] == 1) {
        unsure.push_back(edges[i]);
      }
    }
    const std::vector<int> third = count_free(unsure, {kPlaces[2]});
    std::size_t free = 0, next = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const int count = open[i] == 1 ? 1 + third[next++] : open[i];
      if (count == 2) {
        edges[free++] = edges[i];
      }
    }
    edges.resize(free);
  }

 private:
  static constexpr double kPlaces[] = {-0.59, 0.41, -0.07};  // Places along the edge [half lengths].
  static constexpr double kMargin = 0.15, kStep = 2.1;       // Angle to the faces, largest step of the polygon [rad].

  // [edge] Number of places at which no ray is blocked.
  std::vector<int> count_free(const std::vector<PlacedEdge>& edges, std::initializer_list<double> places) {
    rays_.clear();
    std::vector<std::size_t> ends;
    for (const auto& [instance, edge] : edges) {
      for (const double place : places) {
        add_rays(scene_.instances[instance].world_from_mesh, edge, edge.middle + place * edge.half * edge.along);
        ends.push_back(rays_.size());
      }
    }
    hits_.resize(rays_.size());
    engine_.trace(rays_, hits_);
    std::vector<int> open(edges.size());
    std::size_t ray = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const std::size_t edge = i / places.size();
      bool clear = true;
      for (; ray < ends[i]; ++ray) {
        clear = clear && !counts(edges[edge].first, hits_[ray]);
      }
      open[edge] += clear ? 1 : 0;
    }
    return open;
  }

  void add_rays(const Pose& world_from_mesh, const StraightEdges::Edge& edge, const Vec3& place) {
    const StraightEdges::Side& side = edge.sides[0];
    const double whole = edge.exterior * std::numbers::pi - 2 * kMargin;
    const int count = static_cast<int>(std::ceil(whole / kStep));
    const auto corner = [&](int i) -> Vec3 {
      const double angle = kMargin + whole * i / count;
      return world_from_mesh *
             Vec3(place + StraightEdges::kFree * (std::cos(angle) * side.inwards + std::sin(angle) * side.normal));
    };
    for (int i = 0; i < count; ++i) {
      const Vec3 from = corner(i), step = corner(i + 1) - from;
      rays_.push_back({from, step.normalized(), 0, step.norm()});
    }
  }

  // Whether a hit blocks: any on the same instance, and on another if both are static.
  [[nodiscard]] bool counts(int instance, const Hit& hit) const {
    if (!std::isfinite(hit.distance) || hit.instance == kNoLabel) {
      return false;
    }
    const Instance& other = scene_.instances[hit.instance];
    return hit.instance == instance || (!other.endless && !other.moving && !scene_.instances[instance].moving);
  }

  const Scene& scene_;
  Engine& engine_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
};

StraightEdges::Edge moved(StraightEdges::Edge edge, const Pose& pose) {
  edge.middle = pose * edge.middle;
  edge.along = pose.orientation * edge.along;
  for (StraightEdges::Side& side : edge.sides) {
    side.inwards = pose.orientation * side.inwards;
    side.normal = pose.orientation * side.normal;
  }
  return edge;
}

void append_edge(StraightEdges::Group& group, const StraightEdges::Edge& edge) {
  const auto add = [](const Vec3& vector, std::vector<float>& x, std::vector<float>& y, std::vector<float>& z) {
    x.push_back(static_cast<float>(vector.x()));
    y.push_back(static_cast<float>(vector.y()));
    z.push_back(static_cast<float>(vector.z()));
  };
  add(edge.middle, group.middle_x, group.middle_y, group.middle_z);
  add(edge.along, group.along_x, group.along_y, group.along_z);
  add(edge.sides[0].normal, group.first_x, group.first_y, group.first_z);
  add(edge.sides[1].normal, group.second_x, group.second_y, group.second_z);
  group.half.push_back(static_cast<float>(edge.half));
  group.edges.push_back(edge);
}

}  // namespace

std::size_t StraightEdges::most_of_a_group() const {
  std::size_t most = 0;
  for (const Group& group : groups) {
    most = std::max(most, group.edges.size());
  }
  return most;
}

StraightEdges find_straight_edges(const Scene& scene, const GlintingFaces& faces, Engine& engine, Workers& workers) {
  std::vector<PlacedEdge> edges = edges_of(scene, faces, workers);
  const auto half = [](const PlacedEdge& edge) { return edge.second.half; };
  StraightEdges found;
  if (edges.size() > StraightEdges::kMost) {
    found.left_out = edges.size() - StraightEdges::kMost;
    std::ranges::stable_sort(edges, std::greater<>(), half);
    edges.resize(StraightEdges::kMost);
    std::ranges::stable_sort(edges, {}, [](const auto& edge) { return edge.first; });
  }
  Surroundings(scene, engine).remove_touched(edges);
  for (const auto& [index, edge] : edges) {
    const Instance& instance = scene.instances[index];
    const int owner = instance.moving ? index : -1;
    auto group = std::ranges::find(found.groups, owner, &StraightEdges::Group::instance);
    if (group == found.groups.end()) {
      group = found.groups.insert(group, StraightEdges::Group());
      group->instance = owner;
      group->origin = instance.world_from_mesh * edge.middle;
    }
    append_edge(*group, owner < 0 ? moved(edge, Pose{.position = -group->origin} * instance.world_from_mesh) : edge);
  }
  return found;
}

}  // namespace insonify

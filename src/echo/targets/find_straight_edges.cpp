// find_straight_edges.cpp -- gathers the edges of all instances, and rejects those that something else touches.

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "echo/targets/mesh_edges.h"
#include "echo/targets/straight_edges.h"
#include "scene/alike.h"

namespace insonify {
namespace {

using PlacedEdge = std::pair<int, StraightEdges::Edge>;  // Instance and edge.

// Adds the edges of one instance.
void add_edges(const Scene& scene, int index, const GlintingFaces& faces, std::vector<PlacedEdge>& edges) {
  for (const FaceEdge& one : find_mesh_edges(scene, index, faces)) {
    const bool thin = std::ranges::any_of(
        one.edge.sides, [](const StraightEdges::Side& side) { return side.face == StraightEdges::kNoGlint; });
    if (!thin ||
        (one.face[1] != MeshFaces::kNone && one.edge.exterior >= 1 + StraightEdges::kSquareTurn / std::numbers::pi)) {
      edges.emplace_back(index, one.edge);
    }
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
std::vector<PlacedEdge> edges_of(const Scene& scene, const GlintingFaces& faces) {
  std::vector<PlacedEdge> edges;
  const std::vector<std::size_t> first = first_alike(scene);
  std::vector<std::pair<std::size_t, std::size_t>> own(first.size());  // [instance] The range of its edges.
  for (std::size_t i = 0; i < faces.of_mesh.size(); ++i) {
    if (!faces.of_mesh[i] || faces.of_mesh[i]->faces.empty()) {
      continue;
    }
    own[i].first = edges.size();
    if (first[i] == i || !glint_alike(faces, i, first[i])) {
      add_edges(scene, static_cast<int>(i), faces, edges);
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
  static constexpr double kBeside = 0.1;                     // Angle to the faces of edges that are joined [rad].

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
    const double margin = std::max(kMargin, std::asin(0.5 * edge.apart / StraightEdges::kFree) + kBeside);
    const double whole = edge.exterior * std::numbers::pi - 2 * margin;
    const int count = static_cast<int>(std::ceil(whole / kStep));
    const auto corner = [&](int i) -> Vec3 {
      const double angle = margin + whole * i / count;
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

StraightEdges find_straight_edges(const Scene& scene, const GlintingFaces& faces, Engine& engine) {
  std::vector<PlacedEdge> edges = edges_of(scene, faces);
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

// find_small_faces.cpp -- finds plane faces that samples may miss, and cuts them into strips.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "echo/mirror/faces.h"
#include "echo/targets/small_faces.h"
#include "scene/alike.h"

namespace insonify {
namespace {

constexpr int kStrips = 4;        // Across a face: each is at most as wide as one column where the face is a piece.
constexpr float kFilled = 0.45F;  // Least share of its bounding rectangle that a face fills: a triangle fills half.
constexpr double kClear = 1e-4;   // Rays from a face start this far from it [m].
constexpr double kBehind = 0.3;   // What is this near behind a face is its own body: its other side does not echo
                                  // [widths]. Twice as far as hits on the body do not hide a patch.
constexpr std::size_t kMostSmall =
    16;  // Small faces of an instance: those of more hide each other, which samples see better.
constexpr int kMostFaces = 4096;  // Of an instance, if they are to be looked at.
constexpr float kNotSmall = std::numeric_limits<float>::infinity();

// What is known of a face while its triangles are visited.
struct Candidate {
  std::uint32_t triangle = MeshFaces::kNone;  // The first of its triangles.
  bool excluded = false;
  bool on_front = false, on_back = false;  // Whether that side echoes: that to which the first triangle is wound.
  Vec3f normal = Vec3f::Zero();            // Of the front.
  Eigen::AlignedBox2f box;                 // Bounding rectangle along the face's axes [m].

  [[nodiscard]] bool fills(const Face& face) const {
    return 4 * face.half[0] * face.half[1] >= kFilled * box.sizes().prod();
  }
};

// What has been found of an instance, for those that are alike.
struct Found {
  LeftOut::ByTriangle<float> thin;       // Thickness of its triangles before.
  LeftOut::ByTriangle<float> thickness;  // The same, with the widths of small faces.
  std::size_t first = 0, last = 0;       // Its strips.
};

// [face] Those of an instance that are small and neither thin nor in relief.
std::vector<Candidate> candidates_of(const Instance& instance, const MeshFaces& faces,
                                     const LeftOut::ByTriangle<float>& thin) {
  const Mesh& mesh = *instance.mesh;
  std::vector<Candidate> candidates(faces.faces.size());
  for (std::uint32_t t = 0; t < faces.face_of.size(); ++t) {
    const std::uint32_t index = faces.face_of[t];
    if (index == MeshFaces::kNone) {
      continue;
    }
    const Face& face = faces.faces[index];
    Candidate& own = candidates[index];
    const std::size_t slot = mesh.slot_of(t);
    own.excluded = own.excluded || !(face.width() > 0 && face.width() <= ThinParts::kThickestRound) ||
                   (thin != nullptr && std::isfinite((*thin)[t])) ||
                   (slot < instance.reliefs.size() && instance.reliefs[slot] != nullptr);
    const auto& [a, b, c] = mesh.triangles[t];
    if (own.triangle == MeshFaces::kNone) {
      own.triangle = t;
      own.normal = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).normalized();
    }
    for (const std::uint32_t corner : {a, b, c}) {
      const Vec3f from = mesh.vertices[corner] - mesh.vertices[face.corner];
      own.box.extend(Eigen::Vector2f(from.dot(face.axes[0]), from.dot(face.axes[1])));
    }
  }
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    candidates[i].excluded = candidates[i].excluded || !candidates[i].fills(faces.faces[i]);
  }
  return candidates;
}

Vec3f middle_of(const Mesh& mesh, const Face& face) {
  return mesh.vertices[face.corner] + face.middle[0] * face.axes[0] + face.middle[1] * face.axes[1];
}

// Both sides of a sheet echo, of a body only the outer one: from the other the body itself is met.
// @param small  Indices of the faces; those without any side are removed.
void find_sides(const Instance& instance, int index, const MeshFaces& faces, Engine& engine,
                std::vector<Candidate>& candidates, std::vector<std::uint32_t>& small) {
  std::vector<Ray> rays;
  for (const std::uint32_t face : small) {
    const Vec3 middle = instance.world_from_mesh * middle_of(*instance.mesh, faces.faces[face]).cast<double>().eval();
    const Vec3 normal = instance.world_from_mesh.orientation * candidates[face].normal.cast<double>();
    const double reach = kBehind * double{faces.faces[face].width()};
    rays.push_back({middle, normal, kClear, reach});
    rays.push_back({middle, -normal, kClear, reach});
  }
  std::vector<Hit> hits(rays.size());
  engine.trace(rays, hits);
  const auto is_free = [&](const Hit& hit) { return !std::isfinite(hit.distance) || hit.instance != index; };
  for (std::size_t i = 0; i < small.size(); ++i) {
    Candidate& own = candidates[small[i]];
    own.on_front = is_free(hits[2 * i]);
    own.on_back = is_free(hits[2 * i + 1]);
    own.excluded = !own.on_front && !own.on_back;
  }
  std::erase_if(small, [&](std::uint32_t face) { return candidates[face].excluded; });
}

// Pieces along a face, each so short that its steps are all far from the sonar where the face is four samples wide.
int slabs_of(const Face& face) {
  constexpr float kMostWidths = 24;  // [widths]
  return static_cast<int>(std::ceil(2 * std::max(face.half[0], face.half[1]) / (kMostWidths * face.width())));
}

void add_strips(const Mesh& mesh, const Face& face, const Candidate& candidate, SurfaceLabel surface, bool glints,
                ThinParts& parts) {
  const int across = face.half[0] < face.half[1] ? 0 : 1, slabs = slabs_of(face);
  const Vec3f side = face.half[across] / static_cast<float>(kStrips) * face.axes[across];
  const Vec3f half = face.half[1 - across] / static_cast<float>(slabs) * face.axes[1 - across];
  const Vec3f zero = Vec3f::Zero();
  const float area = 4 * side.norm() * half.norm();
  for (int i = 0; i < kStrips * slabs; ++i) {
    const int row = i % kStrips, column = i / kStrips;
    const auto strip = static_cast<float>(2 * row + 1 - kStrips);
    const auto slab = static_cast<float>(2 * column + 1 - slabs);
    const auto first_patch = static_cast<std::uint32_t>(parts.patches.size());
    for (const float to : {1.0F, -1.0F}) {
      if (to > 0 ? candidate.on_front : candidate.on_back) {
        parts.patches.push_back({to * candidate.normal, zero, zero, zero, area});
      }
    }
    parts.pieces.push_back({surface, middle_of(mesh, face) + strip * side + slab * half, half, face.width(),
                            first_patch, static_cast<std::uint32_t>(parts.patches.size()), side, glints});
  }
}

// Adds the strips of an instance's small faces, unless they are too many. Returns the thickness of its triangles.
// @param most  Pieces that there may be in all.
LeftOut::ByTriangle<float> add_faces_of(const Scene& scene, std::size_t index, const LeftOut& left_out,
                                        std::size_t most, Engine& engine, Workers& workers, ThinParts& parts) {
  const Instance& instance = scene.instances[index];
  const LeftOut::ByTriangle<float>& thin = left_out.thickness[index];
  const std::shared_ptr<const MeshFaces> faces = shared_faces(instance.mesh, workers);
  if (std::ranges::count_if(faces->faces, [](const Face& face) { return face.width() <= ThinParts::kThickestRound; }) >
      kMostFaces) {
    return thin;
  }
  std::vector<Candidate> candidates = candidates_of(instance, *faces, thin);
  std::vector<std::uint32_t> small;
  std::size_t pieces = 0;
  for (std::uint32_t i = 0; i < candidates.size(); ++i) {
    if (!candidates[i].excluded) {
      small.push_back(i);
      pieces += kStrips * static_cast<std::size_t>(slabs_of(faces->faces[i]));
    }
  }
  if (small.empty() || small.size() > kMostSmall || parts.pieces.size() + pieces > most) {
    return thin;
  }
  find_sides(instance, static_cast<int>(index), *faces, engine, candidates, small);
  const LeftOut::ByTriangle<std::uint8_t>& glinting = left_out.glinting[index];
  for (const std::uint32_t face : small) {
    const std::uint32_t triangle = candidates[face].triangle;
    const std::uint16_t material = instance.materials[instance.mesh->slot_of(triangle)];
    add_strips(*instance.mesh, faces->faces[face], candidates[face],
               surface_label(static_cast<std::uint16_t>(index), material),
               glinting != nullptr && (*glinting)[triangle] != 0, parts);
  }
  std::vector<float> thickness =
      thin != nullptr ? *thin : std::vector<float>(instance.mesh->triangles.size(), kNotSmall);
  for (std::size_t t = 0; t < faces->face_of.size(); ++t) {
    const std::uint32_t face = faces->face_of[t];
    if (face != MeshFaces::kNone && !candidates[face].excluded) {
      thickness[t] = faces->faces[face].width();
    }
  }
  return std::make_shared<const std::vector<float>>(std::move(thickness));
}

}  // namespace

void add_small_faces(const Scene& scene, Engine& engine, Workers& workers, LeftOut& left_out, ThinParts& parts) {
  const std::size_t most = std::min(parts.pieces.size() + ThinParts::kMostStrips, ThinParts::kMostPieces);
  const std::vector<std::size_t> first = first_alike(scene);
  std::vector<Found> found(scene.instances.size());
  left_out.thickness.resize(scene.instances.size());
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    if (!scene.instances[i].present || scene.instances[i].endless) {
      continue;
    }
    const Found& alike = found[first[i]];
    Found own{left_out.thickness[i], left_out.thickness[i], parts.pieces.size()};
    if (first[i] == i || own.thin != alike.thin) {
      own.thickness = add_faces_of(scene, i, left_out, most, engine, workers, parts);
    } else if (parts.pieces.size() + (alike.last - alike.first) <= most) {
      own.thickness = alike.thickness;
      for (std::size_t k = alike.first; k < alike.last; ++k) {
        ThinParts::Piece piece = parts.pieces[k];
        piece.surface = surface_label(static_cast<std::uint16_t>(i), material_of(piece.surface));
        parts.pieces.push_back(piece);
      }
    }
    own.last = parts.pieces.size();
    left_out.thickness[i] = own.thickness;
    found[i] = std::move(own);
  }
}

}  // namespace insonify

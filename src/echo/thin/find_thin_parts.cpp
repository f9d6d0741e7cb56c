// find_thin_parts.cpp -- cuts the thin parts of all instances of a scene into pieces.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "echo/thin/thin_parts.h"
#include "scene/alike.h"

namespace insonify {
namespace {

constexpr float kShortest = 3,
                kLongest = 24;  // Length of pieces [thicknesses]: doubled until they are at most kMostPieces.

// Leaves thick round parts that are not compact to the lattice if they are an assembly of many. Returns their pieces if
// all that is thin is such a part, and stays.
ThinParts leave_assemblies(const Instance& instance, int index, std::vector<ThinTriangle>& thin) {
  const auto is_thick = [](const ThinTriangle& triangle) {
    return triangle.body < 0 && triangle.thickness > ThinParts::kThickest;
  };
  std::vector<ThinTriangle> thick;
  std::ranges::copy_if(thin, std::back_inserter(thick), is_thick);
  ThinParts parts;
  if (!cut_thin_triangles(instance, index, thick, kShortest, parts) ||
      parts.pieces.size() > ThinParts::kMostThickPieces) {
    std::erase_if(thin, is_thick);
    return {};
  }
  return thick.size() == thin.size() ? std::move(parts) : ThinParts{};
}

// Adds the pieces of `own`, if there is room for them.
bool append(const ThinParts& own, ThinParts& parts) {
  if (own.pieces.empty() || parts.pieces.size() + own.pieces.size() > ThinParts::kMostPieces) {
    return false;
  }
  const auto patches = static_cast<std::uint32_t>(parts.patches.size());
  for (ThinParts::Piece piece : own.pieces) {
    piece.first_patch += patches;
    piece.last_patch += patches;
    parts.pieces.push_back(piece);
  }
  parts.patches.insert(parts.patches.end(), own.patches.begin(), own.patches.end());
  return true;
}

// Adds the pieces of an instance, or its name where these are too many. Returns the thickness of its triangles.
LeftOut::ByTriangle<float> add_pieces(const Scene& scene, int index, Engine& engine, Workers& workers,
                                      ThinParts& parts) {
  const Instance& instance = scene.instances[index];
  std::vector<ThinTriangle> thin = find_thin_triangles(scene, index, engine, workers);
  // Thickness is rounded up to quarter octaves, so that a piece and its triangles pass to the lattice at the same
  // range; one step of 2 mm, 4 mm and so on is met exactly by ropes, which kTolerance keeps at it.
  constexpr float kFirst = 1e-3F * (1 + static_cast<float>(ThinParts::kTolerance));
  for (ThinTriangle& triangle : thin) {
    triangle.thickness = 1e-3F * std::exp2(0.25F * std::ceil(4 * std::log2(triangle.thickness / kFirst)));
  }
  const ThinParts round = leave_assemblies(instance, index, thin);
  if (thin.empty()) {
    return nullptr;
  }
  float slab = kShortest;
  while (slab <= kLongest && !append(round, parts) && !cut_thin_triangles(instance, index, thin, slab, parts)) {
    slab *= 2;
  }
  if (slab > kLongest) {
    parts.left_out.push_back(instance.name);
    return nullptr;
  }
  std::vector<float> thickness(instance.mesh->triangles.size(), std::numeric_limits<float>::infinity());
  for (const ThinTriangle& triangle : thin) {
    thickness[triangle.triangle] = triangle.thickness;
  }
  return std::make_shared<const std::vector<float>>(std::move(thickness));
}

}  // namespace

ThinParts find_thin_parts(const Scene& scene, Engine& engine, Workers& workers) {
  ThinParts parts;
  LeftOut triangles;
  triangles.thickness.resize(scene.instances.size());
  const std::vector<std::size_t> first = first_alike(scene);
  std::vector<std::pair<std::size_t, std::size_t>> pieces(first.size());  // [instance] The range of its pieces.
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    if (!instance.present || instance.endless) {
      continue;
    }
    const auto [begin, end] = pieces[first[i]];
    pieces[i].first = parts.pieces.size();
    if (first[i] == i || parts.pieces.size() + (end - begin) > ThinParts::kMostPieces) {
      triangles.thickness[i] = add_pieces(scene, static_cast<int>(i), engine, workers, parts);
    } else {
      triangles.thickness[i] = triangles.thickness[first[i]];
      if (std::ranges::find(parts.left_out, scene.instances[first[i]].name) != parts.left_out.end()) {
        parts.left_out.push_back(instance.name);
      }
      for (std::size_t k = begin; k < end; ++k) {
        ThinParts::Piece piece = parts.pieces[k];
        piece.surface = surface_label(static_cast<std::uint16_t>(i), material_of(piece.surface));
        parts.pieces.push_back(piece);
      }
    }
    pieces[i].second = parts.pieces.size();
  }
  if (!parts.pieces.empty()) {
    parts.triangles = std::make_shared<const LeftOut>(std::move(triangles));
  }
  return parts;
}

}  // namespace insonify

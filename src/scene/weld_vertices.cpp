// weld_vertices.cpp -- merges equal vertices by a hash table with open addressing: linear in time, and with at most
// eight bytes per vertex.

#include <bit>
#include <limits>

#include "scene/mesh_steps.h"

namespace insonify {
namespace {

constexpr std::uint32_t kNoEntry = std::numeric_limits<std::uint32_t>::max();

std::uint64_t mixed(std::uint64_t hash, float value) {
  hash ^= std::bit_cast<std::uint32_t>(value + 0.0F);  // -0 + 0 = 0: both zeros hash alike.
  hash *= 0x9E3779B97F4A7C15U;
  return hash ^ (hash >> 29);
}

std::uint64_t hash_of(const Vec3f& position, const Vec3f& normal) {
  std::uint64_t hash = 0;
  for (const Vec3f* point : {&position, &normal}) {
    for (const float value : *point) {
      hash = mixed(hash, value);
    }
  }
  return hash;
}

std::vector<bool> used_vertices(const Mesh& mesh) {
  std::vector<bool> used(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      used[corner] = true;
    }
  }
  return used;
}

// Compacts the vertices to the distinct used ones and returns the new index of each.
std::vector<std::uint32_t> join(Mesh& mesh, const std::vector<bool>& used) {
  // At most half full, so that runs of occupied places stay short.
  std::vector<std::uint32_t> table(std::bit_ceil(2 * mesh.vertices.size() + 1), kNoEntry);
  const std::size_t mask = table.size() - 1;
  std::vector<std::uint32_t> moved(mesh.vertices.size(), kNoEntry);

  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!used[i]) {
      continue;
    }
    const Vec3f position = mesh.vertices[i];
    const Vec3f normal = mesh.normals[i];
    std::size_t place = hash_of(position, normal) & mask;
    while (table[place] != kNoEntry &&
           (mesh.vertices[table[place]] != position || mesh.normals[table[place]] != normal)) {
      place = (place + 1) & mask;
    }
    if (table[place] == kNoEntry) {
      table[place] = kept;
      mesh.vertices[kept] = position;
      mesh.normals[kept] = normal;
      ++kept;
    }
    moved[i] = table[place];
  }
  mesh.vertices.resize(kept);
  mesh.normals.resize(kept);
  return moved;
}

}  // namespace

void weld_vertices(Mesh& mesh) {
  const std::vector<std::uint32_t> moved = join(mesh, used_vertices(mesh));
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) {
      corner = moved[corner];
    }
  }
}

}  // namespace insonify

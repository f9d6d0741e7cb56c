// weld_vertices.cpp -- moves vertices that are nearly at one place to it, and merges equal ones by a hash table with
// open addressing: linear in time.

#include <algorithm>
#include <bit>
#include <limits>

#include "scene/mesh_steps.h"
#include "scene/same_places.h"

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

void join_equal(Mesh& mesh) {
  const std::vector<std::uint32_t> moved = join(mesh, used_vertices(mesh));
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) {
      corner = moved[corner];
    }
  }
}

// [vertex] An eighth of the shortest triangle side at it [m]: what is moved by less keeps its shape.
std::vector<float> eighths_of_sides(const Mesh& mesh) {
  std::vector<float> eighths(mesh.vertices.size(), std::numeric_limits<float>::infinity());
  for (const auto& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
      const float eighth = 0.125F * (mesh.vertices[a] - mesh.vertices[b]).norm();
      eighths[a] = std::min(eighths[a], eighth);
      eighths[b] = std::min(eighths[b], eighth);
    }
  }
  return eighths;
}

// Moves vertices to others within same_place_tolerance(). False if there are none.
bool move_together(Mesh& mesh) {
  Workers alone(1);
  const std::vector<std::uint32_t> numbers =
      same_places(mesh.vertices, same_place_tolerance(mesh.vertices), eighths_of_sides(mesh), alone);
  bool any = false;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Vec3f place = mesh.vertices[numbers[i]];
    any = any || mesh.vertices[i] != place;
    mesh.vertices[i] = place;
  }
  return any;
}

}  // namespace

void weld_vertices(Mesh& mesh) {
  join_equal(mesh);
  if (move_together(mesh)) {
    join_equal(mesh);
  }
}

}  // namespace insonify

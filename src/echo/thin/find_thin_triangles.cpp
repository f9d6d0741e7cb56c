// find_thin_triangles.cpp -- which triangles of an instance belong to thin parts.

#include <map>

#include "echo/thin/thickness_gauge.h"
#include "echo/thin/thin_parts.h"
#include "scene/same_places.h"

namespace insonify {
namespace {

// Of triangles that cover each other, of whatever winding, all are thin where one is, and one has the surface.
// @param first_of  repeated_triangles()
void share_thickness(const std::vector<std::uint32_t>& first_of, std::vector<ThinTriangle>& thin) {
  if (first_of.empty()) {
    return;
  }
  std::map<std::uint32_t, ThinTriangle> found;  // By the first of the triangles that cover each other.
  std::vector<std::uint8_t> known(first_of.size(), 0);
  for (ThinTriangle& triangle : thin) {
    const bool is_new = found.try_emplace(first_of[triangle.triangle], triangle).second;
    triangle.copy = triangle.body >= 0 ? triangle.copy : !is_new;
    known[triangle.triangle] = 1;
  }
  for (std::uint32_t t = 0; t < first_of.size(); ++t) {
    if (const auto other = found.find(first_of[t]); known[t] == 0 && other != found.end()) {
      thin.push_back(other->second);
      thin.back().triangle = t;
      thin.back().copy = true;
    }
  }
}

}  // namespace

std::vector<ThinTriangle> find_thin_triangles(const Scene& scene, int index, Engine& engine, Workers& workers) {
  const Instance& instance = scene.instances[index];
  const std::size_t count = instance.mesh->triangles.size();
  const std::vector<std::uint32_t> first_of = repeated_triangles(*instance.mesh, workers);
  std::vector<ThinTriangle> thin = find_compact_bodies(instance, first_of);
  std::vector<std::uint8_t> compact(thin.empty() ? 0 : count, 0);
  for (const ThinTriangle& triangle : thin) {
    compact[triangle.triangle] = 1;
  }
  std::erase_if(thin, [](const ThinTriangle& triangle) { return triangle.thickness >= ThinParts::kThickestRound; });
  ThicknessGauge gauge(scene, index, engine, workers);
  std::vector<std::uint32_t> some;
  for (std::uint32_t t = 0; t < count; ++t) {
    if (compact.empty() || compact[t] == 0) {
      some.push_back(t);
    }
    if (some.size() == ThicknessGauge::kTogether || t + 1 == count) {
      gauge.measure(some, t + 1 == count, thin);
      some.clear();
    }
  }
  share_thickness(first_of, thin);
  return thin;
}

}  // namespace insonify

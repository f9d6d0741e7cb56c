// sea_plane.cpp -- sizes the sea plane and moves it on its lattice.

#include "simulator/sea_plane.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "insonify/error.h"
#include "insonify/mesh.h"

namespace insonify {
namespace {

// Largest true range within max_range [m]: the assumed sound speed may be too low by a factor of up to 1700 / 1300.
double reach_of(const Scenario& scenario) {
  constexpr double kTrueRanges = 1.5;
  double reach = 0;
  for (const SonarConfig& sonar : scenario.sonars) {
    reach = std::max(reach, kTrueRanges * sonar.max_range);
  }
  return reach;
}

}  // namespace

SeaPlane::SeaPlane(const Scenario& scenario, Scene& scene)
    : instance_(static_cast<int>(scene.instances.size())),
      material_(static_cast<std::uint16_t>(scene.materials.size())),
      home_(0, 0, scenario.surface->level) {
  Instance instance;
  instance.name = "sea_surface";
  instance.world_from_mesh.position = home_;
  instance.moving = true;
  instance.endless = true;
  scene.instances.push_back(std::move(instance));
  scene.materials.emplace_back();
  fit(scenario, scene);
}

// Half of the half width allows for the sonar's offset from the lattice point, half for its range. A power of two, so
// that the size rarely changes with a sonar's range.
bool SeaPlane::fit(const Scenario& scenario, Scene& scene) {
  scene.materials[material_] = sea_surface_material(*scenario.surface, scenario.sonars.front().frequency);
  const double half_width = std::exp2(std::ceil(std::log2(2 * reach_of(scenario))));
  if (half_width == half_width_) {
    return false;
  }
  half_width_ = half_width;
  Instance& instance = scene.instances[instance_];
  instance.mesh = std::make_shared<const Mesh>(make_plane(-Vec3::UnitZ(), 2 * half_width_, 2 * half_width_));
  instance.materials.assign(instance.mesh->material_names.size(), material_);
  return true;
}

void SeaPlane::check(const Vec3& sonar) const {
  if (sonar.z() >= home_.z()) {
    throw Error(fmt::format("the sonar is at a height of {:.7g} m, must be below surface.level = {:.7g} m", sonar.z(),
                            home_.z()));
  }
}

void SeaPlane::place(const Vec3& sonar, Placement& placement) const {
  const double spacing = half_width_;
  const Vec3 middle(spacing * std::round(sonar.x() / spacing), spacing * std::round(sonar.y() / spacing), home_.z());
  if (middle != home_) {
    const auto after = std::ranges::upper_bound(placement.moved, instance_, {}, &Placement::Moved::instance);
    placement.moved.insert(after, {instance_, {.position = middle}});
  }
}

std::vector<Material> materials_at(double frequency, const Scenario& scenario, const Scene& scene) {
  std::vector<Material> materials = scene.materials;
  for (const Instance& instance : scene.instances) {
    if (scenario.surface && instance.endless) {
      materials[instance.materials.front()] = sea_surface_material(*scenario.surface, frequency);
    }
  }
  return materials;
}

}  // namespace insonify

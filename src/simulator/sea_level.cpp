// sea_level.cpp -- one large plane.

#include "simulator/sea_level.h"

#include <algorithm>

#include "insonify/mesh.h"

namespace insonify {

void add_sea_surface(const Scenario& scenario, Scene& scene) {
  // Around every place the vehicle is at, as far as sound comes back from.
  double reach = 0;
  for (const SonarConfig& sonar : scenario.sonars) {
    reach = std::max(reach, sonar.max_range + sonar.position.norm());
  }
  Vec3 low = scenario.trajectory.at(0).position, high = low;
  for (const Waypoint& waypoint : scenario.trajectory.waypoints) {
    low = low.cwiseMin(waypoint.position);
    high = high.cwiseMax(waypoint.position);
  }
  const Vec3 size = high - low + Vec3::Constant(4 * reach), middle = 0.5 * (low + high);

  Instance instance;
  instance.name = "sea_surface";
  instance.mesh = std::make_shared<const Mesh>(make_plane(-Vec3::UnitZ(), size.x(), size.y()));
  instance.world_from_mesh.position = {middle.x(), middle.y(), scenario.surface->level};
  instance.materials.assign(instance.mesh->material_names.size(), static_cast<std::uint16_t>(scene.materials.size()));
  scene.materials.push_back(sea_surface_material(*scenario.surface, scenario.sonars.front().frequency));
  scene.instances.push_back(std::move(instance));
}

}  // namespace insonify

// find_thrusters.cpp -- traces the straight path to each thruster.

#include "simulator/find_thrusters.h"

#include "simulator/clear_path.h"

namespace insonify {

void find_thrusters(std::span<const Thruster> thrusters, const Pose& vehicle_from_head, const Pose& world_from_vehicle,
                    Engine& engine, std::span<std::optional<Vec3>> places) {
  const Pose head_from_vehicle = vehicle_from_head.inverse();
  const Vec3 head = world_from_vehicle * vehicle_from_head.position;
  for (std::size_t i = 0; i < thrusters.size(); ++i) {
    places[i].reset();
    if (is_clear(head, world_from_vehicle * thrusters[i].position, engine)) {
      places[i] = head_from_vehicle * thrusters[i].position;
    }
  }
}

}  // namespace insonify

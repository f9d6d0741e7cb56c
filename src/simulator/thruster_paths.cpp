// thruster_paths.cpp -- asks for the straight path to each thruster.

#include "simulator/thruster_paths.h"

#include <cmath>

#include "echo/model/hit.h"

namespace insonify {

void ThrusterPaths::ask(const PingView& view, Workers&, RayList& rays) {
  const Vec3 sonar = view.world_from_vehicle * view.vehicle_from_sonar.position;
  for (const Thruster& thruster : thrusters_) {
    const Vec3 there = view.world_from_vehicle * thruster.position - sonar;
    const double range = there.norm();
    rays.rays.push_back({sonar, there / range, 0, range - double{kRayClearance}});
  }
}

void ThrusterPaths::answer(const PingView& view, const RayAnswers& hits, Workers&, RayList&, EchoList& found) {
  if (hits.rays.empty()) {
    return;
  }
  const Pose sonar_from_vehicle = view.vehicle_from_sonar.inverse();
  for (std::size_t i = 0; i < thrusters_.size(); ++i) {
    found.thrusters.emplace_back();
    if (!std::isfinite(hits.rays[i].distance)) {
      found.thrusters.back() = sonar_from_vehicle * thrusters_[i].position;
    }
  }
}

}  // namespace insonify

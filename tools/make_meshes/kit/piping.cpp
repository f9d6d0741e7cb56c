// piping.cpp -- arcs between straights, and rings of bolts.

#include "kit/piping.h"

#include <algorithm>
#include <cmath>

#include "kit/curve.h"

namespace modelling {

std::vector<Vec3> bent_path(const std::vector<Vec3>& corners, double radius) {
  std::vector<Vec3> path = {corners.front()};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Vec3 before = corners[i - 1] - corners[i];
    const Vec3 after = corners[i + 1] - corners[i];
    const double reach = std::min({radius, 0.49 * before.norm(), 0.49 * after.norm()});
    const Vec3 start = corners[i] + reach * before.normalized();
    const Vec3 end = corners[i] + reach * after.normalized();
    for (const double t : spaced(0, 1, 8)) {  // A parabola: near enough to an arc.
      path.push_back((1 - t) * (1 - t) * start + 2 * t * (1 - t) * corners[i] + t * t * end);
    }
  }
  path.push_back(corners.back());
  return path;
}

Shape bent_pipe(const std::string& material, const std::vector<Vec3>& corners, double pipe_radius, double bend_radius,
                int sides) {
  return tube(material, bent_path(corners, bend_radius), pipe_radius, sides);
}

Shape make_flange_pair(const std::string& material, double pipe_radius) {
  const double outer = 1.9 * pipe_radius, thick = 0.55 * pipe_radius, gap = 0.08 * pipe_radius;
  const double hub = 1.25 * pipe_radius;
  Shape pair = revolve(material,
                       {{0, -2.2 * thick},
                        {1.05 * pipe_radius, -2.2 * thick},
                        {hub, -thick},
                        {outer, -thick},
                        {outer, -gap},
                        {1.4 * pipe_radius, -gap},
                        {1.4 * pipe_radius, gap},
                        {outer, gap},
                        {outer, thick},
                        {hub, thick},
                        {1.05 * pipe_radius, 2.2 * thick},
                        {0, 2.2 * thick}},
                       24);
  for (const Vec2& p : ring(Vec2::Zero(), 1.62 * pipe_radius, 1.62 * pipe_radius, 8)) {
    pair.add(tube(material, {{p.x(), p.y(), -1.5 * thick}, {p.x(), p.y(), 1.5 * thick}}, 0.14 * pipe_radius, 6));
  }
  return pair;
}

Pose along_axis(const Vec3& position, const Vec3& direction) {
  const Vec3 z = direction.normalized();
  const Vec3 x = (std::abs(z.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY()).cross(z).cross(z).normalized() * -1.0;
  Eigen::Matrix3d turn;
  turn << x, z.cross(x), z;
  Pose pose;
  pose.position = position;
  pose.orientation = Eigen::Quaterniond(turn);
  return pose;
}

Shape i_beam(const std::string& material, const Vec3& from, const Vec3& to, double height, double width) {
  const double h = height / 2, w = width / 2, flange = 0.07 * height, web = 0.05 * height;
  const std::vector<Vec2> section = {
      {-w, -h}, {w, -h}, {w, -h + flange}, {web, -h + flange}, {web, h - flange},   {w, h - flange},
      {w, h},   {-w, h}, {-w, h - flange}, {-web, h - flange}, {-web, -h + flange}, {-w, -h + flange}};
  const Vec3 axis = (to - from).normalized();
  const Vec3 up = std::abs(axis.z()) < 0.9 ? Vec3::UnitZ() : Vec3::UnitX();
  const Vec3 y = (up - up.dot(axis) * axis).normalized();
  Eigen::Matrix3d turn;
  turn << y.cross(axis), y, axis;
  Pose pose;
  pose.position = from;
  pose.orientation = Eigen::Quaterniond(turn);
  return placed(plate(material, section, {}, (to - from).norm()), pose);
}

Shape make_anode(double length) {
  const double half = length / 2;
  Shape anode = sweep("aluminium", {{-half, 0, 0.12}, {half, 0, 0.12}},
                      {{-0.065, -0.045}, {0.065, -0.045}, {0.045, 0.05}, {-0.045, 0.05}}, Vec3::UnitZ());
  for (const double end : {-1.0, 1.0}) {
    anode.add(
        tube("steel",
             bent_path({{end * (half - 0.05), 0, 0.12}, {end * (half + 0.1), 0, 0.12}, {end * (half + 0.1), 0, -0.02}},
                       0.05),
             0.012, 6));
  }
  return anode;
}

}  // namespace modelling

// pipe.cpp -- tubes of changing radius, and what is bolted or clamped to them.

#include "kit/pipe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kit/kit.h"

namespace modelling {
namespace {

constexpr double kStep = 0.02;         // Over which a collar rises [m].
constexpr double kThickness = 0.07;    // Of one flange [m].
constexpr double kGap = 0.006;         // Half of what the seal ring leaves open [m].
constexpr double kNeck = 0.11;         // Of the taper from flange to pipe [m].
constexpr double kWeldCap = 0.008;     // The neck stands out from the pipe by this [m].
constexpr double kBoltRadius = 0.019;  // Nuts of 1 1/2 inch studs stand out more, and are as wide as long [m].

// Radius of the pipe at a station.
double radius_at(double station, double radius, const std::vector<Collar>& collars) {
  for (const Collar& collar : collars) {
    if (station > collar.from - kStep / 2 && station < collar.to + kStep / 2) {
      return collar.radius;
    }
  }
  return radius;
}

// Studs with a nut at each end, through flanges between `low` and `high`.
Shape make_studs(double circle_radius, int count, double low, double high) {
  Shape studs;
  constexpr double kNut = 0.035;
  for (const Vec2& p : ring(Vec2::Zero(), circle_radius, circle_radius, count)) {
    const auto hexagon = [&](double radius, double from, double to) {
      studs.add(tube("steel", {{p.x(), p.y(), from}, {p.x(), p.y(), to}}, radius, 6));
    };
    hexagon(kBoltRadius, low - kNut - 0.02, high + kNut + 0.02);
    hexagon(1.6 * kBoltRadius, low - kNut, low + 0.01);
    hexagon(1.6 * kBoltRadius, high - 0.01, high + kNut);
  }
  return studs;
}

int bolt_count(double pipe_radius) {
  return pipe_radius < 0.13 ? 12 : 16;
}

}  // namespace

Shape pipe(const std::string& material, const Path& path, double radius, const std::vector<Collar>& collars,
           int sides) {
  std::vector<double> edges;
  for (const Collar& collar : collars) {
    edges.insert(edges.end(), {collar.from - kStep, collar.from, collar.to, collar.to + kStep});
  }
  const Path stepped_path = with_stations(path, edges);
  const std::vector<double> at = stations(stepped_path);
  Shape shape = tube(material, stepped_path, 1, sides);
  for (std::size_t i = 0; i < stepped_path.size(); ++i) {
    for (int k = 0; k < sides; ++k) {
      Vec3& vertex = shape.vertices[i * static_cast<std::size_t>(sides) + static_cast<std::size_t>(k)];
      vertex = stepped_path[i] + radius_at(at[i], radius, collars) * (vertex - stepped_path[i]);
    }
  }
  return shape;
}

std::vector<Collar> field_joints(const Path& path, double first, double length, double radius) {
  std::vector<Collar> joints;
  const double end = stations(path).back();
  for (double middle = first; middle + length < end; middle += kJointLength) {
    joints.push_back({middle - length / 2, middle + length / 2, radius});
  }
  return joints;
}

Shape make_bracelet(const Path& path, double station, double pipe_radius, double length) {
  const double outer = pipe_radius + 0.045;
  const double half = length / 2;
  Shape bracelet = revolve("aluminium",
                           {{0, -half},
                            {pipe_radius + 0.015, -half},
                            {outer, -half + 0.06},
                            {outer, half - 0.06},
                            {pipe_radius + 0.015, half},
                            {0, half}},
                           20);
  return placed(bracelet, frame_at(path, station));
}

double flange_radius(double pipe_radius) {
  return 1.62 * pipe_radius + 0.05;
}

Shape make_flange_pair(double pipe_radius) {
  const double rim = flange_radius(pipe_radius);
  const double neck = pipe_radius + kWeldCap;
  const double hub = 0.6 * pipe_radius + 0.4 * rim;
  const double back = kGap + kThickness;
  Shape pair = revolve("steel",
                       {{0, -back - kNeck},
                        {neck, -back - kNeck},
                        {hub, -back},
                        {rim, -back},
                        {rim, -kGap},
                        {hub, -kGap},
                        {hub, kGap},
                        {rim, kGap},
                        {rim, back},
                        {hub, back},
                        {neck, back + kNeck},
                        {0, back + kNeck}},
                       24);
  pair.add(make_studs((hub + rim) / 2 + 0.008, bolt_count(pipe_radius), -back, back));
  return pair;
}

Shape make_blind_flange(double pipe_radius) {
  const double rim = flange_radius(pipe_radius);
  const double hub = 0.6 * pipe_radius + 0.4 * rim;
  const double front = 2 * kGap + kThickness;
  Shape flange = revolve("steel",
                         {{0, -kThickness - kNeck},
                          {pipe_radius + kWeldCap, -kThickness - kNeck},
                          {hub, -kThickness},
                          {rim, -kThickness},
                          {rim, 0},
                          {hub, 0},
                          {hub, 2 * kGap},
                          {rim, 2 * kGap},
                          {rim, front},
                          {0.9 * hub, front + 0.012},
                          {0, front + 0.012}},
                         24);
  flange.add(make_studs((hub + rim) / 2 + 0.008, bolt_count(pipe_radius), -kThickness, front));
  return flange;
}

}  // namespace modelling

// pipe.cpp -- tubes of changing radius, and what is bolted or clamped to them.

#include "kit/pipe.h"

#include <algorithm>
#include <cmath>

#include "kit/fittings.h"
#include "kit/kit.h"

namespace {

constexpr double kStep = 0.02;      // Over which a collar rises [m].
constexpr double kGap = 0.006;      // Half of what a flange's seal ring leaves open [m].
constexpr double kWeldCap = 0.008;  // A flange's neck stands out from the pipe by this [m].

// A weld-neck flange by the outer radius of its pipe [m]: about those of ASME B16.5 class 900 from 3 to 12 inches,
// whose rims are 240, 380, 470 and 610 mm over all (3, 6, 8 and 12 inches), whose flanges are 38, 56, 64 and 79 mm
// thick and whose necks are 64, 84, 98 and 121 mm long.
struct Flange {
  double rim, hub, neck;            // Radii.
  double thickness, taper;          // Lengths of the flange and of its neck towards the pipe.
  double bolt_circle, bolt_radius;  // Radii.
  int bolt_count;

  explicit Flange(double pipe_radius)
      : rim(flange_radius(pipe_radius)),
        hub(0.6 * pipe_radius + 0.4 * rim),
        neck(pipe_radius + kWeldCap),
        thickness(0.02 + 0.4 * pipe_radius),
        taper(0.045 + 0.48 * pipe_radius),
        bolt_circle((hub + rim) / 2 + 0.008),
        bolt_radius(std::min(0.019, 0.007 + 0.095 * pipe_radius)),
        bolt_count(pipe_radius < 0.06   ? 8
                   : pipe_radius < 0.13 ? 12
                                        : 16) {}

  // Studs with a nut at each end, through flanges between `low` and `high`.
  [[nodiscard]] Shape studs(double low, double high) const {
    const double nut = 1.8 * bolt_radius;
    const auto bolts = [&](double radius, double from, double to) {
      return make_bolts("steel", bolt_circle, bolt_count, from, to, radius);
    };
    Shape all = bolts(bolt_radius, low - nut - 0.02, high + nut + 0.02);
    all.add(bolts(1.6 * bolt_radius, low - nut, low + 0.01));
    all.add(bolts(1.6 * bolt_radius, high - 0.01, high + nut));
    return all;
  }
};

// Radius of the pipe at a station.
double radius_at(double station, double radius, const std::vector<Collar>& collars) {
  for (const Collar& collar : collars) {
    if (station > collar.from - kStep / 2 && station < collar.to + kStep / 2) {
      return collar.radius;
    }
  }
  return radius;
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
  const Flange flange(pipe_radius);
  const double back = kGap + flange.thickness;
  Shape pair = revolve("steel",
                       {{0, -back - flange.taper},
                        {flange.neck, -back - flange.taper},
                        {flange.hub, -back},
                        {flange.rim, -back},
                        {flange.rim, -kGap},
                        {flange.hub, -kGap},
                        {flange.hub, kGap},
                        {flange.rim, kGap},
                        {flange.rim, back},
                        {flange.hub, back},
                        {flange.neck, back + flange.taper},
                        {0, back + flange.taper}},
                       24);
  pair.add(flange.studs(-back, back));
  return pair;
}

Shape make_blind_flange(double pipe_radius) {
  const Flange flange(pipe_radius);
  const double front = 2 * kGap + flange.thickness;
  Shape blind = revolve("steel",
                        {{0, -flange.thickness - flange.taper},
                         {flange.neck, -flange.thickness - flange.taper},
                         {flange.hub, -flange.thickness},
                         {flange.rim, -flange.thickness},
                         {flange.rim, 0},
                         {flange.hub, 0},
                         {flange.hub, 2 * kGap},
                         {flange.rim, 2 * kGap},
                         {flange.rim, front},
                         {0.9 * flange.hub, front + 0.012},
                         {0, front + 0.012}},
                        24);
  blind.add(flange.studs(-flange.thickness, front));
  return blind;
}

// pipelines.cpp -- coated line pipe as laid, tied in to the cooler with bolted spools.

#include "cooler/pipelines.h"

#include "cooler/cooler.h"
#include "cooler/cooler_site.h"
#include "cooler/mattress.h"

namespace {

// From the end of a laid line, up and over to a flange of the cooler: a rigid spool with bends of five diameters.
Shape make_spool(const Vec3& line_end, const Vec3& line_direction, const Vec3& flange, const Vec3& flange_direction) {
  constexpr double kRadius = kHeaderRadius;
  constexpr double kBend = 0.6;  // [m]
  const double high = flange.z() + 1.25;
  const Vec3 foot = line_end + 1.9 * line_direction;
  const Vec3 shoulder = flange + 1.9 * flange_direction;
  Shape spool = tube("steel",
                     bent({line_end,
                           foot,
                           {foot.x(), foot.y(), high},
                           {shoulder.x(), shoulder.y(), high},
                           {shoulder.x(), shoulder.y(), flange.z()},
                           flange - 0.1 * flange_direction},
                          kBend, 7),
                     kRadius, 18);
  return spool;
}

// Which way a path ends.
Vec3 end_direction(const Path& path) {
  return (path.back() - path[path.size() - 2]).normalized();
}

Path reversed(Path path) {
  std::ranges::reverse(path);
  return path;
}

// A line with its field joints and a bracelet on every fourth joint.
Shape make_line(const std::string& coating, const Path& axis, double radius, double first_joint, const Collar& joint) {
  Shape line = pipe(coating, axis, radius, field_joints(axis, first_joint, joint.to - joint.from, joint.radius), 18);
  for (double station = first_joint + 2.5; station < stations(axis).back() - 2; station += 2 * kJointLength) {
    line.add(make_bracelet(axis, station, radius));
  }
  return line;
}

// Where the top of a pipe is over a place, sloping down from it at the steepness at which a mattress hangs.
double drape_over(const Path& axis, double radius, double x, double y) {
  double height = -100;
  for (const Vec3& p : axis) {
    const double distance = std::hypot(x - p.x(), y - p.y());
    if (distance < 3) {
      height = std::max(height, p.z() + radius - 0.5 * std::max(distance - 0.3, 0.0) - 0.1 * bump(distance, 0.4) + 0.1);
    }
  }
  return height;
}

double station_near(const Path& axis, double x, double y) {
  const std::vector<double> at = stations(axis);
  std::size_t best = 0;
  for (std::size_t i = 0; i < axis.size(); ++i) {
    if (std::hypot(axis[i].x() - x, axis[i].y() - y) < std::hypot(axis[best].x() - x, axis[best].y() - y)) {
      best = i;
    }
  }
  return at[best];
}

// A mattress across a line at a station.
Shape mattress_over(const Route& route, double station, double turned_deg) {
  const Path axis = axis_of(route);
  const Vec3 middle = point_at(axis, station);
  const Vec3 along = point_at(axis, station + 1) - middle;
  const double yaw_deg = std::atan2(along.y(), along.x()) / std::numbers::pi * 180 + turned_deg;
  return make_mattress(at({middle.x(), middle.y(), 0}, 0, 0, yaw_deg), [&](double x, double y) {
    return std::max(cooler_ground(x, y), drape_over(axis, route.radius, x, y));
  });
}

// Something that stands on the bed below a line at a station: `made` is given the height of the line's underside.
template <typename Make>
void add_below(Shape& whole, const Route& route, double station, const Make& made) {
  const Path axis = axis_of(route);
  const Vec3 place = point_at(axis, station);
  const Vec3 along = point_at(axis, station + 0.5) - place;
  const double ground = cooler_ground(place.x(), place.y());
  whole.add(made(place.z() - route.radius - ground),
            at({place.x(), place.y(), ground}, 0, 0, std::atan2(along.y(), along.x()) / std::numbers::pi * 180));
}

}  // namespace

Shape make_pipelines() {
  Shape lines;
  const Pose cooler = world_from_cooler();

  // Flowline: thick insulation, its joints filled to a sleeve that stands out.
  const Path inlet = axis_of(inlet_line());
  lines.add(make_line("pvc", inlet, inlet_line().radius, 5.0, {0, 0.9, inlet_line().radius + 0.035}));
  lines.add(make_flange_pair(kHeaderRadius + 0.01),
            towards(inlet.back() + 0.22 * end_direction(inlet), end_direction(inlet)));
  lines.add(make_spool(inlet.back() - 0.2 * end_direction(inlet), end_direction(inlet), cooler * kCoolerInlet,
                       cooler.orientation * -Vec3::UnitX()));

  // Export line: weight coating that stops short of the welds, where the bare joint is thinner.
  const Path outlet = axis_of(outlet_line());
  const Path back = reversed(outlet);
  lines.add(make_line("concrete", outlet, outlet_line().radius, 4.0, {0, 0.75, outlet_line().radius - 0.06}));
  lines.add(make_flange_pair(kHeaderRadius + 0.01),
            towards(back.back() + 0.22 * end_direction(back), end_direction(back)));
  lines.add(make_spool(back.back() - 0.2 * end_direction(back), end_direction(back), cooler * kCoolerOutlet,
                       cooler.orientation * Vec3::UnitX()));

  lines.add(make_line("steel", axis_of(gas_line()), gas_line().radius, 7.0, {0, 0.6, gas_line().radius + 0.025}));

  // The umbilical comes up to the ROV panel in a bend restrictor.
  Path cable = axis_of(umbilical());
  const Vec3 panel = cooler * Vec3(-2.25, kCoolerWidth / 2 + 0.2, 1.5);
  cable.insert(cable.begin(), {panel, cooler * Vec3(-2.25, kCoolerWidth / 2 + 0.75, 0.95)});
  cable = laid_through(cable, 0.3);
  lines.add(pipe("rubber", cable, umbilical().radius, {{0.1, 0.9, 0.11}}, 10));
  return lines;
}

Shape make_pipeline_supports() {
  Shape supports;
  const auto sleeper = [&](const Route& route, double station) {
    add_below(supports, route, station, [&](double height) { return make_sleeper(height, route.radius); });
  };
  const auto grout_bag = [&](const Route& route, double station, std::uint32_t seed) {
    add_below(supports, route, station, [&](double height) { return make_grout_bag(height + 0.05, seed); });
  };
  sleeper(inlet_line(), 13);
  sleeper(inlet_line(), 20);
  sleeper(outlet_line(), 5.2);
  sleeper(outlet_line(), 14.2);
  grout_bag(gas_line(), 30.4, 1);
  grout_bag(gas_line(), 39.2, 2);
  grout_bag(gas_line(), 44.6, 3);

  supports.add(mattress_over(gas_line(), 20, 3));
  supports.add(mattress_over(gas_line(), station_near(axis_of(gas_line()), 27.2, 22.2), 0));
  supports.add(mattress_over(inlet_line(), 31, 88));
  return supports;
}

// valve.cpp -- a gate valve with a hydraulic actuator.

#include <cmath>

#include "kit/fittings.h"
#include "kit/kit.h"
#include "kit/path.h"
#include "kit/pipe.h"

namespace {

// Measures of a valve by the radius of its pipe [m].
struct Gauge {
  double pipe, body, bonnet, yoke, can;

  explicit Gauge(double pipe_radius)
      : pipe(pipe_radius),
        body(1.75 * pipe_radius),
        bonnet(1.45 * pipe_radius),
        yoke(1.0 * pipe_radius),
        can(1.55 * pipe_radius) {}

  // Heights above the pipe's axis.
  [[nodiscard]] double bonnet_foot() const { return body; }
  [[nodiscard]] double can_foot() const { return body + 2.2 * pipe; }
  [[nodiscard]] double can_head() const { return can_foot() + 3.6 * pipe; }
};

// A forged block, all its edges bevelled, that the pipe runs through.
Shape make_body(const Gauge& gauge) {
  const double a = gauge.body;
  const double b = 0.72 * gauge.body;
  const double bevel = 0.22 * gauge.body;
  const double length = 1.5 * gauge.body;
  // Swept along the pipe; its ends taper by scaling the section there.
  const Path path = {{-length, 0, 0}, {-length + bevel, 0, 0}, {length - bevel, 0, 0}, {length, 0, 0}};
  Shape body = sweep("steel", path, chamfered(Vec2::Zero(), {b, a}, bevel), Vec3::UnitZ());
  body.deform([&](const Vec3& p) -> Vec3 {
    const double share = std::abs(p.x()) > length - bevel / 2 ? 0.75 : 1.0;
    return {p.x(), share * p.y(), share * p.z()};
  });
  return body;
}

// From the body upwards: bonnet flange and its bolts, yoke, actuator can, override.
Shape make_top_works(const Gauge& gauge) {
  Shape top = revolve("steel",
                      {{0, gauge.bonnet_foot() - 0.03},
                       {0.8 * gauge.bonnet, gauge.bonnet_foot() - 0.03},
                       {0.8 * gauge.bonnet, gauge.bonnet_foot() + 0.06},
                       {gauge.bonnet, gauge.bonnet_foot() + 0.06},
                       {gauge.bonnet, gauge.bonnet_foot() + 0.14},
                       {0.75 * gauge.bonnet, gauge.bonnet_foot() + 0.2},
                       {gauge.yoke, gauge.bonnet_foot() + 0.24},
                       {gauge.yoke, gauge.can_foot() + 0.02},
                       {0, gauge.can_foot() + 0.02}},
                      20);
  top.add(make_bolts("steel", 0.88 * gauge.bonnet, 10, gauge.bonnet_foot() + 0.03, gauge.bonnet_foot() + 0.18, 0.022));
  const double foot = gauge.can_foot();
  const double head = gauge.can_head();
  top.add(revolve("yellow_steel",
                  {{0, foot - 0.02},
                   {0.9 * gauge.can, foot - 0.02},
                   {gauge.can, foot + 0.03},
                   {gauge.can, foot + 0.1},
                   {0.92 * gauge.can, foot + 0.11},
                   {0.92 * gauge.can, head - 0.11},
                   {gauge.can, head - 0.1},
                   {gauge.can, head - 0.03},
                   {0.85 * gauge.can, head},
                   {0, head}},
                  24));
  top.add(make_bolts("steel", 0.96 * gauge.can, 8, foot + 0.05, head - 0.05, 0.014));  // Tie rods.
  top.add(make_rov_bucket(), at({0, 0, head}));
  // Hydraulic lines from the can down to the body.
  for (const double y : {-0.5 * gauge.pipe, 0.5 * gauge.pipe}) {
    const double out = 1.45 * gauge.can;
    top.add(tube("stainless_steel",
                 bent({{0.8 * gauge.can, y, head - 0.2},
                       {out, y, head - 0.2},
                       {out, y, 0.3 * gauge.body},
                       {0.5 * gauge.body, 0.9 * y, 0.3 * gauge.body}},
                      0.06, 4),
                 0.012, 6));
  }
  return top;
}

}  // namespace

double gate_valve_half_length(double pipe_radius) {
  return 1.5 * Gauge(pipe_radius).body + 0.42;
}

double gate_valve_height(double pipe_radius) {
  return Gauge(pipe_radius).can_head() + 0.23;
}

Shape make_gate_valve(double pipe_radius) {
  const Gauge gauge(pipe_radius);
  const double half = gate_valve_half_length(pipe_radius);
  Shape valve = make_body(gauge);
  valve.add(make_top_works(gauge));
  // A spool piece of slightly heavier wall joins the body to its flanges.
  valve.add(tube("steel", {{-half, 0, 0}, {half, 0, 0}}, pipe_radius + 0.004, 18));
  for (const double side : {-1.0, 1.0}) {
    valve.add(make_flange_pair(pipe_radius), towards({side * (half - 0.2), 0, 0}, Vec3::UnitX()));
  }
  return valve;
}

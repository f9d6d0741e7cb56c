// ssiv.cpp -- the pipe with its valve, what moves the valve, and the whole mock-up.

#include "ssiv/ssiv.h"

namespace {

constexpr double kValveX = -0.12;  // Position of the main valve's stem [m].

// A U-bolt and the saddle that carry the pipe on a post from the sill.
Shape make_pipe_support() {
  Shape support = box("yellow_steel", {0.12, kSsivWidth, 0.12});
  support.deform([](const Vec3& p) -> Vec3 { return p + Vec3(0, 0, 0.2); });
  support.add(box("yellow_steel", {0.11, 0.3, kSsivPipeHeight - 0.3}), at({0, 0, kSsivPipeHeight / 2 + 0.01}));
  const double y = kSsivPipeRadius + 0.02;
  support.add(tube("steel",
                   bent({{0, -y, kSsivPipeHeight - 0.2},
                         {0, -y, kSsivPipeHeight + y},
                         {0, y, kSsivPipeHeight + y},
                         {0, y, kSsivPipeHeight - 0.2}},
                        y - 0.002, 8),
                   0.018, 8));
  return support;
}

// A small line round the main valve, with a valve of its own.
Shape make_bypass() {
  constexpr double kBore = 0.03;  // Radius over all: NPS 2 [m].
  const double reach = gate_valve_half_length(kSsivPipeRadius) + 0.14;
  const double y = 0.42;
  Shape bypass = tube("steel",
                      bent({{kValveX - reach, 0, kSsivPipeHeight},
                            {kValveX - reach, y, kSsivPipeHeight},
                            {kValveX + reach, y, kSsivPipeHeight},
                            {kValveX + reach, 0, kSsivPipeHeight}},
                           0.12, 5),
                      kBore, 10);
  bypass.add(box("steel", {0.2, 0.13, 0.16}), at({kValveX, y, kSsivPipeHeight}));
  bypass.add(
      revolve("steel", {{0, 0}, {0.045, 0}, {0.045, 0.16}, {0.075, 0.17}, {0.075, 0.36}, {0.05, 0.39}, {0, 0.39}}, 14),
      at({kValveX, y, kSsivPipeHeight + 0.06}));
  for (const double side : {-1.0, 1.0}) {
    bypass.add(revolve("steel", {{0, -0.035}, {0.075, -0.035}, {0.075, 0.035}, {0, 0.035}}, 14),
               towards({kValveX + 0.22 * side, y, kSsivPipeHeight}, Vec3::UnitX()));
  }
  return bypass;
}

// The spring-return actuator's accumulator bottles, on a bracket from the back sill.
Shape make_accumulators() {
  Shape bottles;
  for (const double x : {0.72, 0.98}) {
    bottles.add(
        revolve("steel",
                {{0, 0}, {0.07, 0.015}, {0.1, 0.06}, {0.1, 0.72}, {0.085, 0.79}, {0.04, 0.83}, {0.04, 0.9}, {0, 0.9}},
                18),
        at({x, 0.72, 0.24}));
  }
  for (const double z : {0.4, 0.82}) {
    bottles.add(box("yellow_steel", {0.56, 0.05, 0.05}), at({0.85, 0.84, z}));
  }
  bottles.add(box("yellow_steel", {0.08, 0.08, 1.0}), at({0.85, 0.9, 0.6}));
  bottles.add(box("yellow_steel", {0.6, 0.62, 0.05}), at({0.85, 0.8, 0.24}));
  return bottles;
}

// Panel on the ROV's side between sill and roof, its tubing to the actuator.
Shape make_controls() {
  constexpr double kWidth = 0.66;
  constexpr double kMiddle = 0.62;  // Along the pipe, so that the valve beside it can be seen [m].
  constexpr double kFoot = 0.72;    // [m]
  const double y = -kSsivWidth / 2 + 0.02;
  Shape controls = placed(make_rov_panel(kWidth, 0.68, 2, 2), at({kMiddle, y, kFoot}));
  for (const double x : {kMiddle - 0.24, kMiddle + 0.24}) {
    controls.add(tube("yellow_steel", {{x, y + 0.05, 0.2}, {x, y + 0.05, kSsivHeight}}, 0.036, 12));
  }
  for (const double x : {0.46, 0.54, 0.72, 0.8}) {
    controls.add(tube("stainless_steel",
                      bent({{x, y + 0.01, kFoot + 0.2},
                            {x, y + 0.3, kFoot + 0.2},
                            {x, y + 0.3, 0.34 + 0.1 * x},
                            {kValveX + 0.3 * x, -0.12, 0.42 + 0.1 * x}},
                           0.08, 4),
                      0.01, 6));
  }
  return controls;
}

}  // namespace

Shape make_ssiv_valve() {
  Shape valve = make_gate_valve(kSsivPipeRadius);
  valve = placed(valve, at({kValveX, 0, kSsivPipeHeight}));
  valve.add(tube("steel", {{-kSsivPipeReach, 0, kSsivPipeHeight}, {kSsivPipeReach, 0, kSsivPipeHeight}},
                 kSsivPipeRadius, 20));
  for (const double side : {-1.0, 1.0}) {
    valve.add(make_blind_flange(kSsivPipeRadius),
              towards({side * kSsivPipeReach, 0, kSsivPipeHeight}, side * Vec3::UnitX()));
    valve.add(make_flange_pair(kSsivPipeRadius), towards({side * 1.75, 0, kSsivPipeHeight}, Vec3::UnitX()));
  }
  for (const double x : {-1.08, 1.02}) {
    valve.add(make_pipe_support(), at({x, 0, 0}));
  }
  valve.add(make_bypass());
  valve.add(make_accumulators());
  valve.add(make_controls());
  return valve;
}

Shape make_ssiv() {
  Shape ssiv = make_ssiv_frame();
  ssiv.add(make_ssiv_roof());
  ssiv.add(make_ssiv_valve());
  return ssiv;
}

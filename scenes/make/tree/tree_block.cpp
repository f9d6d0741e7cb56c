// tree_block.cpp -- connector, valve block, valves with their actuators, wings, choke and cap.

#include "tree/tree.h"

namespace {

// A prism with chamfered upright edges, from z0 to z1.
Shape block(const std::string& material, double half_x, double half_y, double z0, double z1, double chamfer) {
  return placed(plate(material, chamfered(Vec2::Zero(), {half_x, half_y}, chamfer), {}, z1 - z0), at({0, 0, z0}));
}

// A collet connector: funnel, body with its grooves, upper flange, six actuating cylinders.
Shape make_connector() {
  Shape connector = revolve("steel",
                            {{0, 1.20},
                             {0.38, 1.20},
                             {0.52, 1.25},
                             {0.56, 1.33},
                             {0.56, 1.40},
                             {kConnectorRadius, 1.42},
                             {kConnectorRadius, 1.62},
                             {0.59, 1.63},
                             {0.59, 1.68},
                             {kConnectorRadius, 1.69},
                             {kConnectorRadius, 1.93},
                             {0.57, 1.97},
                             {0.48, 1.99},
                             {0.48, 2.04},
                             {0.54, 2.05},
                             {0.54, 2.14},
                             {0.44, 2.15},
                             {0.44, kBlockFoot + 0.02},
                             {0, kBlockFoot + 0.02}},
                            40);
  connector.add(
      revolve("steel", {{0.60, 1.36}, {0.72, 1.12}, {0.735, 1.12}, {0.62, 1.40}, {0.60, 1.36}}, 40));  // Skirt.
  connector.add(make_bolts("stainless_steel", 0.51, 20, 2.0, 2.19, 0.018));
  for (const Vec2& p : ring(Vec2::Zero(), 0.66, 0.66, 6)) {
    connector.add(revolve("stainless_steel",
                          {{0, 1.46}, {0.055, 1.46}, {0.055, 1.84}, {0.025, 1.85}, {0.025, 2.02}, {0, 2.02}}, 12),
                  at({p.x(), p.y(), 0}));
  }
  return connector;
}

// Bonnet, hydraulic actuator and ROV bucket, along +z from the block's face; the bucket's rim at z = length.
Shape make_valve(double length, double radius) {
  const double bucket = 0.26;  // Depth.
  const double body_end = length - bucket - 0.03;
  Shape valve = revolve("steel",
                        {{0, -0.03},
                         {1.05 * radius, -0.03},
                         {1.05 * radius, 0.06},
                         {0.62 * radius, 0.08},
                         {0.55 * radius, 0.16},
                         {0.98 * radius, 0.18},
                         {radius, 0.20},
                         {radius, body_end - 0.05},
                         {0.86 * radius, body_end - 0.02},
                         {0.45 * radius, body_end},
                         {0.36 * radius, length - bucket + 0.02},
                         {0, length - bucket + 0.02}},
                        24);
  valve.add(make_bolts("stainless_steel", 0.86 * radius, 10, 0.04, 0.085, 0.014));
  // The bucket: an open can with a T bar on the stem's end in it.
  const double can = 0.13;
  valve.add(revolve("stainless_steel",
                    {{0.02, length - bucket - 0.012},
                     {can, length - bucket},
                     {can, length - 0.01},
                     {can + 0.025, length},
                     {can - 0.010, length},
                     {can - 0.012, length - bucket + 0.012},
                     {0.02, length - bucket + 0.004},
                     {0.02, length - bucket - 0.012}},
                    24));
  valve.add(tube("stainless_steel", {{0, 0, length - bucket}, {0, 0, length - 0.10}}, 0.02, 8));
  valve.add(tube("stainless_steel", {{-0.095, 0, length - 0.09}, {0.095, 0, length - 0.09}}, 0.017, 8));
  return valve;
}

// All valves look at the panel, their buckets' rims a hand's breadth before it.
Pose facing_panel(double x, const ValvePlace& place) {
  return towards({x, place.y, place.z}, Vec3::UnitX());
}

// The wing on one side: its block, its valve, and on the production side the choke behind it.
Shape make_wing(const ValvePlace& place, double size) {
  Shape wing =
      placed(block("steel", 0.5 * size, 0.6 * size, -0.55 * size, 0.55 * size, 0.05), at({0.02, place.y, place.z}));
  const double side = std::copysign(1.0, place.y);
  wing.add(make_flange_pair(0.13 * size / 0.45),
           towards({0.02, side * (kBlockHalfWidth + 0.02), place.z}, Vec3::UnitY()));
  const double face = 0.02 + 0.5 * size;
  wing.add(make_valve(kPanelX + 0.06 - face, 0.145), facing_panel(face, place));
  return wing;
}

// The choke's body with its inlet, and above it the insert, clamp and stepping actuator.
Shape make_choke() {
  Shape choke = revolve(
      "steel", {{0, -0.30},   {0.12, -0.30}, {0.19, -0.24}, {0.19, 0.14}, {0.25, 0.16}, {0.25, 0.22}, {0.22, 0.23},
                {0.22, 0.26}, {0.25, 0.27},  {0.25, 0.33},  {0.17, 0.36}, {0.14, 0.44}, {0.21, 0.47}, {0.21, 0.86},
                {0.18, 0.91}, {0.10, 0.94},  {0.10, 1.04},  {0.13, 1.05}, {0.13, 1.10}, {0, 1.11}},
      28);
  choke.add(make_bolts("stainless_steel", 0.225, 12, 0.13, 0.36, 0.014));
  std::vector<Vec3> handle;
  for (const double angle : spaced(0, kPi, 10)) {
    handle.emplace_back(0.13 * std::cos(angle), 0, 1.08 + 0.14 * std::sin(angle));
  }
  choke.add(tube("stainless_steel", handle, 0.013, 6));
  return choke;
}

// The cap: a dome locked on the tree's mandrel, a lid over the roof's hole, and on it four ribs, two torque buckets and
// the re-entry hub.
Shape make_cap() {
  constexpr double kLid = 4.41;  // Its upper face.
  Shape cap = revolve("steel", {{0, 3.58},    {0.40, 3.58}, {0.47, 3.61},     {0.47, 3.70}, {0.43, 3.72}, {0.43, 4.00},
                                {0.40, 4.08}, {0.33, 4.17}, {0.24, 4.235},    {0.24, 4.36}, {0.58, 4.37}, {0.58, 4.39},
                                {0.55, kLid}, {0.18, kLid}, {0.15, 4.43},     {0.15, 4.56}, {0.21, 4.58}, {0.21, 4.65},
                                {0.17, 4.67}, {0.12, 4.73}, {0.10, kTreeTop}, {0, kTreeTop}},
                      36);
  cap.add(make_bolts("stainless_steel", 0.435, 18, 3.60, 3.745, 0.02));
  const Shape rib = plate("steel", {{0.10, 4.38}, {0.52, 4.38}, {0.50, 4.44}, {0.20, 4.54}, {0.10, 4.54}}, {}, 0.025);
  for (int i = 0; i < 4; ++i) {
    cap.add(placed(placed(rib, at({0, 0.0125, 0}, 90)), at({0, 0, 0}, 0, 0, 90 * i + 45)));
  }
  for (const double y : {-0.34, 0.34}) {
    cap.add(make_rov_bucket(), at({0, y, kLid}));
  }
  return cap;
}

}  // namespace

Shape make_valve_tree() {
  Shape tree = make_connector();
  tree.add(block("steel", kBlockHalfWidth, kBlockHalfWidth, kBlockFoot, kBlockTop, 0.09));
  for (const ValvePlace& place : kMasterValves) {
    tree.add(make_valve(kPanelX + 0.06 - kBlockHalfWidth, 0.175), facing_panel(kBlockHalfWidth, place));
  }
  for (const ValvePlace& place : kSwabValves) {
    tree.add(make_valve(kPanelX + 0.06 - kBlockHalfWidth, 0.155), facing_panel(kBlockHalfWidth, place));
  }
  tree.add(make_valve(kPanelX + 0.06 - kBlockHalfWidth, 0.115), facing_panel(kBlockHalfWidth, kCrossoverValve));
  tree.add(make_wing(kWingValves[0], 0.46));
  tree.add(make_wing(kWingValves[1], 0.36));
  tree.add(make_choke(), at({-0.02, 1.22, 2.86}));
  tree.add(tube("steel", {{0, 0.95, 2.88}, {0, 1.15, 2.88}}, 0.12, 20));
  tree.add(make_cap());
  return tree;
}

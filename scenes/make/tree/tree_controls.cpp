// tree_controls.cpp -- what an ROV and the platform work the tree with: panel, control pod and stab plate.

#include "tree/tree.h"

namespace {

// A receptacle for a hot stab, which brings hydraulic pressure from the vehicle; opening towards +z.
Shape make_hot_stab() {
  return revolve(
      "stainless_steel",
      {{0, -0.05}, {0.07, -0.05}, {0.07, 0.02}, {0.055, 0.03}, {0.055, 0.14}, {0.035, 0.14}, {0.033, 0.03}, {0, 0.03}},
      18);
}

// A plate before the valves, their buckets standing through it, with grab bars for the vehicle and a stiffened edge.
Shape make_valve_panel() {
  constexpr double kHalf = 1.16, kFoot = 2.08, kTop = 3.70, kThickness = 0.02;
  std::vector<std::vector<Vec2>> holes;
  const auto hole = [&](const ValvePlace& place) { holes.push_back(ring({place.y, place.z}, 0.175, 0.175, 24)); };
  for (const auto& pair : {kMasterValves, kSwabValves, kWingValves}) {
    hole(pair[0]);
    hole(pair[1]);
  }
  hole(kCrossoverValve);
  Shape panel =
      placed(plate("grp", chamfered({0, (kFoot + kTop) / 2}, {kHalf, (kTop - kFoot) / 2}, 0.15), holes, kThickness),
             at({kPanelX - kThickness, 0, 0}, 90, 0, 90));
  // Edge bars behind it, to the frame's legs.
  for (const double z : {kFoot + 0.25, kTop - 0.25}) {
    panel.add(tube("steel", {{kPanelX - 0.05, -kFrameHalfWidth + 0.05, z}, {kPanelX - 0.05, kFrameHalfWidth - 0.05, z}},
                   0.035, 12));
  }
  // Grab bars above and below, and four hot-stab receptacles beside the valves.
  for (const double z : {kFoot + 0.08, kTop - 0.08}) {
    panel.add(make_handle("stainless_steel", {kPanelX - 0.01, -0.85, z}, {kPanelX - 0.01, 0.85, z}, {0.17, 0, 0}, 0.06,
                          0.019));
  }
  for (const double z : {2.45, 3.30}) {
    for (const double y : {-0.72, 0.74}) {
      panel.add(make_hot_stab(), towards({kPanelX, y, z}, Vec3::UnitX()));
    }
  }
  return panel;
}

// The control pod on its base plate: rounded housing, lid, lock-down mandrel with its bail, guide pins.
Shape make_pod() {
  std::vector<Vec2> outline;
  for (const double angle : spaced(0, 2 * std::numbers::pi * 35 / 36, 36)) {  // A superellipse.
    const double c = std::cos(angle), s = std::sin(angle);
    outline.emplace_back(0.35 * std::copysign(std::pow(std::abs(c), 0.45), c),
                         0.35 * std::copysign(std::pow(std::abs(s), 0.45), s));
  }
  const auto scaled = [&](double factor) {
    std::vector<Vec2> points = outline;
    for (Vec2& p : points) {
      p *= factor;
    }
    return points;
  };
  Shape pod = placed(plate("steel", scaled(1.12), {}, 0.09), at({0, 0, 2.30}));
  pod.add(plate("stainless_steel", outline, {}, 0.98), at({0, 0, 2.36}));
  pod.add(plate("stainless_steel", scaled(1.06), {}, 0.07), at({0, 0, 3.30}));
  pod.add(revolve("steel",
                  {{0, 3.33},
                   {0.16, 3.33},
                   {0.16, 3.42},
                   {0.09, 3.45},
                   {0.09, 3.60},
                   {0.12, 3.61},
                   {0.12, 3.66},
                   {0.08, 3.70},
                   {0, 3.71}},
                  24));
  for (const double angle : {45, 225}) {
    pod.add(revolve("steel", {{0, 2.32}, {0.04, 2.32}, {0.04, 3.50}, {0.02, 3.58}, {0, 3.59}}, 12),
            at({0.455 * std::cos(angle / 57.29578), 0.455 * std::sin(angle / 57.29578), 0}));
  }
  pod.add(box("steel", {0.5, 0.22, 0.16}), at({0.42, 0.02, 2.25}));  // Bracket to the block.
  return pod;
}

// Where the umbilical's flying lead plugs in: a stab plate on the annulus side, the lead's half on it.
Shape make_stab_plate() {
  Shape stab = box("steel", {0.62, 0.03, 0.5});
  for (const double x : {-0.2, 0.0, 0.2}) {
    for (const double z : {-0.12, 0.12}) {
      stab.add(revolve("stainless_steel", {{0, -0.1}, {0.045, -0.1}, {0.045, 0.06}, {0.03, 0.07}, {0, 0.07}}, 12),
               towards({x, 0, z}, -Vec3::UnitY()));
    }
  }
  stab.add(box("stainless_steel", {0.56, 0.05, 0.42}), at({0, -0.10, 0}));
  stab.add(make_handle("stainless_steel", {-0.2, -0.11, 0.16}, {0.2, -0.11, 0.16}, {0, -0.17, 0}, 0.05, 0.015));
  stab.add(tube("steel", {{0, 0.0, 0.2}, {0, 0.16, 0.42}}, 0.04, 10));
  return stab;
}

}  // namespace

Shape make_tree_controls() {
  Shape controls = make_valve_panel();
  controls.add(make_pod(), at({-1.0, -0.15, 0}));
  controls.add(make_stab_plate(), at({0.55, -1.72, 2.42}));
  return controls;
}

Shape make_christmas_tree() {
  Shape tree = make_guide_base();
  tree.add(make_valve_tree());
  tree.add(make_flow_loops());
  tree.add(make_tree_frame());
  tree.add(make_tree_controls());
  return tree;
}

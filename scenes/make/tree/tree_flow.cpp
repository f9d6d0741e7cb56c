// tree_flow.cpp -- production and annulus loops down to their hubs on the guide base, the crossover, and the tubing.

#include "tree/tree.h"

namespace {

constexpr double kHubX = -1.66;  // Where the flow lines connect, behind the tree.
constexpr double kHubHeight = 1.34;

// From a wing down beside the posts, along the side and back to a hub that looks away from the panel.
Shape make_loop(double side, double pipe_radius, double top, double low, double out) {
  const std::vector<Vec3> corners = {{-0.02, side * out, top},         {-0.02, side * out, low},
                                     {-0.78, side * out, low},         {-0.78, side * 0.74, low},
                                     {-0.78, side * 0.74, kHubHeight}, {kHubX - 0.3, side * 0.74, kHubHeight}};
  Shape loop = tube("stainless_steel", bent(corners, 3.2 * pipe_radius), pipe_radius, 18);
  loop.add(make_flange_pair(pipe_radius), at({-0.02, side * out, top - 0.28}));
  loop.add(make_flange_pair(pipe_radius), towards({-0.36, side * out, low}, Vec3::UnitX()));
  // The hub: a clamp of two halves on a stand, with its screw.
  const double r = pipe_radius;
  loop.add(revolve("steel",
                   {{0, -0.2},
                    {1.5 * r, -0.2},
                    {1.8 * r, -0.12},
                    {2.4 * r, -0.11},
                    {2.4 * r, 0.11},
                    {1.8 * r, 0.12},
                    {1.5 * r, 0.2},
                    {0, 0.2}},
                   28),
           towards({kHubX, side * 0.74, kHubHeight}, Vec3::UnitX()));
  loop.add(
      tube("stainless_steel",
           {{kHubX, side * 0.74 - 3.6 * r, kHubHeight + 2.2 * r}, {kHubX, side * 0.74 + 3.6 * r, kHubHeight + 2.2 * r}},
           0.02, 8));
  loop.add(box("steel", {0.16, 0.3, 0.5}), at({kHubX + 0.24, side * 0.74, 1.08}));
  return loop;
}

// From the production wing round behind the block to the annulus wing.
Shape make_crossover() {
  const double z = kCrossoverValve.z;
  return tube("stainless_steel", bent({{-0.15, 0.90, z}, {-0.62, 0.90, z}, {-0.62, -0.90, z}, {-0.12, -0.86, z}}, 0.16),
              0.030, 12);
}

// Hydraulic tubes from the pod past the block to the actuators, side by side in two bundles.
Shape make_tubing() {
  Shape tubing;
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < 5; ++i) {
      const double z = 2.235 + 0.05 * i;
      const double end = 0.72 + 0.06 * i;
      tubing.add(tube("stainless_steel",
                      bent({{-0.80, side * 0.10 - 0.15, z},
                            {-0.55, side * (0.40 + 0.02 * i), z},
                            {-0.40, side * 0.505, z},
                            {end, side * 0.505, z},
                            {end, side * 0.505, z + 0.35},
                            {end, side * 0.36, z + 0.42}},
                           0.07),
                      0.011, 6));
    }
    for (const double x : {-0.25, 0.3}) {  // Clamps.
      tubing.add(box("hdpe", {0.05, 0.035, 0.28}), at({x, side * 0.505, 2.34}));
    }
  }
  return tubing;
}

}  // namespace

Shape make_flow_loops() {
  Shape loops = make_loop(1, kProductionRadius, 2.70, 1.98, 1.22);
  loops.add(make_loop(-1, kAnnulusRadius, 2.88, 1.80, 1.16));
  loops.add(
      tube("stainless_steel", {{0.02, -0.85, 2.88}, {0.0, -1.10, 2.88}, {-0.02, -1.16, 2.84}}, kAnnulusRadius, 14));
  loops.add(make_crossover());
  loops.add(make_tubing());
  return loops;
}

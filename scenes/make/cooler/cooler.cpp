// cooler.cpp -- coils in their racks, headers, risers and valves, and the whole cooler.

#include "cooler/cooler.h"

namespace {

constexpr double kHalfPass = kPassLength / 2;
constexpr double kHeaderX = kHalfPass + 0.45;  // Distance of both headers' axes from the middle [m].
constexpr double kBanksWidth = (kCoilBanks - 1) * kBankPitch;
constexpr double kRackX[] = {-3.1, -1.55, 0.0, 1.55, 3.1};  // [m]

double bank_y(int bank) {
  return bank * kBankPitch - kBanksWidth / 2;
}

// One bank: to and fro between inlet header at the top of one end and outlet header at the foot of the other.
Path coil_path() {
  Path corners = {{-kHeaderX + 0.03, 0, kHighestPass}};
  double x = kHalfPass + kCoilPitch / 2;
  for (int pass = 0; pass + 1 < kCoilPasses; ++pass) {
    const double z = kHighestPass - pass * kCoilPitch;
    corners.emplace_back(x, 0, z);
    corners.emplace_back(x, 0, z - kCoilPitch);
    x = -x;
  }
  corners.emplace_back(kHeaderX - 0.03, 0, kLowestPass);
  // A little less than half the pitch, so that two bends that share a corner's straight leave some of it.
  return bent(corners, 0.499 * kCoilPitch, 4);
}

// Two posts and a comb of flat bars between them that the passes rest on.
Shape make_rack() {
  Shape rack;
  const double post = kBanksWidth / 2 + 0.22;
  for (const double y : {-post, post}) {
    rack.add(box("steel", {0.12, 0.1, kHighestPass + 0.3}), at({0, y, (kHighestPass + 0.3) / 2 - 0.018}));
  }
  for (int pass = 0; pass < kCoilPasses; ++pass) {
    const double z = kLowestPass + pass * kCoilPitch - kCoilRadius - 0.015;
    rack.add(box("steel", {0.07, 2 * post, 0.05}), at({0, 0, z}));
  }
  rack.add(box("steel", {0.1, 2 * post, 0.09}), at({0, 0, kHighestPass + 0.2}));
  return rack;
}

// A header across the banks with domed caps, and a short branch to every bank.
Shape make_header(double x, double z) {
  const double half = kBanksWidth / 2 + 0.35;
  const double cap = 0.6 * kHeaderRadius;
  std::vector<Vec2> profile = {{0, -half - cap}};
  for (const double share : {0.5, 0.8, 0.95}) {
    profile.emplace_back(share * kHeaderRadius, -half - cap * std::sqrt(1 - share * share));
  }
  profile.emplace_back(kHeaderRadius, -half);
  for (std::size_t i = profile.size(); i > 0; --i) {
    profile.emplace_back(profile[i - 1].x(), -profile[i - 1].y());
  }
  Shape header = placed(revolve("steel", profile, 24), towards({x, 0, z}, Vec3::UnitY()));
  for (int bank = 0; bank < kCoilBanks; ++bank) {  // Weldolets.
    const double inwards = x < 0 ? 1 : -1;
    header.add(revolve("steel", {{0, 0.1}, {0.11, 0.1}, {0.075, 0.23}, {0, 0.23}}, 14),
               towards({x, bank_y(bank), z}, inwards * Vec3::UnitX()));
  }
  return header;
}

// From a header through a valve, whose outer flange is where the spool is bolted on. It stands on a saddle.
Shape make_branch(const Path& corners) {
  const Vec3& end = corners.back();
  const double out = std::copysign(1.0, end.x());
  const Vec3 valve = end - out * gate_valve_half_length(kHeaderRadius) * Vec3::UnitX();
  const double saddle = end.z() - 0.12;  // Its height [m].
  Path within = corners;
  within.back() = valve;
  Shape branch = tube("steel", bent(within, 0.28, 6), kHeaderRadius, 20);
  branch.add(make_gate_valve(kHeaderRadius), at(valve));
  branch.add(box("steel", {0.5, 0.34, saddle}), at({valve.x(), valve.y(), saddle / 2 - 0.016}));
  return branch;
}

// The inlet climbs outside the frame to the header at the top; the outlet leaves straight from the one at the foot.
Shape make_inlet() {
  const double riser = -kCoolerLength / 2 - 0.4;
  const double y = kCoolerInlet.y();
  return make_branch(
      {{-kHeaderX, y, kHighestPass}, {riser, y, kHighestPass}, {riser, y, kCoolerInlet.z()}, kCoolerInlet});
}

Shape make_outlet() {
  return make_branch({{kHeaderX, kCoolerOutlet.y(), kCoolerOutlet.z()}, kCoolerOutlet});
}

}  // namespace

Shape make_cooler_coils() {
  Shape coils;
  const Shape bank = tube("stainless_steel", coil_path(), kCoilRadius, 10);
  for (int i = 0; i < kCoilBanks; ++i) {
    coils.add(bank, at({0, bank_y(i), 0}));
  }
  const Shape rack = make_rack();
  for (const double x : kRackX) {
    coils.add(rack, at({x, 0, 0}));
  }
  return coils;
}

Shape make_cooler_piping() {
  Shape piping = make_header(-kHeaderX, kHighestPass);
  piping.add(make_header(kHeaderX, kLowestPass));
  piping.add(make_inlet());
  piping.add(make_outlet());

  // The ROV's side: a panel of receptacles on two struts.
  const Vec3 panel(-2.25, kCoolerWidth / 2 + 0.32, 1.35);
  piping.add(make_rov_panel(1.5, 1.1, 3, 2), at(panel, 0, 0, 180));
  for (const double x : {-0.55, 0.55}) {
    piping.add(
        tube("yellow_steel",
             {{panel.x() + x, panel.y() - 0.01, panel.z() + 0.15}, {panel.x() + x, kCoolerWidth / 2 - 0.02, 0.2}}, 0.05,
             10));
    piping.add(tube(
        "yellow_steel",
        {{panel.x() + x, panel.y() - 0.01, panel.z() + 0.95}, {panel.x() + x, kCoolerWidth / 2 - 0.02, kCoolerHeight}},
        0.05, 10));
  }
  return piping;
}

Shape make_cooler() {
  Shape cooler = make_cooler_frame();
  cooler.add(make_cooler_coils());
  cooler.add(make_cooler_piping());
  return cooler;
}

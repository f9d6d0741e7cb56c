// fittings.h -- what every subsea structure carries: mudmats, anodes, lifting points, bolts, ROV
// receptacles, guide posts, valves.

#pragma once

#include "kit/shape.h"

/// A perforated plate that spreads a structure's weight over soft ground, its top at z = 0: skirts below, ribs above,
/// holes for the water that it presses out.
[[nodiscard]] Shape make_mudmat(double length, double width);

/// A stand-off anode along x: an alloy bar on two bent steel legs that reach down to z = 0, the bar `stand_off` [m]
/// above it.
[[nodiscard]] Shape make_stand_off_anode(double length, double stand_off = 0.22);

/// A plate in x-z with a hole and cheek plates, for a shackle; its foot is 30 mm below z = 0.
[[nodiscard]] Shape make_padeye(double height = 0.3);

/// `count` hexagon bars on a circle about z, the first on +x, from `low` to `high`: bolts, studs, tie rods.
[[nodiscard]] Shape make_bolts(const std::string& material, double circle_radius, int count, double low, double high,
                               double bolt_radius);

/// A round bar bent twice: out from `from`, along, and back to `to`: a grab bar, a lifting loop, a bail.
[[nodiscard]] Shape make_handle(const std::string& material, const Vec3& from, const Vec3& to, const Vec3& out,
                                double bend_radius, double bar_radius);

/// A torque receptacle for an ROV's tool (ISO 13628-8 has 154 mm square for classes 1 to 4), opening towards +z.
[[nodiscard]] Shape make_rov_bucket();

/// A panel with receptacles in its front, which faces -y, and a grab bar on either side; foot at z = 0.
[[nodiscard]] Shape make_rov_panel(double width, double height, int columns, int rows);

/// A post with a conical head onto which a guide wire or funnel is slid, and a neck for the wire's latch.
[[nodiscard]] Shape make_guide_post(const std::string& material, double height, double radius);

/// A gate valve: the pipe runs along x between two flange pairs, the stem up along z through bonnet and yoke to a
/// hydraulic actuator with its ROV override. About the pipe's axis.
[[nodiscard]] Shape make_gate_valve(double pipe_radius);

/// Half of the length that make_gate_valve() takes up along the pipe, and its height above the pipe's axis [m].
[[nodiscard]] double gate_valve_half_length(double pipe_radius);
[[nodiscard]] double gate_valve_height(double pipe_radius);

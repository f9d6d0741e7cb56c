// car.h -- a wrecked saloon car, in its own frame: x forward from midway between the axles, y to its left, z up from
// the road.

#pragma once

#include "kit/modelling.h"

// Measures of a mid-size saloon of the 1980s, near those of the Volvo 240 [m].
inline constexpr double kWheelbase = 2.65;
inline constexpr double kTrack = 1.40;
inline constexpr double kCarTail = -2.40;  ///< x of the body's ends, without bumpers.
inline constexpr double kCarNose = 2.16;
inline constexpr double kCarWidth = 1.70;
inline constexpr double kRoofHeight = 1.42;
inline constexpr double kSillHeight = 0.20;
inline constexpr double kCowl = 0.80;        ///< x where windscreen and bonnet meet.
inline constexpr double kRearShelf = -1.44;  ///< x where rear window and boot lid meet.
inline constexpr double kTyreRadius = 0.31;  ///< 185/70 R 14.
inline constexpr double kTyreWidth = 0.185;
inline constexpr double kArchRadius = 0.375;

// Lines of the body [m].
[[nodiscard]] double body_half_width(double x);
[[nodiscard]] double shoulder_height(double x);
/// A point of the lower body. `girth` runs from -1 at the right sill over bonnet or boot (0) to +1 at the left one; the
/// sides are beyond +-0.4, the shoulders between +-0.3 and +-0.4.
[[nodiscard]] Vec3 body_point(double x, double girth);
/// A point of the cabin. `girth` runs from -1 at the right waistline over the roof to +1 at the left one; the sides are
/// beyond +-0.55.
[[nodiscard]] Vec3 cabin_point(double x, double girth);

/// The left side's doors: where they are cut from body and cabin.
struct DoorCut {
  double rear, front;                ///< x [m]
  double window_rear, window_front;  ///< x at the waistline [m]
};
inline constexpr DoorCut kFrontDoor{-0.27, 0.73, -0.25, 0.55};
inline constexpr DoorCut kRearDoor{-0.94, -0.35, -0.95, -0.38};

// Its parts, undamaged.
[[nodiscard]] Shape make_body();      ///< Wings, sides, boot, nose and tail, floor and bulkheads; both left doors off.
[[nodiscard]] Shape make_cabin();     ///< Pillars and roof, without glass but for splinters.
[[nodiscard]] Shape make_interior();  ///< Seats, dashboard, steering wheel.
[[nodiscard]] Shape make_engine_bay();
[[nodiscard]] Shape make_bonnet();                  ///< In place; hinged at the cowl.
[[nodiscard]] Shape make_door(const DoorCut& cut);  ///< In place, on the left.
[[nodiscard]] Shape make_bumper();                  ///< About its middle, bulging to +x.
/// Rim and tyre about their middle, their axle along y, outside to +y.
[[nodiscard]] Shape make_car_wheel();
/// Hub and brake disc where a wheel is missing; as the wheel.
[[nodiscard]] Shape make_brake();

/// All of it, as it lies on the bed: crushed, doors torn off, one wheel missing.
[[nodiscard]] Shape make_wrecked_car();

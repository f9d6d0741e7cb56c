// pipe.h -- line pipe with its field joints, anode bracelets and flanges.

#pragma once

#include "kit/path.h"
#include "kit/shape.h"

/// Length of a joint of line pipe: "double random", nominally 40 ft (API 5L) [m].
inline constexpr double kJointLength = 12.2;

/// A stretch of a pipe that is thicker or thinner than the rest: a field joint, a sleeve.
struct Collar {
  double from, to;  ///< Stations [m].
  double radius;    ///< [m]
};

/// A round pipe along a path, closed at both ends, stepping to each collar's radius over 20 mm. Collars are in order
/// and apart.
[[nodiscard]] Shape pipe(const std::string& material, const Path& path, double radius,
                         const std::vector<Collar>& collars, int sides = 16);

/// Field joints every kJointLength from `first` [m] on: the stretch where two joints were welded, `length` long.
[[nodiscard]] std::vector<Collar> field_joints(const Path& path, double first, double length, double radius);

/// A sacrificial anode round a pipe at a station: two half shells of aluminium, `length` long.
[[nodiscard]] Shape make_bracelet(const Path& path, double station, double pipe_radius, double length = 0.6);

/// Two weld-neck flanges bolted together about z = 0, the pipe along z.
[[nodiscard]] Shape make_flange_pair(double pipe_radius);

/// A flange closed by a blind: the pipe ends at z = 0 coming from -z.
[[nodiscard]] Shape make_blind_flange(double pipe_radius);

/// Outer radius of a flange, by the pipe's [m].
[[nodiscard]] double flange_radius(double pipe_radius);

// path.h -- the lines that pipes follow: straights and bends, and routes laid over the ground.

#pragma once

#include <vector>

#include "kit/shape.h"

using Path = std::vector<Vec3>;

/// Straight pieces from corner to corner, each corner rounded with a bend of `radius` [m] in `pieces` chords. A bend
/// is tighter where its two straights are too short for it.
[[nodiscard]] Path bent(const Path& corners, double radius, int pieces = 6);

/// A smooth line through all `points` (a Catmull-Rom spline), in steps of about `step` [m].
[[nodiscard]] Path laid_through(const Path& points, double step);

/// Length along the path from its start to each of its points [m].
[[nodiscard]] std::vector<double> stations(const Path& path);

/// The same path with a point of its own at every one of `extra` stations [m] that lies within it.
[[nodiscard]] Path with_stations(const Path& path, const std::vector<double>& extra);

/// Position at a station [m], and a pose there whose z axis runs along the path.
[[nodiscard]] Vec3 point_at(const Path& path, double station);
[[nodiscard]] Pose frame_at(const Path& path, double station);

/// A pose whose z axis points along `direction`, and its x axis as near to the world's up as that allows (to the
/// world's x where the two are the same).
[[nodiscard]] Pose towards(const Vec3& position, const Vec3& direction);

/// Distance in plan from a place to the nearest point of a path [m].
[[nodiscard]] double distance_in_plan(const Path& path, double x, double y);

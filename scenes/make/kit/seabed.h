// seabed.h -- ground as a grid of triangles, and the stones on it.

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "kit/ripples.h"
#include "kit/shape.h"

/// Height of the ground at a place [m].
using Ground = std::function<double(double x, double y)>;

/// Grid lines at `step` between `fine_low` and `fine_high`, further and further apart towards `low` and `high` [m].
[[nodiscard]] std::vector<double> graded(double low, double fine_low, double fine_high, double high, double step);

/// The ground over a grid of lines.
[[nodiscard]] Shape make_bed(const std::string& material, const Ground& ground, const std::vector<double>& x,
                             const std::vector<double>& y);

/// 1 at distance 0, falling like a bell.
[[nodiscard]] double bump(double distance, double width);

struct Boulder {
  double x, y;    ///< [m]
  double radius;  ///< [m]
};

/// Stones strewn over a patch, many small and few large: the radius that a share q of them exceeds is
/// least_radius (1 - spread (1 - q))^-exponent.
struct StoneField {
  std::size_t count;
  Patch patch;
  double least_radius;      ///< [m]
  double spread, exponent;  ///< Parameters of the power law.
  std::uint32_t seed;
};
/// @param has_room  Whether a stone may lie where it fell.
[[nodiscard]] std::vector<Boulder> strewn_stones(const StoneField& field,
                                                 const std::function<bool(const Boulder&)>& has_room);

/// How the current has dug round stones: deeper by so much [m], and this share of the ripples left.
struct StoneScour {
  double depth, calm;
};
[[nodiscard]] StoneScour stone_scour(const std::vector<Boulder>& stones, double x, double y);

/// Weathered stones, partly buried.
/// @param seed  Stone i is shaped by seed + 1 + i.
[[nodiscard]] Shape make_boulders(const std::vector<Boulder>& stones, const Ground& ground, std::uint32_t seed);

/// Where on the ground a thing lies, sunk in by `sunk` [m].
[[nodiscard]] Pose on_ground(const Ground& ground, double x, double y, double sunk, double roll_deg, double pitch_deg,
                             double yaw_deg);

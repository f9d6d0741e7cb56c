// kit.h -- building blocks of models: plates, sheets with openings, bars, beams, tubes, turned parts and pebbles.

#pragma once

#include <string>
#include <vector>

#include "kit/shape.h"

using Vec2 = Eigen::Vector2d;

/// A surface as a function of two parameters.
using Surface = std::function<Vec3(double s, double t)>;

/// A rectangle of a surface that is skipped: window, door, freeing port, hatch.
struct Opening {
  double s0, s1, t0, t1;
};

/// A surface sampled where `s` and `t` say, facing ds x dt. Has no thickness: for ground alone.
[[nodiscard]] Shape sheet(const std::string& material, const Surface& surface, const std::vector<double>& s,
                          const std::vector<double>& t);

/// A surface sampled where `s` and `t` say, and at the edges of its openings, with a second skin `thickness` [m] behind
/// (against ds x dt; in front where negative) and all edges closed. `closed` says that the last s is the first again:
/// a casing without a seam.
[[nodiscard]] Shape panel(const std::string& material, const Surface& surface, const std::vector<double>& s,
                          const std::vector<double>& t, double thickness, const std::vector<Opening>& openings = {},
                          bool closed = false);

/// An upright wall over the line from `from` to `to`; openings are in metres along it and up from its foot. The skin
/// faces to the right of the walking direction; the thickness goes to the left.
[[nodiscard]] Shape wall(const std::string& material, const Vec3& from, const Vec3& to, double height, double thickness,
                         const std::vector<Opening>& openings = {});

/// A flat plate in x-y between z = 0 and z = thickness: an outline with holes, each in order around it (either way),
/// none touching another.
[[nodiscard]] Shape plate(const std::string& material, std::vector<Vec2> outline, std::vector<std::vector<Vec2>> holes,
                          double thickness);

/// `count` points on a circle or ellipse, anticlockwise: an outline or a hole.
[[nodiscard]] std::vector<Vec2> ring(const Vec2& center, double radius_x, double radius_y, int count);

/// An upright rectangle, its four corners cut off at 45 degrees `cut` [m] from where they were.
[[nodiscard]] std::vector<Vec2> chamfered(const Vec2& center, const Vec2& half_size, double cut);

/// A box about its centre.
[[nodiscard]] Shape box(const std::string& material, const Vec3& size);

/// A profile drawn along a path, closed at both ends. The profile's second axis starts towards `up` and is carried
/// along without twist; its first is path direction x up. Of its profile every corner is seen from the first. `closed`
/// joins the end to the start instead.
[[nodiscard]] Shape sweep(const std::string& material, const std::vector<Vec3>& path, const std::vector<Vec2>& profile,
                          const Vec3& up, bool closed = false);

/// A round bar along a path.
[[nodiscard]] Shape tube(const std::string& material, const std::vector<Vec3>& path, double radius, int sides = 8,
                         bool closed = false);

/// `count` points on the circle or ellipse center + cos * first + sin * second: the path of a closed tube.
[[nodiscard]] std::vector<Vec3> hoop(const Vec3& center, const Vec3& first, const Vec3& second, int count);

/// A rolled I section from one point to another, its web upright (along x where the beam itself is upright).
[[nodiscard]] Shape i_beam(const std::string& material, const Vec3& from, const Vec3& to, double height, double width);

/// A profile of (radius, height) turned about z.
[[nodiscard]] Shape revolve(const std::string& material, const std::vector<Vec2>& profile, int sides);

/// A sphere of radius 1 from an icosahedron: 20 x 4^subdivisions nearly equal triangles.
[[nodiscard]] Shape icosphere(const std::string& material, int subdivisions);

// shape.h -- triangles by material, and the moves that put parts together.

#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/geometry.h"

using insonify::Pose;
using insonify::Vec3;

inline constexpr double kPi = std::numbers::pi;

/// A surface under construction. Parts are made on their own, about their own origin, and added to a whole.
struct Shape {
  struct Face {
    std::array<std::uint32_t, 3> corners;  ///< Into `vertices`.
    std::uint16_t material;                ///< Into `materials`.
  };
  std::vector<Vec3> vertices;  ///< [m]
  std::vector<Face> faces;
  std::vector<std::string> materials;  ///< Written as `usemtl`.

  /// An empty shape whose triangles will all be of one material.
  static Shape of(std::string material) { return {.vertices = {}, .faces = {}, .materials = {std::move(material)}}; }

  std::uint32_t add_vertex(const Vec3& position);
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint16_t material = 0);
  /// Corners in order around it; cut along a-c.
  void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, std::uint16_t material = 0);

  /// Adds a copy of `part`, placed.
  void add(const Shape& part, const Pose& whole_from_part = {});

  /// Adds a copy and its mirror image in y = 0: port and starboard.
  void add_both_sides(const Shape& part);

  /// Moves every vertex: bends, dents, sags.
  void deform(const std::function<Vec3(const Vec3&)>& moved);
};

/// The same shape somewhere else.
[[nodiscard]] Shape placed(const Shape& shape, const Pose& pose);

/// Where and how a part stands: position [m]; roll, pitch, yaw as in SDF, in degrees.
[[nodiscard]] Pose at(const Vec3& position, double roll_deg = 0, double pitch_deg = 0, double yaw_deg = 0);

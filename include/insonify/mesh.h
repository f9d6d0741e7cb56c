// mesh.h -- triangle meshes, their clean-up, and the primitive shapes and height grids tessellated into them.

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "insonify/geometry.h"
#include "insonify/relief.h"

namespace insonify {

/// Triangles in a mesh frame. Both sides of a triangle echo.
struct Mesh {
  std::string name;
  std::vector<Vec3f> vertices;                          ///< Mesh frame [m].
  std::vector<Vec3f> normals;                           ///< Unit shading normals, one per vertex.
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< Indices into `vertices`.
  std::vector<std::uint16_t> material_slots;    ///< Index into `material_names`, one per triangle; empty: all 0.
  std::vector<std::string> material_names{""};  ///< Names in the file, at least one; "" if the file has none.

  /// Texture coordinates of each triangle's corners, 0..1 to the right and up over a picture; empty: none.
  std::vector<std::array<Eigen::Vector2f, 3>> texture_coordinates;
  /// Relief of each material name, null for none; empty: none at all.
  std::vector<std::shared_ptr<const Relief>> reliefs;

  [[nodiscard]] std::uint16_t slot_of(std::size_t triangle) const {
    return material_slots.empty() ? std::uint16_t{0} : material_slots[triangle];
  }
};

/// Changes made by clean_mesh().
struct MeshReport {
  std::size_t triangles_read = 0;
  std::size_t zero_area = 0;        ///< Dropped: the corners lie on a line.
  std::size_t not_finite = 0;       ///< Dropped: a corner is NaN or infinite.
  std::size_t bad_index = 0;        ///< Dropped: a corner that does not exist.
  bool normals_computed = false;    ///< The file had none, or some that were unusable.
  std::size_t normals_flipped = 0;  ///< Vertex normals that pointed against their triangles' winding.

  [[nodiscard]] std::size_t dropped() const { return zero_area + not_finite + bad_index; }

  /// "12 of 8358 triangles dropped (10 of zero area, 2 with NaN corners)"; "" when nothing was.
  [[nodiscard]] std::string text() const;
};

/// Drops triangles that cannot be traced, merges identical vertices, and gives every vertex a unit normal on the side
/// to which its triangles are wound. Missing normals are averaged over the triangles that share the vertex and meet at
/// edges of about `crease_angle` [rad] (within a tenth) or less, whatever their winding; at 0.78 of it or less, where
/// one is three times as large as the other. Triangles much smaller than the largest at a vertex do not turn its
/// normal. Vertices are split along sharper edges.
/// @throws Error when no triangle is left; the message names the mesh and what was dropped. Also for material slots
///         that do not match the triangles or the names.
[[nodiscard]] MeshReport clean_mesh(Mesh& mesh, double crease_angle = 0.7853981633974483);

// The SDF primitives, centred on the origin with smooth normals where the shape is smooth. Vertices lie on the surface;
// `max_edge_angle` [rad] bounds the angle between neighbouring normals. Sizes are full lengths [m], > 0.

[[nodiscard]] Mesh make_box(const Vec3& size);
[[nodiscard]] Mesh make_sphere(double radius, double max_edge_angle = 0.05);
[[nodiscard]] Mesh make_ellipsoid(const Vec3& radii, double max_edge_angle = 0.05);
/// Axis along z.
[[nodiscard]] Mesh make_cylinder(double radius, double length, double max_edge_angle = 0.05);
/// Axis along z; `length` is that of the cylindrical part.
[[nodiscard]] Mesh make_capsule(double radius, double length, double max_edge_angle = 0.05);
/// Axis along z, base at -length/2, tip at +length/2.
[[nodiscard]] Mesh make_cone(double radius, double length, double max_edge_angle = 0.05);
/// A rectangle through the origin across `normal`. SDF's infinite plane is `size` with a large side.
[[nodiscard]] Mesh make_plane(const Vec3& normal, double size_x, double size_y);

/// A grid of heights: rows run along -y from the north-west corner, columns along +x, as pictures and survey grids do.
struct HeightGrid {
  int columns = 0, rows = 0;         ///< >= 2 each.
  double spacing_x = 1;              ///< [m], > 0.
  double spacing_y = 1;              ///< [m], > 0.
  std::vector<float> heights;        ///< rows x columns [m]; NaN where there is no data.
  Vec3 origin = Vec3::Zero();        ///< The grid's centre in the survey's own coordinates [m]; informative.
  std::string name = "height grid";  ///< Name in messages: the file it comes from.
};

/// Mesh of a height grid, centred in x and y, with smooth normals: two triangles per cell with data at all four
/// corners, one where only three have.
[[nodiscard]] Mesh make_height_field(const HeightGrid& grid);

}  // namespace insonify

// clean_mesh.cpp -- removes triangles that cannot be traced from a mesh and makes its shading normals valid.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "insonify/error.h"
#include "insonify/mesh.h"
#include "scene/mesh_steps.h"

namespace insonify {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

std::string name_of(const Mesh& mesh) {
  return mesh.name.empty() ? "mesh" : mesh.name;
}

void check_slots(Mesh& mesh) {
  if (mesh.material_names.empty()) {
    mesh.material_names.emplace_back();
  }
  if (!mesh.material_slots.empty() && mesh.material_slots.size() != mesh.triangles.size()) {
    throw Error(fmt::format("{}: {} material slots for {} triangles", name_of(mesh), mesh.material_slots.size(),
                            mesh.triangles.size()));
  }
  if (!mesh.texture_coordinates.empty() && mesh.texture_coordinates.size() != mesh.triangles.size()) {
    throw Error(fmt::format("{}: texture coordinates of {} triangles for {}", name_of(mesh),
                            mesh.texture_coordinates.size(), mesh.triangles.size()));
  }
  if (!mesh.reliefs.empty() && mesh.reliefs.size() != mesh.material_names.size()) {
    throw Error(fmt::format("{}: {} reliefs for {} material names", name_of(mesh), mesh.reliefs.size(),
                            mesh.material_names.size()));
  }
  for (const std::uint16_t slot : mesh.material_slots) {
    if (slot >= mesh.material_names.size()) {
      throw Error(fmt::format("{}: material slot {} must be less than {}, the number of material names", name_of(mesh),
                              slot, mesh.material_names.size()));
    }
  }
}

bool exists(const Mesh& mesh, const Triangle& triangle) {
  return std::ranges::all_of(triangle, [&](std::uint32_t corner) { return corner < mesh.vertices.size(); });
}

bool is_finite(const Mesh& mesh, const Triangle& triangle) {
  return std::ranges::all_of(triangle, [&](std::uint32_t corner) { return mesh.vertices[corner].allFinite(); });
}

// False if the triangle is degenerate to the precision of its coordinates: if its height over the longest edge is less
// than the rounding error of that edge's length.
constexpr double kRounding = std::numeric_limits<float>::epsilon();
bool has_area(const Mesh& mesh, const Triangle& triangle) {
  const Vec3 a = mesh.vertices[triangle[0]].cast<double>();
  const Vec3 b = mesh.vertices[triangle[1]].cast<double>();
  const Vec3 c = mesh.vertices[triangle[2]].cast<double>();
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  constexpr double kTooLong = 1e8;  // [m] Beyond what a scene can hold: check_reach() refuses it, and says so.
  return (b - a).cross(c - a).norm() > longest * kRounding || longest > kTooLong * kTooLong;
}

// Whether a triangle can be traced; if not, counts the reason in the report.
bool is_good(const Mesh& mesh, const Triangle& triangle, MeshReport& report) {
  if (!exists(mesh, triangle)) {
    ++report.bad_index;
    return false;
  }
  if (!is_finite(mesh, triangle)) {
    ++report.not_finite;
    return false;
  }
  if (!has_area(mesh, triangle)) {
    ++report.zero_area;
    return false;
  }
  return true;
}

void drop_bad_triangles(Mesh& mesh, MeshReport& report) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (is_good(mesh, mesh.triangles[i], report)) {
      mesh.triangles[kept] = mesh.triangles[i];
      if (!mesh.material_slots.empty()) {
        mesh.material_slots[kept] = mesh.material_slots[i];
      }
      if (!mesh.texture_coordinates.empty()) {
        mesh.texture_coordinates[kept] = mesh.texture_coordinates[i];
      }
      ++kept;
    }
  }
  mesh.triangles.resize(kept);
  mesh.material_slots.resize(mesh.material_slots.empty() ? 0 : kept);
  mesh.texture_coordinates.resize(mesh.texture_coordinates.empty() ? 0 : kept);
}

// The normal with unit length; zero if it is too short or not finite.
Vec3f unit_or_zero(const Vec3f& normal) {
  const Vec3 exact = normal.cast<double>();
  const double length = exact.norm();
  constexpr double kShortest = 1e-12;
  return std::isfinite(length) && length > kShortest ? Vec3f((exact / length).cast<float>()) : Vec3f::Zero();
}

void drop_bad_normals(Mesh& mesh) {
  if (mesh.normals.size() != mesh.vertices.size()) {
    mesh.normals.assign(mesh.vertices.size(), Vec3f::Zero());
  }
  for (Vec3f& normal : mesh.normals) {
    normal = unit_or_zero(normal);
  }
}

std::size_t count_missing(const std::vector<Vec3f>& normals) {
  return static_cast<std::size_t>(std::ranges::count_if(normals, [](const Vec3f& normal) { return normal.isZero(0); }));
}

}  // namespace

std::string MeshReport::text() const {
  std::string reasons;
  const auto add = [&](std::size_t count, std::string_view what) {
    if (count > 0) {
      reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", count, what);
    }
  };
  add(zero_area, "of zero area");
  add(not_finite, "with NaN corners");
  add(bad_index, "with corners that do not exist");
  return reasons.empty() ? "" : fmt::format("{} of {} triangles dropped ({})", dropped(), triangles_read, reasons);
}

MeshReport clean_mesh(Mesh& mesh, double crease_angle) {
  check_slots(mesh);
  MeshReport report;
  report.triangles_read = mesh.triangles.size();

  drop_bad_triangles(mesh, report);
  if (mesh.triangles.empty()) {
    throw Error(
        fmt::format("{}: no triangles{}{}", name_of(mesh), report.dropped() > 0 ? " left: " : "", report.text()));
  }

  drop_bad_normals(mesh);
  weld_vertices(mesh);
  const std::size_t missing = count_missing(mesh.normals);
  if (missing < mesh.normals.size()) {
    report.normals_flipped = turn_normals_to_winding(mesh);
  }
  if (missing > 0) {
    report.normals_computed = true;
    fill_normals(mesh, crease_angle);
  }

  mesh.vertices.shrink_to_fit();
  mesh.normals.shrink_to_fit();
  mesh.triangles.shrink_to_fit();
  mesh.material_slots.shrink_to_fit();
  mesh.texture_coordinates.shrink_to_fit();
  return report;
}

}  // namespace insonify

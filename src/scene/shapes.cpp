// shapes.cpp -- tessellates the primitive shapes of SDF into closed meshes with outward winding.

#include <cmath>

#include "base/rotation_between.h"
#include "insonify/field.h"
#include "insonify/mesh.h"

namespace insonify {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kQuadrants = 4;

void check_size(std::string_view shape, std::string_view name, double value) {
  check_field(shape, {name, "m", greater_than(0), ""}, value);
}

void check_edge_angle(std::string_view shape, double angle) {
  check_field(shape, {"max_edge_angle", "rad", from_to(0.001, kPi / 2), ""}, angle);
}

std::uint32_t add_vertex(Mesh& mesh, const Vec3& position, const Vec3& normal) {
  mesh.vertices.push_back(Vec3f(position.cast<float>()));
  mesh.normals.push_back(Vec3f(normal.cast<float>()));
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  mesh.triangles.push_back({a, b, c});
}

// A flat rectangle whose corners are center +- right +- up, seen from the side to which right x up points.
void add_rectangle(Mesh& mesh, const Vec3& center, const Vec3& right, const Vec3& up) {
  const Vec3 normal = right.cross(up).normalized();
  const std::uint32_t a = add_vertex(mesh, center - right - up, normal);
  const std::uint32_t b = add_vertex(mesh, center + right - up, normal);
  const std::uint32_t c = add_vertex(mesh, center + right + up, normal);
  const std::uint32_t d = add_vertex(mesh, center - right + up, normal);
  add_triangle(mesh, a, b, c);
  add_triangle(mesh, a, c, d);
}

// Unit vector normal to the z axis, at the angle `step` of `steps` around it. Exact at multiples of 90 degrees, so that
// shapes are symmetric.
Vec3 spoke(int step, int steps) {
  const int quarter = steps / kQuadrants;
  const double angle = kPi / 2 * (step % quarter) / quarter;
  const double c = step % quarter == 0 ? 1 : std::cos(angle);
  const double s = step % quarter == 0 ? 0 : std::sin(angle);
  switch (step / quarter % kQuadrants) {
    case 0:
      return {c, s, 0};
    case 1:
      return {-s, c, 0};
    case 2:
      return {-c, -s, 0};
    default:
      return {s, -c, 0};
  }
}

// Number of steps around a circle, a multiple of four.
int circle_steps(double max_edge_angle) {
  return kQuadrants * static_cast<int>(std::ceil(kPi / 2 / max_edge_angle));
}

// Number of rings between the pole and the equator. Ring k has 4 k vertices, so that triangles have similar sizes and
// none is degenerate. The longest edge, a diagonal near a pole, is hypot(1, pi/2) = 1.862 times the distance of two
// rings.
int sphere_rings(double max_edge_angle) {
  return static_cast<int>(std::ceil(std::hypot(1, kPi / 2) * kPi / 2 / max_edge_angle));
}

int ring_size(int ring) {
  return ring == 0 ? 1 : kQuadrants * ring;
}

// Triangles between two neighbouring rings of a half sphere, given the index of the first vertex of each.
void join_rings(Mesh& mesh, int ring, std::uint32_t inner, std::uint32_t outer, bool upper) {
  const auto at = [](std::uint32_t first, int index, int size) { return first + index % size; };
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    upper ? add_triangle(mesh, a, b, c) : add_triangle(mesh, a, c, b);
  };
  for (int quadrant = 0; quadrant < kQuadrants; ++quadrant) {
    for (int i = 0; i <= ring; ++i) {
      const std::uint32_t here = at(inner, quadrant * ring + i, ring_size(ring));
      const int below = quadrant * (ring + 1) + i;
      const std::uint32_t next = at(outer, below + 1, ring_size(ring + 1));
      add(here, at(outer, below, ring_size(ring + 1)), next);
      if (i < ring) {
        add(here, next, at(inner, quadrant * ring + i + 1, ring_size(ring)));
      }
    }
  }
}

struct Placed {
  Vec3 position, normal;
};

// Adds half a sphere, from the pole to the equator, with vertices given by place(direction).
// @param equator  Index of the first vertex of the other half's equator, to share it; null to add one.
// @return Index of the first vertex of the equator.
template <typename Place>
std::uint32_t add_half_sphere(Mesh& mesh, int rings, bool upper, Place&& place,
                              const std::uint32_t* equator = nullptr) {
  const double side = upper ? 1 : -1;
  const auto add = [&](const Vec3& direction) {
    const Placed placed = place(direction);
    return add_vertex(mesh, placed.position, placed.normal);
  };
  std::uint32_t inner = add({0, 0, side});
  for (int ring = 1; ring <= rings; ++ring) {
    const double angle = kPi / 2 * ring / rings;
    const double across = ring == rings ? 1 : std::sin(angle);
    const double along = ring == rings ? 0 : std::cos(angle);
    auto outer = static_cast<std::uint32_t>(mesh.vertices.size());
    if (ring == rings && equator != nullptr) {
      outer = *equator;
    } else {
      for (int i = 0; i < ring_size(ring); ++i) {
        add(across * spoke(i, ring_size(ring)) + side * along * Vec3::UnitZ());
      }
    }
    join_rings(mesh, ring - 1, inner, outer, upper);
    inner = outer;
  }
  return inner;
}

// Triangles between two circles of equal vertex count that lie one above the other.
void join_circles(Mesh& mesh, int steps, std::uint32_t lower, std::uint32_t upper) {
  for (int i = 0; i < steps; ++i) {
    const std::uint32_t here = i;
    const std::uint32_t next = (i + 1) % steps;
    add_triangle(mesh, lower + here, lower + next, upper + next);
    add_triangle(mesh, lower + here, upper + next, upper + here);
  }
}

std::uint32_t add_circle(Mesh& mesh, int steps, double radius, double z) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int i = 0; i < steps; ++i) {
    add_vertex(mesh, radius * spoke(i, steps) + z * Vec3::UnitZ(), spoke(i, steps));
  }
  return first;
}

// A flat disc that faces along +z or -z.
void add_disc(Mesh& mesh, int steps, double radius, double z, bool upper) {
  const Vec3 normal = (upper ? 1 : -1) * Vec3::UnitZ();
  const std::uint32_t center = add_vertex(mesh, z * Vec3::UnitZ(), normal);
  for (int i = 0; i < steps; ++i) {
    add_vertex(mesh, radius * spoke(i, steps) + z * Vec3::UnitZ(), normal);
  }
  for (int i = 0; i < steps; ++i) {
    const std::uint32_t here = center + 1 + i;
    const std::uint32_t next = center + 1 + (i + 1) % steps;
    upper ? add_triangle(mesh, center, here, next) : add_triangle(mesh, center, next, here);
  }
}

}  // namespace

Mesh make_box(const Vec3& size) {
  check_size("box", "size_x", size.x());
  check_size("box", "size_y", size.y());
  check_size("box", "size_z", size.z());
  const Vec3 x = size.x() / 2 * Vec3::UnitX();
  const Vec3 y = size.y() / 2 * Vec3::UnitY();
  const Vec3 z = size.z() / 2 * Vec3::UnitZ();
  Mesh mesh;
  add_rectangle(mesh, x, y, z);
  add_rectangle(mesh, -x, z, y);
  add_rectangle(mesh, y, z, x);
  add_rectangle(mesh, -y, x, z);
  add_rectangle(mesh, z, x, y);
  add_rectangle(mesh, -z, y, x);
  return mesh;
}

Mesh make_sphere(double radius, double max_edge_angle) {
  check_size("sphere", "radius", radius);
  return make_ellipsoid({radius, radius, radius}, max_edge_angle);
}

Mesh make_ellipsoid(const Vec3& radii, double max_edge_angle) {
  check_size("ellipsoid", "radius_x", radii.x());
  check_size("ellipsoid", "radius_y", radii.y());
  check_size("ellipsoid", "radius_z", radii.z());
  check_edge_angle("ellipsoid", max_edge_angle);
  // The mapping from directions w of the unit sphere is a compromise between even steps in position (w scaled by the
  // radii r) and even steps in the normal (which gives flat sides few vertices and long thin triangles): the point is r
  // times the unit vector along r^1/2 w, and its normal is along r^-1/2 w.
  const Vec3 root = radii.cwiseSqrt();
  const auto place = [&](const Vec3& direction) -> Placed {
    return {radii.cwiseProduct(root.cwiseProduct(direction).normalized()), direction.cwiseQuotient(root).normalized()};
  };
  // Normals then turn faster than directions, at most by the ratio of these roots.
  const double widest_step = max_edge_angle * root.minCoeff() / root.maxCoeff();
  Mesh mesh;
  const int rings = sphere_rings(widest_step);
  const std::uint32_t equator = add_half_sphere(mesh, rings, true, place);
  add_half_sphere(mesh, rings, false, place, &equator);
  return mesh;
}

Mesh make_cylinder(double radius, double length, double max_edge_angle) {
  check_size("cylinder", "radius", radius);
  check_size("cylinder", "length", length);
  check_edge_angle("cylinder", max_edge_angle);
  const int steps = circle_steps(max_edge_angle);
  Mesh mesh;
  const std::uint32_t lower = add_circle(mesh, steps, radius, -length / 2);
  const std::uint32_t upper = add_circle(mesh, steps, radius, length / 2);
  join_circles(mesh, steps, lower, upper);
  add_disc(mesh, steps, radius, length / 2, true);
  add_disc(mesh, steps, radius, -length / 2, false);
  return mesh;
}

Mesh make_capsule(double radius, double length, double max_edge_angle) {
  check_size("capsule", "radius", radius);
  check_size("capsule", "length", length);
  check_edge_angle("capsule", max_edge_angle);
  const int rings = sphere_rings(max_edge_angle);
  const Vec3 end = length / 2 * Vec3::UnitZ();
  Mesh mesh;
  const std::uint32_t upper = add_half_sphere(mesh, rings, true, [&](const Vec3& normal) -> Placed {
    return {radius * normal + end, normal};
  });
  const std::uint32_t lower = add_half_sphere(mesh, rings, false, [&](const Vec3& normal) -> Placed {
    return {radius * normal - end, normal};
  });
  join_circles(mesh, ring_size(rings), lower, upper);
  return mesh;
}

Mesh make_cone(double radius, double length, double max_edge_angle) {
  check_size("cone", "radius", radius);
  check_size("cone", "length", length);
  check_edge_angle("cone", max_edge_angle);
  const int steps = circle_steps(max_edge_angle);
  const Vec3 base = -length / 2 * Vec3::UnitZ();
  // Normal of the cone's side, whose profile is the hypotenuse of the triangle of radius and length.
  const auto side_normal = [&](const Vec3& out) { return (length * out + radius * Vec3::UnitZ()).normalized(); };
  Mesh mesh;
  for (int i = 0; i < steps; ++i) {
    add_vertex(mesh, radius * spoke(i, steps) + base, side_normal(spoke(i, steps)));
  }
  for (int i = 0; i < steps; ++i) {
    const int next = (i + 1) % steps;
    // The normal at the tip is undefined: each triangle has a tip vertex with a normal half-way between its sides'.
    const Vec3 between = (spoke(i, steps) + spoke(next, steps)).normalized();
    const std::uint32_t tip = add_vertex(mesh, -base, side_normal(between));
    add_triangle(mesh, i, next, tip);
  }
  add_disc(mesh, steps, radius, base.z(), false);
  return mesh;
}

Mesh make_plane(const Vec3& normal, double size_x, double size_y) {
  check_size("plane", "size_x", size_x);
  check_size("plane", "size_y", size_y);
  check_field("plane", {"normal's length", "", greater_than(0), ""}, normal.norm());
  const Vec3 up = normal.normalized();
  // The shortest rotation from z to the normal; for a normal straight down, half a turn about x.
  const Eigen::Quaterniond turn =
      up.z() > -1 + 1e-12 ? rotation_between(Vec3::UnitZ(), up) : Eigen::Quaterniond(0, 1, 0, 0);
  Mesh mesh;
  add_rectangle(mesh, Vec3::Zero(), turn * Vec3(size_x / 2, 0, 0), turn * Vec3(0, size_y / 2, 0));
  return mesh;
}

}  // namespace insonify

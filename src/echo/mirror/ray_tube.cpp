// ray_tube.cpp -- differentials of a reflected ray.

#include "echo/mirror/ray_tube.h"

#include <cmath>

namespace insonify {
namespace {

// Derivatives of the hit and of the reflected direction with respect to the ray's direction [1/rad].
struct Neighbour {
  Vec3f place, turn;
};

}  // namespace

RayTube ray_tube(const std::array<Vec3f, 3>& corners, const std::array<Vec3f, 3>& normals, const Vec3f& direction,
                 const Vec3f& normal, float range) {
  const Vec3f change1 = normals[1] - normals[0], change2 = normals[2] - normals[0];
  const Vec3f edge1 = corners[1] - corners[0], edge2 = corners[2] - corners[0], flat = edge1.cross(edge2);
  const float facing = direction.dot(flat), doubled = flat.squaredNorm();
  if ((change1.isZero(0) && change2.isZero(0)) || facing * facing <= 1e-8F * doubled) {
    return RayTube::of_plane(range);
  }
  const Vec3f about = normal.dot(normals[0] + normals[1] + normals[2]) < 0 ? Vec3f(-normal) : normal;
  const float cosine = direction.dot(about);
  const auto neighbour = [&](const Vec3f& aside) {
    const Vec3f place = range * (aside - direction * (aside.dot(flat) / facing));
    // Barycentric coordinates of `place`, from ratios of areas.
    const float along1 = place.cross(edge2).dot(flat) / doubled, along2 = edge1.cross(place).dot(flat) / doubled;
    Vec3f bend = along1 * change1 + along2 * change2;
    bend -= about * about.dot(bend);
    return Neighbour{place, aside - 2 * ((aside.dot(about) + direction.dot(bend)) * about + cosine * bend)};
  };
  const Vec3f aside = direction.unitOrthogonal();
  const Neighbour a = neighbour(aside), b = neighbour(direction.cross(aside));
  const Vec3f reflected = direction - 2 * cosine * about;
  return {a.place.cross(b.place).dot(reflected), (a.place.cross(b.turn) + a.turn.cross(b.place)).dot(reflected),
          a.turn.cross(b.turn).dot(reflected)};
}

}  // namespace insonify

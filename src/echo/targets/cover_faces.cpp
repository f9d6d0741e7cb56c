// cover_faces.cpp -- finds the faces of thin sheets by rays to both of their sides.

#include <algorithm>
#include <cmath>

#include "echo/targets/face_glints.h"

namespace insonify {
namespace {

// A triangle of a face, in the world.
struct FacePlace {
  GlintingFaces::Group* group;
  std::size_t face;  // Index in the group.
  std::array<Vec3, 3> corners;
  Vec3 normal;  // first x second

  [[nodiscard]] double area() const { return (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm(); }
};

// Shares of the corners in the places of a triangle from which rays look.
constexpr double kShares[][3] = {{0.34, 0.33, 0.33}, {0.61, 0.21, 0.18}, {0.19, 0.6, 0.21}, {0.2, 0.18, 0.62}};

// The largest triangle of each face.
std::vector<FacePlace> places_of(const Scene& scene, GlintingFaces& faces) {
  std::vector<FacePlace> places;
  for (GlintingFaces::Group& group : faces.groups) {
    const Instance& instance = scene.instances[group.instance];
    const Mesh& mesh = *instance.mesh;
    const MeshFaces& of_mesh = *faces.of_mesh[group.instance];
    std::vector<std::uint32_t> number(of_mesh.faces.size(), MeshFaces::kNone);  // [face] Index in the group.
    for (std::uint32_t i = 0; i < group.face.size(); ++i) {
      number[group.face[i]] = i;
    }
    const std::size_t first = places.size();
    places.resize(first + group.face.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const std::uint32_t i = of_mesh.face_of[t] == MeshFaces::kNone ? MeshFaces::kNone : number[of_mesh.face_of[t]];
      if (i == MeshFaces::kNone) {
        continue;
      }
      FacePlace place{&group, i, {}, Vec3::Zero()};
      for (int k = 0; k < 3; ++k) {
        place.corners[k] = mesh.vertices[mesh.triangles[t][k]].cast<double>();
      }
      if (places[first + i].group == nullptr || place.area() > places[first + i].area()) {
        places[first + i] = place;
      }
    }
    const auto axis = [&](const auto& x, const auto& y, const auto& z, std::size_t i) {
      return Vec3f(x[i], y[i], z[i]).cast<double>().eval();
    };
    for (std::size_t i = 0; i < group.face.size(); ++i) {
      FacePlace& place = places[first + i];
      for (Vec3& corner : place.corners) {
        corner = instance.world_from_mesh * corner;
      }
      place.normal =
          instance.world_from_mesh.orientation * axis(group.first_x, group.first_y, group.first_z, i)
                                                     .cross(axis(group.second_x, group.second_y, group.second_z, i));
    }
  }
  return places;
}

// Looks at places of faces from both sides with rays.
class Look {
 public:
  Look(const Scene& scene, Engine& engine) : scene_(scene), engine_(engine) {
    const Box3 bounds = scene.bounds();
    rounding_ = 4 * 1.2e-7 * (bounds.high - bounds.low).norm();
  }

  // [place] Side on which it is covered at a share of its corners, as GlintingFaces::Group::covered.
  [[nodiscard]] std::vector<std::int8_t> covered(const std::vector<FacePlace>& places, const double (&shares)[3]) {
    rays_.clear();
    for (const FacePlace& place : places) {
      const Vec3 middle = shares[0] * place.corners[0] + shares[1] * place.corners[1] + shares[2] * place.corners[2];
      for (const double side : {1.0, -1.0}) {
        rays_.push_back({middle + side * GlintingFaces::kThinnest * place.normal, -side * place.normal, 0,
                         2 * GlintingFaces::kThinnest});
      }
    }
    hits_.resize(rays_.size());
    engine_.trace(rays_, hits_);
    std::vector<std::int8_t> sides;
    for (std::size_t i = 0; i < places.size(); ++i) {
      // Heights of the first surfaces from both sides, outwards from the face.
      const double above = GlintingFaces::kThinnest - distance(places[i], hits_[2 * i]),
                   below = GlintingFaces::kThinnest - distance(places[i], hits_[2 * i + 1]);
      const bool thick = above + below > rounding_ && std::isfinite(above) && std::isfinite(below);
      sides.push_back(!thick ? std::int8_t{0} : above > below ? std::int8_t{1} : std::int8_t{-1});
    }
    return sides;
  }

 private:
  // Infinite if something else that moves is hit.
  [[nodiscard]] double distance(const FacePlace& place, const Hit& hit) const {
    const bool own = hit.instance == place.group->instance;
    const bool counts =
        own || (hit.instance != kNoLabel && !scene_.instances[hit.instance].endless &&
                !scene_.instances[hit.instance].moving && !scene_.instances[place.group->instance].moving);
    return counts ? hit.distance : std::numeric_limits<double>::infinity();
  }

  const Scene& scene_;
  Engine& engine_;
  double rounding_;  // Largest error of the difference of two hits [m].
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
};

}  // namespace

void cover_faces(const Scene& scene, Engine& engine, GlintingFaces& faces) {
  std::vector<FacePlace> places = places_of(scene, faces);
  Look look(scene, engine);
  for (const auto& shares : kShares) {
    const std::vector<std::int8_t> sides = look.covered(places, shares);
    std::vector<FacePlace> left;
    for (std::size_t i = 0; i < places.size(); ++i) {
      std::int8_t& covered = places[i].group->covered[places[i].face];
      covered = &shares == &kShares[0] || covered == sides[i] ? sides[i] : std::int8_t{0};
      if (covered != 0) {
        left.push_back(places[i]);
      }
    }
    places = std::move(left);
  }
}

}  // namespace insonify

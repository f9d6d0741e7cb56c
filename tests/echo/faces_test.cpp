// faces_test.cpp -- plane faces of meshes, and diffraction at mirrors of their size.

#include "echo/mirror/faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <tuple>

namespace insonify::faces_test {
namespace {

constexpr float kWide = 1e6F;
Workers workers(2);

TEST(FacesTest, ABoxHasSixAndASphereNone) {
  const Mesh box = make_box({0.4, 0.6, 1.2});
  const auto found = find_faces(box, workers);
  ASSERT_EQ(found->faces.size(), 6U);
  std::multiset<int> areas;  // [cm^2]
  for (const Face& face : found->faces) {
    areas.insert(static_cast<int>(std::lround(4e4 * face.half[0] * face.half[1])));
    EXPECT_NEAR(face.axes[0].dot(face.axes[1]), 0, 1e-6);
    EXPECT_GE(face.half[0], face.half[1]);  // Along the longest outer edge, never along a diagonal.
  }
  EXPECT_EQ(areas, (std::multiset<int>{2400, 2400, 4800, 4800, 7200, 7200}));
  EXPECT_TRUE(find_faces(make_sphere(0.5), workers)->faces.empty());
}

// Both sides of a plate, cut into two triangles on one side and 18 on the other, and given twice: one face, as wide and
// high as the plate.
TEST(FacesTest, BothSidesOfAPlateAreOneFace) {
  for (const int copies : {1, 2}) {
    Mesh plate;
    const auto add = [&](const std::array<Vec3f, 4>& corners, float side) {
      const auto first = static_cast<std::uint32_t>(plate.vertices.size());
      for (const Vec3f& corner : corners) {
        plate.vertices.push_back(corner);
        plate.normals.emplace_back(0, 0, side);
      }
      for (int copy = 0; copy < copies; ++copy) {
        plate.triangles.push_back({first, first + 1, first + 2});
        plate.triangles.push_back({first, first + 2, first + 3});
      }
    };
    add({Vec3f(0, 0, 0), Vec3f(0.6F, 0, 0), Vec3f(0.6F, 0.3F, 0), Vec3f(0, 0.3F, 0)}, 1);
    for (int i = 0; i < 9; ++i) {
      const float x = 0.2F * static_cast<float>(i / 3), y = 0.1F * static_cast<float>(i % 3);
      add({Vec3f(x, y, 0), Vec3f(x, y + 0.1F, 0), Vec3f(x + 0.2F, y + 0.1F, 0), Vec3f(x + 0.2F, y, 0)}, -1);
    }
    const auto found = find_faces(plate, workers);
    ASSERT_EQ(found->faces.size(), 1U);
    const Face& face = found->faces.front();
    EXPECT_NEAR(face.half[0] + face.half[1], 0.45, 1e-6);
    EXPECT_NEAR(face.width(), 0.3, 1e-6);
    EXPECT_NEAR((plate.vertices[face.corner] + face.middle[0] * face.axes[0] + face.middle[1] * face.axes[1] -
                 Vec3f(0.3F, 0.15F, 0))
                    .norm(),
                0, 1e-6);
  }
}

// The ends of a cylinder are plane, its mantle is not. A disc of radius a has the area of a square of side sqrt(pi) a.
TEST(FacesTest, EndsOfACylinderAreDiscs) {
  const auto found = find_faces(make_cylinder(0.3, 2), workers);
  ASSERT_EQ(found->faces.size(), 2U);
  for (const Face& face : found->faces) {
    EXPECT_NEAR(4 * face.half[0] * face.half[1], 3.14159265 * 0.3 * 0.3, 0.002);
    EXPECT_NEAR(face.half[0] / face.half[1], 1, 0.01);
  }
}

// Curved surfaces of triangles so small that their corners' normals differ by less than 0.8 degrees, some of them or
// all.
TEST(FacesTest, FinelyMeshedCurvedSurfacesHaveNone) {
  for (const double angle : {0.035, 0.03, 0.025, 0.015}) {
    EXPECT_TRUE(find_faces(make_sphere(0.5, angle), workers)->faces.empty()) << angle;
    EXPECT_EQ(find_faces(make_cylinder(0.3, 2, angle), workers)->faces.size(), 2U) << angle;
  }
  Mesh both = make_sphere(0.5, 0.03);  // Wound outwards and inwards.
  for (const auto& [a, b, c] : std::vector(both.triangles)) {
    both.triangles.push_back({a, c, b});
  }
  EXPECT_TRUE(find_faces(both, workers)->faces.empty());
}

// A plate whose corners' normals are off by up to 0.5 degrees, each by itself, is plane.
TEST(FacesTest, InexactNormalsDoNotBendAPlate) {
  constexpr int kSide = 20;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> error(-0.006F, 0.006F);
  Mesh mesh;
  for (int i = 0; i <= kSide; ++i) {
    for (int j = 0; j <= kSide; ++j) {
      mesh.vertices.emplace_back(static_cast<float>(i), static_cast<float>(j), 0.0F);
      mesh.normals.push_back(Vec3f(error(random), error(random), 1).normalized());
      if (i < kSide && j < kSide) {
        const auto corner = static_cast<std::uint32_t>(i * (kSide + 1) + j), beyond = corner + kSide + 1;
        mesh.triangles.push_back({corner, beyond, corner + 1});
        mesh.triangles.push_back({corner + 1, beyond, beyond + 1});
      }
    }
  }
  EXPECT_EQ(find_faces(mesh, workers)->faces.size(), 1U);
}

// Terraces at random heights: a triangle belongs to the face of each neighbour of the same height, and of no other.
TEST(FacesTest, TerracesAreTheConnectedSquaresOfOneHeight) {
  constexpr int kSide = 40;
  std::mt19937 random(4);
  int heights[kSide][kSide];
  Mesh mesh;
  for (auto& row : heights) {
    for (int& height : row) {
      height = static_cast<int>(random() % 2);
    }
  }
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
        mesh.vertices.emplace_back(static_cast<float>(i + x), static_cast<float>(j + y),
                                   static_cast<float>(heights[i][j]));
        mesh.normals.emplace_back(Vec3f::UnitZ());
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
  }
  const auto found = find_faces(mesh, workers);
  const auto face_of = [&](int i, int j) { return found->face_of[2 * (kSide * i + j)]; };
  std::vector<float> areas(found->faces.size(), 0);
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      EXPECT_EQ(face_of(i, j), found->face_of[2 * (kSide * i + j) + 1]);
      EXPECT_TRUE(i == 0 || (face_of(i, j) == face_of(i - 1, j)) == (heights[i][j] == heights[i - 1][j]));
      EXPECT_TRUE(j == 0 || (face_of(i, j) == face_of(i, j - 1)) == (heights[i][j] == heights[i][j - 1]));
      areas[face_of(i, j)] += 1;
    }
  }
  for (std::size_t face = 0; face < areas.size(); ++face) {
    EXPECT_NEAR(4 * found->faces[face].half[0] * found->faces[face].half[1], areas[face], 1e-3 * areas[face]);
  }
}

TEST(FacesTest, AreFoundOnceForAMesh) {
  const auto mesh = std::make_shared<const Mesh>(make_box({1, 2, 3}));
  const auto faces = shared_faces(mesh, workers);
  EXPECT_EQ(shared_faces(mesh, workers), faces);
  EXPECT_NE(shared_faces(std::make_shared<const Mesh>(*mesh), workers), faces);
}

// A box has 12 edges between two faces each, a plate four borders; each face has four of them.
TEST(FacesTest, EdgesAreWhereFacesMeetOrEnd) {
  const Mesh box = make_box({0.4, 0.6, 1.2});
  const auto of_box = find_faces(box, workers);
  ASSERT_EQ(of_box->edges.size(), 12U);
  std::vector<int> edges(6, 0);
  for (const EdgePart& part : of_box->edges) {
    EXPECT_LT(part.face[0], part.face[1]);
    for (int k = 0; k < 2; ++k) {
      ++edges[part.face[k]];
      EXPECT_EQ(of_box->face_of[part.triangle(k)], part.face[k]);
      const Vec3 along = edge_vertex(box, part.high) - edge_vertex(box, part.low);
      EXPECT_GT((opposite_vertex(box, part, k) - edge_vertex(box, part.low)).cross(along).norm(), 0.1);
    }
  }
  EXPECT_EQ(edges, std::vector<int>(6, 4));
  const auto of_plate = find_faces(make_plane(Vec3::UnitX(), 0.4, 1.0), workers);
  ASSERT_EQ(of_plate->edges.size(), 4U);
  EXPECT_TRUE(std::ranges::all_of(of_plate->edges, &EdgePart::is_border));
}

// Steps of 1 m, in more blocks of vertices than threads.
TEST(FacesTest, AreTheSameForAnyNumberOfThreads) {
  Mesh mesh;
  for (int i = 0; i < 20'000; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const float height = std::ceil(0.5F * static_cast<float>(i)), step = std::floor(0.5F * static_cast<float>(i));
    const Vec3f corner(step, 0, height), along = i % 2 == 0 ? Vec3f::UnitZ() : Vec3f::UnitX();
    for (const Vec3f& off : {Vec3f(0, 0, 0), Vec3f(along), Vec3f(along + Vec3f::UnitY())}) {
      mesh.vertices.push_back(corner + off);
      mesh.normals.push_back(along.cross(Vec3f::UnitY()));
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  Workers one(1), four(4);
  const auto by_one = find_faces(mesh, one), by_four = find_faces(mesh, four);
  EXPECT_EQ(by_one->faces.size(), 20'000U);
  EXPECT_EQ(by_one->face_of, by_four->face_of);
  ASSERT_EQ(by_one->edges.size(), by_four->edges.size());
  ASSERT_GT(by_one->edges.size(), 20'000U);
  for (std::size_t i = 0; i < by_one->edges.size(); ++i) {
    const EdgePart &a = by_one->edges[i], &b = by_four->edges[i];
    EXPECT_EQ(std::tie(a.low, a.high, a.side, a.face), std::tie(b.low, b.high, b.side, b.face));
  }
  for (std::size_t i = 0; i < by_one->faces.size(); ++i) {
    EXPECT_EQ(by_one->faces[i].half, by_four->faces[i].half);
  }
}

// A hit 0.1 m from the middle of a plate of 0.4 x 1 m, turned by a quarter.
TEST(FacesTest, EdgesAreMeasuredFromTheHit) {
  const Mesh plate = make_plane(Vec3::UnitX(), 0.4, 1.0);
  const auto found = find_faces(plate, workers);
  ASSERT_EQ(found->faces.size(), 1U);
  const Face& face = found->faces.front();
  const Vec3f hit(0, 0.1F, -0.3F);
  const Eigen::Matrix3f turn = orientation_from_rpy(0, 0, 1.5707963267948966).toRotationMatrix().cast<float>();
  const FaceEdges edges = FaceEdges::of(face, hit - plate.vertices[face.corner], turn);
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_NEAR(edges.high[axis] - edges.low[axis], 2 * face.half[axis], 1e-5);
    const float along = face.axes[axis].dot(hit);
    EXPECT_NEAR(edges.low[axis], -face.half[axis] - along, 1e-5);
    EXPECT_NEAR(edges.axes[axis].x, -face.axes[axis].y(), 1e-6);
    EXPECT_NEAR(edges.axes[axis].y, face.axes[axis].x(), 1e-6);
  }
}

// Reference values: 2 (C(u)^2 + S(u)^2), u = (a/2) sqrt(2/(lambda rho)), by quadrature of the Fresnel integrals; the
// tolerance is that of their approximation. At 60 degrees in the plane of incidence a side is half as wide.
TEST(FaceReturnTest, IsThatOfFresnelsIntegrals) {
  struct Case {
    float side, frequency, near, across, value;
  };
  for (const Case& c : {Case{0.05F, 720e3F, 10, 5, 0.357450F}, Case{0.1F, 720e3F, 10, 5, 1.284052F},
                        Case{0.2F, 720e3F, 10, 5, 0.820024F}, Case{0.5F, 720e3F, 10, 5, 1.163795F},
                        Case{0.1F, 375e3F, 20, 20, 0.249145F}, Case{0.05F, 1200e3F, 3, 2, 1.428833F}}) {
    const float rho = c.near * c.across / (c.near + c.across), wavelength = 1500 / c.frequency;
    const FaceSide wide{-kWide, kWide, 1, 0, 0};
    const FaceSide side = face_side(-c.side / 2, c.side / 2, 0, 0, 1, 0);
    EXPECT_NEAR(face_return(side, wide, 1, rho, wavelength), c.value, 0.01) << c.side;
    const FaceSide inclined = face_side(-c.side, c.side, 0, std::sqrt(0.75F), 0.5F, 0);
    EXPECT_NEAR(face_return(wide, inclined, 1, rho, wavelength), c.value, 0.01) << c.side;
    EXPECT_NEAR(face_return(side, side, 1, rho, wavelength), c.value * c.value, 0.03) << c.side;
  }
}

// At the edge of a half plane a quarter of the intensity is left; far beyond it next to nothing.
TEST(FaceReturnTest, FallsAtTheEdge) {
  const FaceSide wide{-kWide, kWide, 1, 0, 0};
  EXPECT_NEAR(face_return({0, kWide, 1, 0, 0}, wide, 1, 3, 2e-3F), 0.25, 0.003);
  EXPECT_NEAR(face_return({0.5F, kWide, 1, 0, 0}, wide, 1, 3, 2e-3F), 0, 0.001);
  EXPECT_NEAR(face_return({-0.5F, kWide, 1, 0, 0}, wide, 1, 3, 2e-3F), 1, 0.06);
  EXPECT_NEAR(face_return(wide, wide, 1, 3, 2e-3F), 1, 0.003);
}

// Facets return what of the glint lies on the face: a Gaussian of the rms length 2 rho s along the face at normal
// incidence, about the place where the facet is level that sends sound to the second point. By hand: rho 2, s 0.1: 0.4
// m; a side of 0.4 m: erf(0.5/sqrt 2) = 0.38292. A facet tilted by 0.1 is 2 rho 0.1 = 0.4 m from the middle of the
// glint: (erf(1.5/sqrt 2) - erf(0.5/sqrt 2))/2 = 0.24173.
TEST(FaceReturnTest, OfFacetsIsTheGlintOnTheFace) {
  const FaceSide wide = face_side(-kWide, kWide, 0, 0, 1, 0.1F);
  EXPECT_NEAR(face_return(face_side(-0.2F, 0.2F, 0, 0, 1, 0.1F), wide, 0, 2, 2e-3F), 0.38292, 0.001);
  EXPECT_NEAR(face_return(face_side(-0.2F, 0.2F, 0.1F, 0, 1, 0.1F), wide, 0, 2, 2e-3F), 0.24173, 0.001);
  // Half coherent: the mean of both.
  const float coherent = face_return(face_side(-0.2F, 0.2F, 0, 0, 1, 0.1F), wide, 1, 2, 2e-3F);
  EXPECT_NEAR(face_return(face_side(-0.2F, 0.2F, 0, 0, 1, 0.1F), wide, 0.5F, 2, 2e-3F), 0.5 * (0.38292 + coherent),
              0.001);
}

// The tilts spread a ray into a Gaussian beam, whose peak is that of the far field a/lambda sinc^2: deviations of 2 m
// along the side, of the rms lambda/(sqrt(2 pi) a).
TEST(FaceTiltTest, HasTheWidthOfTheFarField) {
  FaceEdges edges;
  edges.axes = {Triple{0, 1, 0}, Triple{0, 0, 1}};
  edges.low = {-0.05F, -0.3F};
  edges.high = {0.05F, 0.3F};
  edges.finite = true;
  double squares[2] = {};
  constexpr int kSide = 100;
  for (std::uint32_t column = 0; column < kSide; ++column) {
    for (std::uint32_t row = 0; row < kSide; ++row) {
      const FaceTilt drawn = FaceTilt::of(edges, column, row, 5, 2e-3F, 1);
      squares[0] += drawn.tilt.y * drawn.tilt.y;
      squares[1] += drawn.tilt.z * drawn.tilt.z;
    }
  }
  const double rms_y = 2 * std::sqrt(squares[0]) / kSide, rms_z = 2 * std::sqrt(squares[1]) / kSide;
  EXPECT_NEAR(rms_y, 2e-3 / (2.50662827 * 0.1), 0.03 * rms_y);
  EXPECT_NEAR(rms_z, 2e-3 / (2.50662827 * 0.6), 0.03 * rms_z);
}

}  // namespace
}  // namespace insonify::faces_test

// face_glints_test.cpp -- coherent echoes of plane faces against Kirchhoff's integral, summed over the face.

#include "echo/targets/face_glints.h"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>

#include "insonify/mesh.h"

namespace insonify::face_glints_test {
namespace {

Workers workers(2);

constexpr double kPi = std::numbers::pi;

double db(double intensity) {
  return 10 * std::log10(intensity);
}

// |1/lambda sum of cos e^(2 i k r) / r^2 dS|^2 with exact distances, an eighth of a Fresnel zone or less apart.
double summed(const Eigen::Vector2d& foot, const Eigen::Vector2d& half, double distance, double wavelength) {
  const double step = wavelength / 12, wavenumber = 2 * kPi / wavelength;
  const auto along = static_cast<int>(std::ceil(2 * half[0] / step)),
             across = static_cast<int>(std::ceil(2 * half[1] / step));
  const double a_step = 2 * half[0] / along, b_step = 2 * half[1] / across;
  std::complex<double> sum = 0;
  for (int i = 0; i < along; ++i) {
    const double a = -half[0] + (i + 0.5) * a_step - foot[0];
    for (int j = 0; j < across; ++j) {
      const double b = -half[1] + (j + 0.5) * b_step - foot[1];
      const double square = a * a + b * b + distance * distance, range = std::sqrt(square);
      sum += std::polar(distance / (range * square), 2 * wavenumber * range);
    }
  }
  return std::norm(sum * a_step * b_step / wavelength);
}

TEST(FaceGlintTest, IsKirchhoffsIntegral) {
  struct Case {
    double first, second, foot_first, foot_second, distance;
  };
  constexpr double kWavelength = 1500.0 / 400e3;
  for (const Case& c : {Case{0.2, 0.12, 0, 0, 3}, Case{0.2, 0.12, 0.05, -0.02, 3}, Case{0.2, 0.12, 0.1, 0, 3},
                        Case{0.2, 0.12, 0.11, 0.03, 3}, Case{0.05, 0.08, 0, 0.01, 7}, Case{0.05, 0.08, 0.1, 0.05, 7},
                        Case{0.03, 0.03, 0.2, 0, 9}, Case{0.4, 0.3, 0.1, 0.1, 1.2},
                        // Far outside the face, where zones are longer: by 1 dB and more without it.
                        Case{0.012, 0.04, 0.15, 0, 0.3}, Case{0.4, 0.4, 0.5, 0, 1}}) {
    const Eigen::Vector2d foot(c.foot_first, c.foot_second), half(0.5 * c.first, 0.5 * c.second);
    EXPECT_NEAR(db(face_glint(foot, half, c.distance, kWavelength)), db(summed(foot, half, c.distance, kWavelength)),
                0.3)
        << c.first << ", " << c.foot_first << ", " << c.distance;
  }
}

// A plate far beyond its Rayleigh distance has A^2 / lambda^2, a wide wall is a mirror, and a metre plate at 50 m and
// 720 kHz (1500 m/s), 30.29 dB by Fresnel's integrals.
TEST(FaceGlintTest, HasItsLimits) {
  const double wavelength = 1500 / 720e3;
  EXPECT_NEAR(db(face_glint({0, 0}, {0.025, 0.04}, 90, wavelength)) + 40 * std::log10(90),
              20 * std::log10(0.05 * 0.08 / wavelength), 0.05);
  EXPECT_NEAR(db(face_glint({3, -2}, {20, 20}, 8, wavelength)), -20 * std::log10(16), 0.2);
  EXPECT_NEAR(db(face_glint({0, 0}, {0.5, 0.5}, 50, wavelength)) + 40 * std::log10(50), 30.29, 0.05);
}

// Far off its normal by the angle t, a plate of the side a has sinc^2(2 a sin(t) / lambda).
TEST(FaceGlintTest, FallsWithinAFractionOfADegree) {
  const double wavelength = 1500 / 720e3, range = 400, side = 0.1;
  const double ahead = face_glint({0, 0}, {0.5 * side, 0.5 * side}, range, wavelength);
  for (const double degrees : {0.1, 0.2, 0.3, 0.4}) {
    const double angle = degrees * kPi / 180, phase = kPi * 2 * side * std::sin(angle) / wavelength;
    const double tilted =
        face_glint({range * std::sin(angle), 0}, {0.5 * side, 0.5 * side}, range * std::cos(angle), wavelength);
    EXPECT_NEAR(db(tilted / ahead), 20 * std::log10(std::abs(std::sin(phase) / phase)), 0.15) << degrees;
  }
}

Scene scene_of(std::vector<std::pair<Mesh, double>> bodies) {
  Scene scene;
  for (auto& [mesh, rms_height] : bodies) {
    Instance instance;
    instance.name = "body";
    instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
    instance.materials.assign(instance.mesh->material_names.size(), static_cast<std::uint16_t>(scene.materials.size()));
    Material material;
    material.rms_height = rms_height;
    scene.materials.push_back(material);
    scene.instances.push_back(std::move(instance));
  }
  return scene;
}

TEST(GlintingFacesTest, AreThePlaneFacesOfMaterialsThatHaveAHeight) {
  const Scene scene = scene_of({{make_box({1, 2, 3}), 1e-5}, {make_box({1, 1, 1}), 0}, {make_sphere(1, 0.1), 1e-5}});
  LeftOut left_out;
  const GlintingFaces faces = find_glinting_faces(scene, left_out, workers);
  ASSERT_EQ(faces.groups.size(), 1U);
  EXPECT_EQ(faces.groups[0].instance, 0);
  EXPECT_EQ(faces.groups[0].surface.size(), 6U);
  float area = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    area += 4 * faces.groups[0].first_half[i] * faces.groups[0].second_half[i];
  }
  EXPECT_NEAR(area, 22, 1e-4);
  EXPECT_EQ(*left_out.glinting[0], std::vector<std::uint8_t>(12, 1));
  EXPECT_EQ(left_out.glinting[1], nullptr);
  EXPECT_EQ(left_out.glinting[2], nullptr);
}

TEST(GlintingFacesTest, ThinPartsAreNone) {
  const Scene scene = scene_of({{make_box({1, 1, 1}), 1e-5}});
  LeftOut left_out;
  left_out.thickness = {std::make_shared<const std::vector<float>>(12, 0.02F)};
  EXPECT_FALSE(find_glinting_faces(scene, left_out, workers).any());
}

}  // namespace
}  // namespace insonify::face_glints_test

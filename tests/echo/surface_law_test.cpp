// surface_law_test.cpp -- energy and densities of the sound that surfaces send on to random walks.

#include "echo/walks/surface_law.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/philox.h"
#include "echo/laws/laws.h"

namespace insonify::surface_law_test {
namespace {

constexpr double kPi = std::numbers::pi;

Vec3f direction_of(double cosine, double azimuth) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return Vec3(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine).cast<float>();
}

// Integral of a density over the hemisphere, by the midpoint rule in cosine and azimuth.
template <typename Density>
double integral(const Density& density, double first_cosine = 0, double last_cosine = 1) {
  constexpr int kCosines = 600, kAzimuths = 600;
  double sum = 0;
  for (int i = 0; i < kCosines; ++i) {
    const double cosine = first_cosine + (last_cosine - first_cosine) * (i + 0.5) / kCosines;
    for (int j = 0; j < kAzimuths; ++j) {
      sum += density(direction_of(cosine, 2 * kPi * (j + 0.5) / kAzimuths));
    }
  }
  return sum * (last_cosine - first_cosine) / kCosines * 2 * kPi / kAzimuths;
}

// Sound that comes down at an angle of incidence.
Vec3f coming_in(double cosine) {
  return -direction_of(cosine, 0.3);
}

const Vec3f kUp = Vec3f::UnitZ();

TEST(SurfaceLawTest, SharesAreThoseOfTheMaterial) {
  const SurfaceLaw law = SurfaceLaw::of({.lambert = 0.05, .reflection = 0.6, .rms_slope = 0.25}, 1);
  EXPECT_NEAR(law.diffuse, 0.157080, 1e-6);  // pi 0.05
  EXPECT_NEAR(law.mirrored, 0.36, 1e-6);
  EXPECT_NEAR(law.slope, 0.25, 1e-6);
  const SurfaceLaw faint = SurfaceLaw::of({.lambert = 0.05, .reflection = 0.6, .rms_slope = 0.02}, 0.5F);
  EXPECT_NEAR(faint.diffuse, 0.0392699, 1e-6);  // A texture of 1/2 is a quarter of the energy.
  EXPECT_NEAR(faint.mirrored, 0.09, 1e-6);
  EXPECT_NEAR(faint.slope, kLeastWalkSlope, 1e-6);
}

TEST(SurfaceLawTest, NoSurfaceSendsOutMoreThanFallsOnIt) {
  const SurfaceLaw law = SurfaceLaw::of({.lambert = 0.25, .reflection = 0.9, .rms_slope = 0.2}, 1.2F);
  EXPECT_NEAR(law.diffuse + law.mirrored, 1, 1e-6);
  EXPECT_NEAR(law.diffuse / law.mirrored, kPi * 0.25 / 0.81, 1e-5);
}

TEST(SurfaceLawTest, DiffuseSoundHasItsEnergy) {
  const SurfaceLaw law{.diffuse = 0.37F};
  EXPECT_NEAR(integral([&](const Vec3f& out) { return law.diffuse_into(kUp, out); }), 0.37, 1e-4);
  EXPECT_EQ(law.diffuse_into(kUp, -direction_of(0.4, 1)), 0);
}

// Sum over facets of the slopes p and q: each shows the sound the area (i.m) / ((i.n)(m.n)) = (i.z - p i.x - q i.y) /
// i.z, less what others mask, and reflects the share of it that belongs to i.m, the cosine of incidence on the facet.
// Smith's function as it is, 2 / (1 + erf(a) + exp(-a^2) / (a sqrt(pi))), a = cot(incidence) / (sqrt(2) slope).
template <typename Reflectance>
double energy_of_facets(const Reflectance& reflectance, double slope, const Vec3f& in) {
  const Vec3 i = -in.cast<double>();
  const double a = i.z() / (std::sqrt(1 - i.z() * i.z()) * std::sqrt(2) * slope);
  const double seen = 2 / (1 + std::erf(a) + std::exp(-a * a) / (a * std::sqrt(kPi)));
  constexpr int kSteps = 1000;
  double sum = 0;
  for (int k = 0; k < kSteps; ++k) {
    for (int l = 0; l < kSteps; ++l) {
      const double p = (k + 0.5) / kSteps * 12 - 6, q = (l + 0.5) / kSteps * 12 - 6;  // [slope]
      const Vec3 m = Vec3(-slope * p, -slope * q, 1).normalized();
      sum += i.dot(m) > 0
                 ? reflectance(i.dot(m)) * std::exp(-0.5 * (p * p + q * q)) / (2 * kPi) * i.dot(m) / (i.z() * m.z())
                 : 0;
    }
  }
  return seen * sum * std::pow(12.0 / kSteps, 2);
}

// The approximation of Smith's function is within 0.4 %, the integral within 0.1 %.
TEST(SurfaceLawTest, MirroredSoundHasTheEnergyThatFacetsReflect) {
  for (const double slope : {0.1, 0.3}) {
    const SurfaceLaw law{.mirrored = 0.8F, .slope = static_cast<float>(slope)};
    for (const double cosine : {0.999, 0.8, 0.5, 0.2}) {
      const Vec3f in = coming_in(cosine);
      const double expected = energy_of_facets([](double) { return 0.8; }, slope, in);
      EXPECT_NEAR(integral([&](const Vec3f& out) { return law.mirrored_into(kUp, in, out); }), expected, 0.005 * 0.8)
          << slope << ", " << cosine;
      EXPECT_NEAR(expected, 0.8, 0.001);
    }
  }
}

// A bed that reflects everything at grazing angles below 30 degrees, as sand does below its critical angle, and a tenth
// above.
Scattering bed(double slope, double lambert = 0) {
  auto by_angle = std::make_shared<AngularScattering>();
  by_angle->reflectance = AngleTable([&](double cosine) { return cosine < 0.5 ? 1 - kPi * lambert : 0.1; });
  return {.lambert = lambert, .reflection = std::sqrt(0.1), .rms_slope = slope, .by_angle = by_angle};
}

// At 10 degrees of grazing the mean plane reflects all and many facets of the slope 0.35 a tenth; at 40 degrees the
// mean plane reflects a tenth and some facets all. Tolerance: as above, and the table's step at the critical angle.
TEST(SurfaceLawTest, FacetsReflectAtTheirOwnAngleOfIncidence) {
  const Scattering sand = bed(0.35);
  for (const double grazing : {0.17453, 0.69813}) {
    const Vec3f in = coming_in(std::sin(grazing));
    const SurfaceLaw law = SurfaceLaw::of(sand, 1, in.z());
    const double expected = energy_of_facets([](double cosine) { return cosine < 0.5 ? 1 : 0.1; }, 0.35, in);
    EXPECT_NEAR(integral([&](const Vec3f& out) { return law.mirrored_into(kUp, in, out); }), expected, 0.006)
        << grazing;
  }
  // By the angle on the mean plane it would be 1 and 0.1: so the test can fail.
  const auto expected_at = [](double grazing) {
    return energy_of_facets([](double cosine) { return cosine < 0.5 ? 1 : 0.1; }, 0.35, coming_in(std::sin(grazing)));
  };
  EXPECT_LT(expected_at(0.17453), 0.7);
  EXPECT_GT(expected_at(0.69813), 0.2);
}

// What a surface sends on to where sound came from is what it would send the other way: f(in, out) cos(in), without the
// masking of the incident sound, which is of one direction alone.
TEST(SurfaceLawTest, FacetsReflectTheSameBothWays) {
  const Scattering sand = bed(0.1, 0.02);
  const Vec3f here = direction_of(0.3, 0.2), there = direction_of(0.55, 0.4 + kPi);  // On both sides of 30 degrees.
  const auto sent = [&](const Vec3f& from, const Vec3f& to) {
    const SurfaceLaw law = SurfaceLaw::of(sand, 1, from.z());
    return law.mirrored_into(kUp, -from, to) * from.z() / facet_masking(from.z(), law.slope);
  };
  EXPECT_NEAR(sent(here, there), sent(there, here), 1e-4 * sent(here, there));
  EXPECT_GT(sent(here, there), 0.01);
}

// s_b(in, out) / cos(in) of the calibrated model, at normal incidence, where nothing is masked: |R|^2/(8 pi s^2 cos^4
// b) exp(-tan^2 b / (2 s^2)), b half the angle to the normal.
TEST(SurfaceLawTest, MirroredSoundFollowsTheFacetLobe) {
  const SurfaceLaw law{.mirrored = 0.5F, .slope = 0.2F};
  const double b = 0.15;
  const double expected =
      0.5 / (8 * kPi * 0.04 * std::pow(std::cos(b), 4)) * std::exp(-std::pow(std::tan(b), 2) / (2 * 0.04));
  EXPECT_NEAR(law.mirrored_into(kUp, -kUp, direction_of(std::cos(2 * b), 2)), expected, 1e-4 * expected);
}

// Energy and number of draws in four rings of directions, against the integrals of the densities. 200 000 draws;
// tolerance four standard deviations of the sum, from the squares of the shares.
void expect_draws_to_follow_the_densities(const SurfaceLaw& law, const Vec3f& in) {
  constexpr int kDraws = 200'000, kRings = 4;
  std::array<double, kRings> sum{}, square{}, mirrored{}, drawn{};
  for (std::uint32_t i = 0; i < kDraws; ++i) {
    const PhiloxCounter words = philox({i, 1, 2, 3}, {4, 5});
    const SurfaceLaw::Next next =
        law.draw(kUp, in, uniform_open(words[0]), uniform_open(words[1]), uniform_open(words[2]));
    if (next.share > 0) {
      ASSERT_NEAR(next.direction.norm(), 1, 1e-5);
      ASSERT_GT(next.direction.z(), 0);
      const int ring = std::min(static_cast<int>(next.direction.z() * kRings), kRings - 1);
      sum[ring] += next.share / kDraws;
      square[ring] += std::pow(next.share / kDraws, 2);
      mirrored[ring] += next.mirrored ? next.share / kDraws : 0;
      drawn[ring] += 1.0 / kDraws;
    }
  }
  for (int ring = 0; ring < kRings; ++ring) {
    const double low = static_cast<double>(ring) / kRings, high = static_cast<double>(ring + 1) / kRings;
    const double mirror = integral([&](const Vec3f& out) { return law.mirrored_into(kUp, in, out); }, low, high);
    const double both = mirror + integral([&](const Vec3f& out) { return law.diffuse_into(kUp, out); }, low, high);
    EXPECT_NEAR(sum[ring], both, 4 * std::sqrt(square[ring])) << -in.z() << ", ring " << ring;
    EXPECT_NEAR(mirrored[ring], mirror, 4 * std::sqrt(square[ring])) << -in.z() << ", ring " << ring;
    const double expected = integral([&](const Vec3f& out) { return law.density(kUp, in, out); }, low, high);
    EXPECT_NEAR(drawn[ring], expected, 4 * std::sqrt(expected / kDraws)) << -in.z() << ", ring " << ring;
  }
}

TEST(SurfaceLawTest, DrawsFollowTheDensities) {
  for (const double cosine : {0.95, 0.6, 0.25}) {
    expect_draws_to_follow_the_densities({.diffuse = 0.3F, .mirrored = 0.45F, .slope = 0.3F}, coming_in(cosine));
  }
}

TEST(SurfaceLawTest, DrawsFollowTheDensitiesOfFacetsThatReflectByAngle) {
  const Scattering sand = bed(0.3, 0.04);
  for (const double cosine : {0.95, 0.6, 0.25}) {
    expect_draws_to_follow_the_densities(SurfaceLaw::of(sand, 1, static_cast<float>(cosine)), coming_in(cosine));
  }
}

}  // namespace
}  // namespace insonify::surface_law_test

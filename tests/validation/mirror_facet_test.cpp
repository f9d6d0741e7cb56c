// mirror_facet_test.cpp -- the random facets by which a rough mirror reflects rays.

#include "echo/laws/laws.h"
#include "echo/mirror/mirror_paths.h"
#include "validation/secondary_grid.h"

namespace insonify::validation::mirror_facet_test {
namespace {

// The two slopes of a facet are independent standard normal numbers, in every block of the lattice.
TEST(FacetSlopesTest, AreNormalAndIndependent) {
  for (const int size : {16, 128}) {
    double sum[2] = {}, squares[2] = {}, both = 0, within = 0;
    for (int column = 100; column < 100 + size; ++column) {
      for (int row = 30; row < 30 + size; ++row) {
        const FacetSlopes slopes = facet_slopes(column, row, 12345);
        const double pair[] = {slopes.along, slopes.across};
        for (int i = 0; i < 2; ++i) {
          sum[i] += pair[i];
          squares[i] += pair[i] * pair[i];
          within += std::abs(pair[i]) < 1 ? 0.5 : 0;
        }
        both += pair[0] * pair[1];
      }
    }
    const double count = size * size, tolerance = 1.0 / size;
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(sum[i] / count, 0, tolerance) << size;
      EXPECT_NEAR(squares[i] / count, 1, 2 * tolerance) << size;
    }
    EXPECT_NEAR(both / count, 0, tolerance) << size;
    EXPECT_NEAR(within / count, 0.6827, tolerance) << size;
  }
}

// The mean share is the fraction of the incident energy that facets reflect away from the mirror; the rest is reflected
// into it. Reference values: quadrature over slopes with Smith's exact masking function (Smith, IEEE Trans. AP-15, 668
// (1967)), computed independently.
TEST(MirrorFacetTest, SharesSumToTheReflectedFraction) {
  struct Case {
    double slope, grazing_deg, reflected;
  };
  for (const Case& c : {Case{0.02, 5, 0.9939}, Case{0.02, 40, 1}, Case{0.1, 5, 0.9665}, Case{0.1, 15, 0.9670},
                        Case{0.1, 90, 1}, Case{0.3, 5, 0.9911}, Case{0.3, 15, 0.9579}, Case{0.3, 40, 0.9412}}) {
    const double grazing = c.grazing_deg * kDegree;
    const Triple direction{static_cast<float>(std::cos(grazing)), 0, static_cast<float>(-std::sin(grazing))};
    double sum = 0;
    constexpr int kSide = 300;
    for (int i = 0; i < kSide * kSide; ++i) {
      const FacetSlopes slopes = facet_slopes(i / kSide, i % kSide, 7);
      const MirrorFacet facet = mirror_facet(direction, {0, 0, 1}, {}, static_cast<float>(c.slope), slopes, {});
      sum += facet.share;
      ASSERT_NEAR(dot(facet.normal, facet.normal), 1, 1e-5);
    }
    EXPECT_NEAR(sum / (kSide * kSide), c.reflected, 0.01) << c.slope << ", " << c.grazing_deg;
  }
}

// Reference values: e^-g with g = 4 k^2 h^2 cos^2 (Brekhovskikh and Lysanov, ch. 9) and c = 1500 m/s, by hand: at 720
// kHz k is 3015.9 per m, so that 0.1 mm at normal incidence has g = 0.36383 and 1.5801 dB.
TEST(FacetSlopeTest, ReflectsTheCoherentShareAsASmoothMirror) {
  struct Case {
    double frequency, height, incidence_deg, loss_db;
  };
  for (const Case& c :
       {Case{720e3, 0.1e-3, 0, 1.5801}, Case{720e3, 0.3e-3, 0, 14.2210}, Case{720e3, 0.3e-3, 60, 3.5552},
        Case{375e3, 0.3e-3, 0, 3.8577}, Case{1200e3, 0.1e-3, 30, 3.2919}, Case{100e3, 2e-3, 75, 0.8167}}) {
    Material material = glinting(1, 0.1);
    material.rms_height = c.height;
    const auto roughness = static_cast<float>(material.scattering(c.frequency).roughness);
    constexpr int kPicks = 200000;
    int smooth = 0;
    for (int i = 0; i < kPicks; ++i) {
      const float pick = (static_cast<float>(i) + 0.5F) / kPicks;
      smooth += facet_slope(0.1F, roughness, static_cast<float>(std::cos(c.incidence_deg * kDegree)), pick) == 0;
    }
    EXPECT_NEAR(-10 * std::log10(static_cast<double>(smooth) / kPicks), c.loss_db, 0.002) << c.height;
  }
}

// The variance of all orders together is that of the roughness, whatever its height; above g = 8 of every order. Orders
// beyond the last of sixteen have 0.4 % of the energy, and count as the last.
TEST(FacetSlopeTest, VariancesSumToThatOfTheRoughness) {
  for (const float g : {0.02F, 0.4F, 2.0F, 7.9F, 8.1F, 300.0F}) {
    constexpr int kPicks = 200000;
    double sum = 0;
    for (int i = 0; i < kPicks; ++i) {
      const float slope = facet_slope(0.05F, 4 * g, 0.5F, (static_cast<float>(i) + 0.5F) / kPicks);
      sum += slope * slope;
    }
    EXPECT_NEAR(sum / kPicks / (0.05 * 0.05), 1, 0.005) << g;
  }
  EXPECT_EQ(facet_slope(0.05F, 0, 1, 0.999F), 0);
  EXPECT_EQ(facet_slope(0.05F, kAllRough, 0.3F, 1e-4F), 0.05F);
}

// Engines differ in the sign of zero components of normals; it must not matter.
TEST(MirrorFacetTest, TheSignOfZeroDoesNotMatter) {
  const Triple direction{0.8F, 0.6F, 0};
  const MirrorFacet a = mirror_facet(direction, {-1, 0, 0.0F}, {}, 0.1F, {0.7F, -0.4F, 0.5F}, {});
  const MirrorFacet b = mirror_facet(direction, {-1, 0, -0.0F}, {}, 0.1F, {0.7F, -0.4F, 0.5F}, {});
  EXPECT_EQ(a.share, b.share);
  EXPECT_EQ(a.normal.y, b.normal.y);
  EXPECT_EQ(a.normal.z, b.normal.z);
}

// A relief that slopes away from the sonar, on a level bed at 10 degrees of grazing. Rays that leave the tilted surface
// but would go below the bed are not reflected.
TEST(MirrorFacetTest, NothingIsReflectedThroughASurfaceWithRelief) {
  const auto degrees = [](double angle) { return static_cast<float>(angle * kDegree); };
  const Triple direction{std::cos(degrees(10)), 0, -std::sin(degrees(10))};
  const float away = std::tan(degrees(3)), scale = 1 / std::sqrt(1 + away * away);
  const Triple bent{scale * away, 0, scale};  // (0, 0, 1) less the gradient, normalised.
  const Triple gradient{-away, 0, 0};
  int reflected = 0;
  for (int row = 0; row < 4000; ++row) {
    const MirrorFacet facet = mirror_facet(direction, bent, gradient, 0.05F, facet_slopes(1, row, 3), {});
    if (facet.share > 0) {
      ++reflected;
      EXPECT_GT(direction.z - 2 * dot(direction, facet.normal) * facet.normal.z, -1e-6F);
    }
  }
  EXPECT_GT(reflected, 2000);
  EXPECT_LT(reflected, 4000);
}

// The share is that of the facet by which the ray goes out, also where the sound returns over the mirror: it counts
// once.
TEST(MirrorFacetTest, ShareCountsOnceForBothWays) {
  Material material = diffuse(-10);
  const ScatterTable scatter(std::span(&material, 1), 720e3);
  MirrorPaths paths = {};
  std::ranges::fill(paths.surface, surface_label(0, 0));
  for (int lane = 0; lane < kPathLanes; ++lane) {
    paths.reflectance[lane] = paths.spread[lane] = paths.texture[lane] = 1;
    paths.there[lane] = paths.back[lane] = 5;
    paths.arriving[lane] = paths.leaving[lane] = paths.between[lane] = 1;
    paths.returned[lane] = 1;
    paths.share[lane] = lane == 0 ? 1.0F : 0.5F;
  }
  MirrorPowers powers;
  fill_mirror_powers(scatter, 0, paths, powers);
  ASSERT_GT(powers.twice[0], 0);
  EXPECT_FLOAT_EQ(powers.once[1], 0.5F * powers.once[0]);
  EXPECT_FLOAT_EQ(powers.twice[1], 0.5F * powers.twice[0]);
}

// The side to which the surface normal points does not matter, and the tangent frame is valid for all directions.
TEST(MirrorFacetTest, FacesTheSideOfTheSound) {
  for (const Triple& normal : {Triple{0, 0, 1}, Triple{0, 0, -1}, Triple{1, 0, 0}, Triple{0, -1, 0}}) {
    for (const float side : {1.0F, -1.0F}) {
      const MirrorFacet facet = mirror_facet(-1 * normal, side * normal, {}, 0.1F, {0.5F, -0.3F, 0.5F}, {});
      EXPECT_NEAR(dot(facet.normal, normal), 1 / std::sqrt(1 + 0.01F * (0.25F + 0.09F)), 1e-6F);
      EXPECT_GT(facet.share, 0);
    }
  }
}

}  // namespace
}  // namespace insonify::validation::mirror_facet_test

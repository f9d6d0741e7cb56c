// echo_laws_test.cpp -- the laws of echoes against values worked out by hand, and the vector loops of the engines
// against the same laws in double precision, over all materials and angles.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "echo/mirror/mirror_paths.h"
#include "echo/mirror/secondary_echo.h"
#include "echo/model/hit_column.h"
#include "echo/model/precise_echoes.h"
#include "insonify/acoustics/backscatter.h"
#include "insonify/acoustics/surface_scattering.h"
#include "insonify/sea_surface.h"

namespace insonify::echo_laws_test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFrequency = 720e3;

// Relative error of the vector loops: a dozen roundings of single precision, and exponents of up to 30 that are rounded
// to 6e-8 of themselves.
constexpr double kRelative = 1e-5;

// A steep lobe is sensitive to the rounding of 1 / cos^2 in its exponent: 6e-8, three times over.
constexpr double kExponentRounding = 2e-7;

// fast_exp() is never less than e^-87, also where e^x is 0. In the largest lobe (slope 0.005) at the least cosine,
// 0.01, that leaves e^-87 |R|^2 / (8 pi 0.005^2 x 0.01^5) = 2.6e-25.
constexpr double kFloor = 1e-24;

double tolerance(double expected, double rms_slope, double least_cosine) {
  const double held = std::max(least_cosine, double{kLeastCosine});
  const double exponent = 1 / (2 * rms_slope * rms_slope * held * held);
  return expected * (kRelative + kExponentRounding * exponent) + kFloor;
}

// The library's materials, and those at the limits of what a material may be.
std::vector<Material> all_materials() {
  std::vector<Material> materials(material_library().begin(), material_library().end());
  for (const double rms_slope : {0.005, 0.02, 0.3, 1.0}) {
    for (const double lambert_db : {-200.0, -27.0, kGreatestLambertDb}) {
      for (const double reflection : {0.0, 0.01, 1.0}) {
        Material material;
        material.rms_slope = rms_slope;
        material.lambert_db = lambert_db;
        material.reflection = reflection;
        materials.push_back(material);
      }
    }
  }
  return materials;
}

// From edge-on to normal incidence, dense at both ends; single precision, as engines have them.
std::vector<float> all_cosines() {
  std::vector<float> cosines = {0, 1e-6F, 1e-3F, 0.00999F, 0.01F, 0.0101F, 0.999999F, 0.9999999F, 1};
  for (double angle = 0; angle < 0.5 * kPi; angle += 0.01) {
    cosines.push_back(static_cast<float>(std::cos(angle)));
  }
  return cosines;
}

// The arguments of mirror_intensities(), with usual values.
struct Path {
  Scattering mirror, second;
  double incidence = 1;  // Cosine of incidence on the mirror.
  double mirror_texture = 1, second_texture = 1;
  double share = 1, there = 0, back = 0, spread = 1, returned = 1;
  double in = 1, out = 1, half = 1;  // SecondAngles
  std::optional<double> glint = {};  // FacetReturn; `in` without facets.
  double variance = 0, coherence = 1;
  double facet = 1;  // SecondAngles
};

precise::MirrorIntensities intensities_of(const Path& path, double neper_per_metre) {
  const precise::SecondAngles at = {path.in, path.out, path.half, path.facet};
  return precise::mirror_intensities(
      {.reflectance = precise::mirrored_by(path.mirror, path.incidence) * path.mirror_texture * path.mirror_texture,
       .share = path.share,
       .there = path.there,
       .back = path.back,
       .spread = path.spread,
       .returned = path.returned,
       .at = at,
       .texture = path.second_texture,
       .over = {path.glint.value_or(path.in), path.variance, path.coherence}},
      precise::second_surface_of(path.second, at, path.mirror.rms_slope), neper_per_metre);
}

// At normal incidence with mu = 0.01, |R| = 0.5, s = 0.1: s_b = 0.01 + 0.25 / (8 pi 0.01) = 1.004718. At 10 m with
// gamma = 0.02 Np/m: x e^-0.8 / 100 = 0.00451450; texture 0.5 leaves a quarter.
TEST(EchoLawsTest, PrimaryIntensityAtNormalIncidence) {
  const Scattering surface{.lambert = 0.01, .reflection = 0.5, .rms_slope = 0.1};
  EXPECT_NEAR(precise::primary_intensity_of(surface, 1, 1, 0.02, 10), 0.0045145, 1e-7);
  EXPECT_NEAR(precise::primary_intensity_of(surface, -1, 0.5, 0.02, 10), 0.0045145 / 4, 1e-7);
  EXPECT_EQ(precise::primary_intensity_of(surface, 0, 1, 0.02, 10), 0);
}

// Two planes in a right-angled corner, both hit at 45 degrees, the path back along the path out: the half vector is the
// normal of the second surface only for `once`. Lambert with mu = 0.1 at cos 45 both ways, lobe left out by |R| = 0 of
// the second surface: once = 0.81 x 0.1 x cos 45 / 5^2.
TEST(EchoLawsTest, LambertEchoByAMirror) {
  const double cosine = std::sqrt(0.5);
  const Path path{.mirror = {.lambert = 0, .reflection = 0.9, .rms_slope = 0.1},
                  .second = {.lambert = 0.1, .reflection = 0, .rms_slope = 0.1},
                  .there = 10,
                  .back = 5,
                  .in = cosine,
                  .out = cosine};
  const precise::MirrorIntensities intensities = intensities_of(path, 0);
  EXPECT_NEAR(intensities.once, 0.81 * 0.1 * cosine / 25, 1e-15);
  EXPECT_NEAR(intensities.twice, 0.81 * 0.81 * 0.1 * cosine / 100, 1e-15);
  Path other_side = path;
  other_side.out = -cosine;
  EXPECT_EQ(intensities_of(other_side, 0).once, 0);
}

TEST(EchoLawsTest, LobeOfAReciprocalPathCountsOnceInAll) {
  const Scattering smooth{.lambert = 0, .reflection = 0.9, .rms_slope = 0.05};
  const Scattering rough{.lambert = 0, .reflection = 0.9, .rms_slope = 0.2};
  const auto once = [](const Scattering& mirror, const Scattering& second) {
    return intensities_of({.mirror = mirror, .second = second, .there = 10, .back = 5}, 0).once;
  };
  EXPECT_EQ(once(rough, smooth), 0);
  EXPECT_NEAR(once(smooth, rough), 0.81 * facet_backscatter(0.9, 0.2, 0) / 25, 1e-12);
  EXPECT_NEAR(once(smooth, smooth), 0.5 * 0.81 * facet_backscatter(0.9, 0.05, 0) / 25, 1e-12);
}

// A quarter returns as from a smooth mirror, to the lobe of 0.1 at 8 degrees; the rest finds slopes of 0.2 there. With
// tan^2 = .019751: |R|^2/(8 pi s^2 cos^4) exp(-tan^2/2s^2) = .81 x .9806^-2 x (3.97887 x .372475 | .994718 x .781221).
TEST(EchoLawsTest, LobeTowardsARoughMirrorIsWidened) {
  const Scattering mirror{.lambert = 0, .reflection = 1, .rms_slope = 0.05};
  const Scattering second{.lambert = 0, .reflection = 0.9, .rms_slope = 0.1};
  const Path path{.mirror = mirror,
                  .second = second,
                  .there = 10,
                  .glint = std::cos(8 * std::numbers::pi / 180),
                  .variance = 0.03,
                  .coherence = 0.25};
  EXPECT_NEAR(intensities_of(path, 0).twice, 0.81 * 1.03989 * (0.25 * 1.48203 + 0.75 * 0.777095) / 100, 1e-7);
}

// The sea's table takes off what its lobe has too much: never more than the lobe, wherever that is looked up and
// however wide it is, in both forms.
TEST(EchoLawsTest, TheSeaNeverScattersLessThanNothingTowardsAMirror) {
  for (const double wind_speed : {1.0, 3.0, 8.0, 15.0}) {
    std::vector<Material> materials = {sea_surface_material({.level = 0, .wind_speed = wind_speed}, kFrequency),
                                       Material()};
    materials[1].rms_slope = 0.05;
    const ScatterTable table(materials, kFrequency);
    const Scattering sea = materials[0].scattering(kFrequency);
    ASSERT_TRUE(sea.by_angle);
    for (const float in : {0.9999F, 0.98F, 0.9F, 0.6F, 0.2F, 0.05F}) {
      MirrorPaths paths = {};
      std::vector<Path> expected;
      for (int lane = 0; lane < kPathLanes; ++lane) {
        const float glint = 1 - static_cast<float>(lane) / (2 * kPathLanes), variance = lane % 3 == 0 ? 0.0F : 0.05F;
        paths.reflectance[lane] = paths.share[lane] = paths.texture[lane] = paths.returned[lane] = paths.spread[lane] =
            1;
        paths.there[lane] = paths.back[lane] = 10;
        paths.arriving[lane] = paths.leaving[lane] = paths.between[lane] = paths.facet[lane] = in;
        paths.glint[lane] = lane == 0 ? in : glint;
        paths.variance[lane] = variance;
        paths.coherence[lane] = lane % 2 == 0 ? 0.3F : 0.0F;
        paths.steepness[lane] = table.steepness(surface_label(0, 1));
        paths.surface[lane] = surface_label(0, 0);
        expected.push_back({.mirror = {.lambert = 0, .reflection = 1, .rms_slope = 0.05},
                            .second = sea,
                            .there = 10,
                            .back = 10,
                            .in = in,
                            .out = in,
                            .half = in,
                            .glint = paths.glint[lane],
                            .variance = variance,
                            .coherence = paths.coherence[lane],
                            .facet = in});
      }
      MirrorPowers powers;
      fill_mirror_powers(table, 0, paths, powers);
      for (int lane = 0; lane < kPathLanes; ++lane) {
        const double twice = intensities_of(expected[lane], 0).twice;
        EXPECT_GE(twice, 0) << wind_speed << ' ' << in << ' ' << lane;
        EXPECT_NEAR(powers.twice[lane], twice, 1e-4 * twice + 1e-12) << wind_speed << ' ' << in << ' ' << lane;
      }
      // Along the way out, and not widened, it is the sea's own backscatter.
      const double own = sea_surface_backscatter(std::asin(in), kFrequency, wind_speed);
      EXPECT_NEAR(intensities_of(expected[0], 0).twice * in * 100 / own, 1, 0.05) << wind_speed << ' ' << in;
    }
  }
}

TEST(EchoLawsTest, VectorLoopHasThePrimaryIntensities) {
  const std::vector<Material> materials = all_materials();
  const ScatterTable table(materials, kFrequency);
  const std::vector<float> cosines = all_cosines();
  const auto rows = static_cast<int>(cosines.size());
  HitStrip strip(1, rows);
  HitColumn hits = strip.column(0);
  hits.has_relief = true;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    for (const auto& [range, gamma] : {std::pair{1.0F, 0.0F}, std::pair{23.7F, 0.026F}, std::pair{150.0F, 0.026F}}) {
      for (int row = 0; row < rows; ++row) {
        hits.surface[row] = surface_label(3, static_cast<std::uint16_t>(m));
        hits.facing[row] = row % 2 == 0 ? cosines[row] : -cosines[row];
        hits.range[row] = range;
        hits.texture[row] = row % 3 == 0 ? 1.0F : 0.7F;
      }
      table.fill_powers(rows, gamma, hits);
      const Scattering surface = materials[m].scattering(kFrequency);
      for (int row = 0; row < rows; ++row) {
        const double expected =
            precise::primary_intensity_of(surface, hits.facing[row], hits.texture[row], gamma, range);
        EXPECT_NEAR(hits.power[row], expected, tolerance(expected, surface.rms_slope, cosines[row]))
            << materials[m].name << ", material " << m << ", cosine " << hits.facing[row] << ", range " << range;
      }
    }
  }
}

TEST(EchoLawsTest, VectorLoopGivesNothingWhereNothingWasMet) {
  const std::vector<Material> materials(1);
  const ScatterTable table(materials, kFrequency);
  HitStrip strip(1, 1);
  HitColumn hits = strip.column(0);
  hits.surface[0] = kNoSurface;
  hits.facing[0] = 0.5F;
  table.fill_powers(1, 0.02F, hits);
  EXPECT_EQ(hits.power[0], 0);
}

// All pairs of a mirror and a second surface among materials that differ in smoothness, all combinations of cosines.
TEST(EchoLawsTest, VectorLoopHasTheMirrorIntensities) {
  std::vector<Material> materials;
  for (const double rms_slope : {0.005, 0.1, 1.0}) {
    for (const double reflection : {0.05, 0.9}) {
      Material material;
      material.rms_slope = rms_slope;
      material.lambert_db = reflection < 0.1 ? -40 : -12;
      material.reflection = reflection;
      material.rms_height = reflection < 0.1 ? 0 : 1e-4;
      materials.push_back(material);
    }
  }
  const ScatterTable table(materials, kFrequency);
  constexpr float kGamma = 0.026F;
  constexpr float kIncidence = 0.85F, kFacet = 0.6F;
  constexpr float kCosines[] = {1, 0.9999F, 0.97F, 0.7F, 0.3F, 0.1F, 0.0101F, 0.009F, 1e-4F, 0};
  std::vector<Path> expected;
  MirrorPaths paths = {};
  const auto compare = [&] {
    MirrorPowers powers;
    fill_mirror_powers(table, kGamma, paths, powers);
    for (std::size_t lane = 0; lane < expected.size(); ++lane) {
      const Path& path = expected[lane];
      const precise::MirrorIntensities intensities = intensities_of(path, double{kGamma});
      const double slope = path.second.rms_slope;
      EXPECT_NEAR(powers.once[lane], intensities.once, tolerance(intensities.once, slope, std::abs(path.half)))
          << path.in << ' ' << path.out << ' ' << path.half << ' ' << path.mirror.rms_slope << ' ' << slope;
      const double least = std::min(std::abs(path.in), std::abs(path.glint.value_or(path.in)));
      EXPECT_NEAR(powers.twice[lane], intensities.twice, tolerance(intensities.twice, slope, least))
          << path.in << ' ' << path.out << ' ' << path.half << ' ' << path.mirror.rms_slope << ' ' << slope;
    }
    expected.clear();
  };
  for (std::uint16_t mirror = 0; mirror < materials.size(); ++mirror) {
    for (std::uint16_t second = 0; second < materials.size(); ++second) {
      for (const float in : kCosines) {
        for (const float out : kCosines) {
          for (const float half : kCosines) {
            const std::size_t lane = expected.size();
            const float side = lane % 2 == 0 ? 1.0F : -1.0F, other_side = lane % 5 == 0 ? -side : side;
            const float texture = 0.8F, spread = lane % 4 == 0 ? 0.003F : 1.7F;
            paths.reflectance[lane] = table.mirrored(mirror, kIncidence) * texture * texture;
            paths.share[lane] = 0.9F;
            paths.steepness[lane] = table.steepness(mirror);
            paths.returned[lane] = lane % 3 == 0 ? 1.0F : 0.3F;
            paths.there[lane] = 12.5F;
            paths.back[lane] = 7.25F;
            paths.spread[lane] = spread;
            paths.arriving[lane] = side * in;
            paths.leaving[lane] = other_side * out;
            paths.between[lane] = side * half;
            paths.facet[lane] = kFacet;
            const bool facets = lane % 3 == 1;
            paths.glint[lane] = facets ? half : paths.arriving[lane];
            paths.variance[lane] = facets ? 0.02F : 0.0F;
            paths.coherence[lane] = facets ? 0.4F : 1.0F;
            paths.texture[lane] = 0.6F;
            paths.surface[lane] = surface_label(1, second);
            expected.push_back({.mirror = materials[mirror].scattering(kFrequency),
                                .second = materials[second].scattering(kFrequency),
                                .incidence = kIncidence,
                                .mirror_texture = texture,
                                .second_texture = 0.6F,
                                .share = 0.9F,
                                .there = 12.5,
                                .back = 7.25,
                                .spread = spread,
                                .returned = double{paths.returned[lane]},
                                .in = side * in,
                                .out = other_side * out,
                                .half = side * half,
                                .glint = facets ? std::optional<double>(half) : std::nullopt,
                                .variance = paths.variance[lane],
                                .coherence = paths.coherence[lane],
                                .facet = kFacet});
            if (expected.size() == kPathLanes) {
              compare();
            }
          }
        }
      }
    }
  }
}

// Facets of 0.3 are no mirrors: what goes on is |R|^2 e^-g, g = 4 k^2 h^2 cos^2. With |R| = 0.9, h = 0.08 mm and
// k = 2 pi 720e3 / 1500 = 3015.93 per m, g = 0.232853 cos^2: .8100 x .792270 = .641739 ahead, .8100 x .892170 = .722658
// at cos = 0.7. Facets of 0.05 reflect it all.
TEST(EchoLawsTest, MirrorsSendOnTheirCoherentShare) {
  std::vector<Material> materials(2);
  materials[0].reflection = materials[1].reflection = 0.9;
  materials[0].rms_height = materials[1].rms_height = 8e-5;
  materials[0].rms_slope = 0.3;
  materials[1].rms_slope = 0.05;
  const ScatterTable table(materials, kFrequency);
  const SurfaceLabel surfaces[] = {surface_label(0, 0), surface_label(3, 0), surface_label(0, 1), kNoSurface};
  const float facing[] = {1, -0.7F, 0.7F, 0.5F};
  const double expected[] = {0.641739, 0.722658, 0.81, 0};
  float mirrored[4];
  table.fill_mirrored(4, surfaces, facing, mirrored);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(mirrored[i], expected[i], 2e-5) << i;
    if (surfaces[i] != kNoSurface) {
      EXPECT_NEAR(table.mirrored(surfaces[i], facing[i]), expected[i], 2e-5) << i;
    }
  }
}

// The sigmoids that a scenario may ask for, steep ones included.
std::vector<PaperModel> all_sigmoids() {
  std::vector<PaperModel> models = {{.sigmoid = Sigmoid::kAuthors}, {.sigmoid = Sigmoid::kNone}};
  for (const double midpoint : {0.0, 0.1, 0.5, 1.0}) {
    for (const double slope : {0.5, 12.0, 40.0}) {
      models.push_back({.sigmoid_midpoint = midpoint, .sigmoid_slope = slope});
    }
  }
  return models;
}

// Errors of a logistic are those of single precision in its argument, at most a quarter of the slope times 6e-8, and of
// the terms that are subtracted for S(0) = 0; a slope of 0.5 enlarges those eight times.
constexpr double kSigmoidError = 2e-6;

TEST(EchoLawsTest, VectorLoopsHaveThePaperStrengths) {
  for (const PaperModel& model : all_sigmoids()) {
    FlatPlanSettings settings{.paper = model};
    settings.sonar.beam_count = 1;
    settings.sonar.sampling = {.columns_per_beam = 1, .rows = 200};
    const auto plan = make_flat_plan(settings);
    HitStrip strip(1, 200);
    HitColumn hits = strip.column(0);
    hits.rows = 200;
    for (int row = 0; row < 200; ++row) {
      hits.surface[row] = 0;
      hits.facing[row] = (row % 2 == 0 ? 1.0F : -1.0F) * static_cast<float>(row) / 199.0F;
      hits.reflectivity[row] = static_cast<float>(row % 7) / 6.0F;
      hits.range[row] = 0.3F * static_cast<float>(row + 1);
    }
    fill_powers(*plan, hits);
    const double gamma = plan->neper_per_metre;
    for (int row = 0; row < 200; ++row) {
      const double strength =
          precise::paper_strength(hits.facing[row], hits.reflectivity[row], gamma, 2 * double{hits.range[row]});
      EXPECT_NEAR(hits.strength[row], strength, kRelative * strength) << row;
      EXPECT_NEAR(hits.power[row], model.shape(strength), kSigmoidError)
          << row << ", slope " << model.sigmoid_slope << ", midpoint " << model.sigmoid_midpoint;
    }

    std::vector<float> rest(200, 17.5F), power(200);
    secondary_powers(*plan, 200, hits.strength, rest.data(), power.data());
    for (int row = 0; row < 200; ++row) {
      const double strength = hits.strength[row] * precise::paper_strength(1, 1, gamma, 17.5);
      EXPECT_NEAR(power[row], model.shape(strength), kSigmoidError) << row;
    }
  }
}

}  // namespace
}  // namespace insonify::echo_laws_test

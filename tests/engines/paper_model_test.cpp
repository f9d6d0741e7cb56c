// paper_model_test.cpp -- strength of echoes in the `paper` model: sigmoid, incidence, reflectivity, absorption.

#include "insonify/paper_model.h"

#include "engines/test_scenes.h"
#include "insonify/acoustics/absorption.h"

namespace insonify::paper_model_test {
namespace {

using namespace testing_scenes;

// The sigmoid of the authors' code (docs/concepts/paper-model.md) at cos 60 degrees is 0.5 tanh(9 (0.5 - 2/3)) + 0.5 =
// 0.0474.
TEST(PaperModelTest, AuthorsSigmoidIsTheirTanh) {
  const PaperModel model{.sigmoid = Sigmoid::kAuthors};
  for (const double x : {0.0, 0.3, 0.5, 2.0 / 3, 1.0}) {
    EXPECT_NEAR(model.shape(x), 0.5 * std::tanh(9 * (x - 2.0 / 3)) + 0.5, 1e-12) << x;
  }
  EXPECT_NEAR(model.shape(0.5), 0.0474, 1e-4);
}

TEST(PaperModelTest, LogisticRunsFromZeroToOneThroughItsMidpoint) {
  const PaperModel model{.sigmoid_midpoint = 0.4, .sigmoid_slope = 12};
  EXPECT_NEAR(model.shape(0), 0, 1e-15);
  EXPECT_NEAR(model.shape(1), 1, 1e-15);
  // 1 / (1 + e^4.8) = 0.008163, 1 / (1 + e^-7.2) = 0.999254: (0.5 - 0.008163) / 0.991091 = 0.496258.
  EXPECT_NEAR(model.shape(0.4), 0.496258, 1e-5);
}

// A beam so narrow that all its samples have the same range and incidence.
struct ThinBeam {
  SonarConfig sonar;
  FlatPlanSettings settings;

  ThinBeam() {
    sonar.beam_count = 1;
    sonar.azimuth_aperture = 0.05 * kDegree;
    sonar.elevation_aperture = 0.05 * kDegree;
    sonar.min_range = 0;
    sonar.max_range = 40;
    sonar.bin_count = 400;
    sonar.sampling = {.columns_per_beam = 4, .rows = 4};
    settings = {.sonar = sonar,
                .water = {.absorption = false},
                .paper = {.sigmoid = Sigmoid::kNone},
                .secondary = SecondaryEchoes::kNone};
  }

  // Mean strength of all samples received.
  [[nodiscard]] double strength(const std::string& engine, const Scene& scene, int order = 1) const {
    const EchoGrid grid = echoes_of(engine, scene, settings);
    double weight = 0;
    for (const float w : grid.weight(order, 0)) {
      weight += w;
    }
    return total(grid, order) / weight;
  }
};

class PaperStrengthTest : public testing::TestWithParam<std::string_view> {};
INSTANTIATE_TEST_SUITE_P(Engines, PaperStrengthTest, testing::ValuesIn(usable_engines()),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(PaperStrengthTest, IsCosineOfIncidenceTimesReflectivity) {
  const ThinBeam beam;
  for (const double tilt : {0.0, 30.0, 60.0}) {
    const Scene scene =
        SceneMaker()
            .add("plate", make_plane(Vec3::UnitX(), 50, 50),
                 {.position = {10, 0, 0}, .orientation = orientation_from_rpy(0, tilt * kDegree, 0)}, 0.7)
            .scene();
    EXPECT_NEAR(beam.strength(std::string(GetParam()), scene), 0.7 * std::cos(tilt * kDegree), 1e-3) << tilt;
  }
}

// T6 (docs/concepts/physics-tests.md) for the amplitude of the paper model: e^(-2 gamma r). At 720 kHz, 10 degC and 35
// PSU gamma = 0.0257269 Np/m; at 20 m e^(-1.029076) = 0.357337.
TEST_P(PaperStrengthTest, AbsorptionIsTwoWay) {
  ThinBeam beam;
  beam.settings.water = {};
  beam.settings.sonar.frequency = 720e3;
  const Scene scene = SceneMaker().add_wall(20, 1.0).scene();
  EXPECT_NEAR(beam.strength(std::string(GetParam()), scene), 0.357337, 1e-5);
}

TEST_P(PaperStrengthTest, BothSidesOfASurfaceEcho) {
  const ThinBeam beam;
  for (const double side : {1.0, -1.0}) {
    const Scene scene =
        SceneMaker().add("plate", make_plane(Vec3(side, 0, 0), 5, 5), {.position = {10, 0, 0}}, 0.6).scene();
    EXPECT_NEAR(beam.strength(std::string(GetParam()), scene), 0.6, 1e-5);
  }
}

// A path to a mirror at 45 degrees (strength cos 45 x 0.9), from there to a plate at normal incidence (x 0.8), and
// straight back: 5 + 5 + sqrt(50) m, with absorption e^(-gamma path).
TEST_P(PaperStrengthTest, SecondaryEchoesMultiplyBothSurfacesAndTheWholePath) {
  ThinBeam beam;
  beam.settings.water = {};
  beam.settings.sonar.frequency = 720e3;
  beam.settings.secondary = SecondaryEchoes::kAll;
  const Scene scene = SceneMaker()
                          .add("mirror", make_plane(Vec3(-1, 1, 0).normalized(), 1, 1), {.position = {5, 0, 0}}, 0.9)
                          .add("plate", make_plane(Vec3::UnitY(), 1, 1), {.position = {5, 5, 0}}, 0.8)
                          .scene();
  const double path = 10 + std::sqrt(50.0);
  const double gamma = kNeperPerDecibel * absorption_db_per_m(720e3, Water{});
  EXPECT_NEAR(beam.strength(std::string(GetParam()), scene, 2),
              std::cos(45 * kDegree) * 0.9 * 0.8 * std::exp(-gamma * path), 1e-3);
}

}  // namespace
}  // namespace insonify::paper_model_test

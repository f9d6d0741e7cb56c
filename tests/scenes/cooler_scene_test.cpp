// cooler_scene_test.cpp -- ranges, bearings and shadows of the cooler scene against its geometry.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "insonify/acoustics/absorption.h"
#include "scenes/mesh_probe.h"
#include "scenes/scene_ping.h"

namespace insonify::cooler_scene_test {
namespace {

using testing_scenes::Probe;
using testing_scenes::ScenePing;

// Shadows are measured without secondary echoes, which arrive late and would fill them.
const ScenePing& primary_ping() {
  static const ScenePing ping("cooler", [](Scenario& scenario) { scenario.secondary = SecondaryEchoes::kNone; });
  return ping;
}

// scenes/cooler.sdf: 22.5 2 0.16, roll -0.8, pitch 0.6, yaw 62 degrees.
Vec3 world_from_cooler(const Vec3& p) {
  const auto about = [](double degrees, const Vec3& axis) {
    return Eigen::AngleAxisd(radians_from_degrees(degrees), axis);
  };
  return Vec3(22.5, 2, 0.16) +
         about(62, Vec3::UnitZ()) * (about(0.6, Vec3::UnitY()) * (about(-0.8, Vec3::UnitX()) * p));
}

TEST(CoolerSceneTest, NearestEchoOfTheCoolerIsTheCornerOfItsMudmat) {
  // 12.8 x 5.9 m, its corners cut by 80 mm; the one at the inlet on the ROV's side is nearest.
  const ScenePing& ping = primary_ping();
  const auto corner = ping.sighting(world_from_cooler({-6.4 + 0.04, 2.95 - 0.04, 0}));
  int nearest_bin = ping.ping().bin_count;
  int nearest_beam = -1;
  for (int beam = 0; beam < ping.ping().beam_count; ++beam) {
    const int bin = ping.first_bin_of("structure", beam);
    if (bin >= 0 && bin < nearest_bin) {
      nearest_bin = bin;
      nearest_beam = beam;
    }
  }
  EXPECT_NEAR(ping.sonar().bin_range(nearest_bin), corner.range, 2 * ping.sonar().bin_length());
  EXPECT_NEAR(nearest_beam, ping.beam_at(corner.azimuth), 1);
}

TEST(CoolerSceneTest, MudmatBeginsAlongItsFrontEdgeInEveryBeam) {
  // Where a beam's plane, which contains the sonar's z axis, intersects the edge from corner to corner. Higher parts of
  // the cooler at the same range have another elevation label.
  const ScenePing& ping = primary_ping();
  const Vec3 from = world_from_cooler({-6.2, 2.95, 0});
  const Vec3 to = world_from_cooler({6.2, 2.95, 0});
  const Pose sonar = ping.world_from_sonar();
  double beams = 0;
  double found = 0;
  for (int beam = ping.beam_at(ping.sighting(to).azimuth) + 1; beam < ping.beam_at(ping.sighting(from).azimuth);
       ++beam) {
    const double azimuth = ping.sonar().beam_azimuth(beam);
    const Vec3 aside = sonar.orientation * Vec3(-std::sin(azimuth), std::cos(azimuth), 0);
    const double share = (sonar.position - from).dot(aside) / (to - from).dot(aside);
    const auto edge = ping.sighting(from + share * (to - from));
    int bin = 0;
    while (bin < ping.ping().bin_count &&
           !(ping.visual(bin, beam) == "structure" && std::abs(ping.elevation(bin, beam) - edge.elevation) < 0.02)) {
      ++bin;
    }
    // Half a beam's width to either side, the oblique edge is up to 80 mm nearer or farther.
    found += std::abs(ping.sonar().bin_range(bin) - edge.range) < 2 * ping.sonar().bin_length() + 0.08 ? 1 : 0;
    beams += 1;
  }
  EXPECT_GT(beams, 40);
  EXPECT_GE(found, 0.95 * beams);  // In a beam or two the umbilical or a column shares the edge's cells.
}

TEST(CoolerSceneTest, RaisedPipeCastsAShadowThatIsDetachedFromIt) {
  // The gas line crosses in front of the sonar, supported by grout bags on both sides. The height of its top and its
  // position are measured on the mesh; the rest is trigonometry.
  const ScenePing& ping = primary_ping();
  Probe lines("pipelines");
  Probe bed("cooler_bed");
  constexpr double kRadius = 0.16;  // [m]
  const auto crest = [&](double y) {
    double best = -10;
    double place = 0;
    for (double x = 13; x < 16; x += 0.005) {
      if (const double height = lines.height(x, y); std::isfinite(height) && height > best) {
        best = height;
        place = x;
      }
    }
    return Vec3(place, y, best);
  };
  const Vec3 top = crest(0);
  ASSERT_GT(top.z() - bed.height(top.x(), 0), 0.5);  // Raised by more than its diameter.
  const testing_scenes::StraightPipe pipe{top - kRadius * Vec3::UnitZ(), crest(0.5) - crest(-0.5), kRadius};

  const double bin = ping.sonar().bin_length();
  const double step = 3 * bin;  // Rows lie 0.05 degrees apart: up to 40 mm on the bed at this slant.
  for (const int beam : {ping.beam_at(0.004), ping.beam_at(-0.004)}) {
    const auto shadow = testing_scenes::shadow_of_pipe(ping.world_from_sonar(), ping.sonar().beam_azimuth(beam), pipe,
                                                       [&](double x, double y) { return bed.height(x, y); });
    const int echo = ping.first_bin_of("lines", beam);
    ASSERT_GE(echo, 0);
    EXPECT_NEAR(ping.sonar().bin_range(echo), shadow.echo, 2 * bin);
    const auto silence = ping.silence_around((shadow.from + shadow.to) / 2, beam);
    EXPECT_NEAR(silence.from, shadow.from, step);
    EXPECT_NEAR(silence.to, shadow.to, step);
    // Bed between the pipe and its shadow.
    EXPECT_EQ(ping.visual(ping.bin_at((shadow.echo + shadow.from) / 2), beam), "sand");
    EXPECT_GT(shadow.from - shadow.echo, 0.5);
  }
}

TEST(CoolerSceneTest, CoolerHidesTheBedToTheEndOfTheRange) {
  // Its pipes are up to 3.2 m high, 22 to 26 m away: a ray over them reaches the bed no nearer than 22 * 6 / (6 - 3.2)
  // = 47 m.
  const ScenePing& ping = primary_ping();
  const auto degrees = [](double value) { return radians_from_degrees(value); };
  EXPECT_LT(ping.share_heard(29, 39.5, degrees(2), degrees(8)), 0.03);
  EXPECT_GT(ping.share_heard(29, 39.5, degrees(-14), degrees(-9)),
            0.7);  // Beside it only mounds and spools shadow the bed.
}

TEST(CoolerSceneTest, WaterWeakensEveryEchoOfTheBedByItsRange) {
  const auto ping_with = [](bool absorption) {
    return ScenePing("cooler", [&](Scenario& scenario) {
      scenario.water.absorption = absorption;
      scenario.paper.sigmoid = Sigmoid::kNone;
      scenario.secondary = SecondaryEchoes::kNone;
      scenario.sonars[0].gain = 1;
    });
  };
  const ScenePing wet = ping_with(true);
  const ScenePing clear = ping_with(false);
  const double loss = kNeperPerDecibel * absorption_db_per_m(720e3, wet.simulator().scenario().water);  // [Np/m]
  double worst = 0;
  int count = 0;
  for (int beam = 0; beam < wet.ping().beam_count; beam += 5) {
    for (int bin = 0; bin < wet.ping().bin_count; ++bin) {
      const std::size_t cell = wet.ping().index(bin, beam);
      if (wet.visual(bin, beam) == "sand" && clear.ping().intensity[cell] > 0.01F) {
        const double kept = wet.ping().intensity[cell] / clear.ping().intensity[cell];
        worst = std::max(worst, std::abs(kept / std::exp(-2 * loss * wet.sonar().bin_range(bin)) - 1));
        ++count;
      }
    }
  }
  EXPECT_GT(count, 5000);
  EXPECT_LT(worst, 0.02);  // A cell's samples are up to about 0.3 m from its centre.
  EXPECT_LT(std::exp(-2 * loss * (39 - 14)), 0.35);
}

TEST(CoolerSceneTest, SteelStandsOutFromTheBed) {
  // Level by cos(incidence) * reflectivity: bed at 20 m is at 17 degrees grazing and keeps 0.37, surfaces that face the
  // sonar are at normal incidence and keep 0.85 or more.
  const ScenePing ping("cooler", [](Scenario& scenario) {
    scenario.paper.sigmoid = Sigmoid::kNone;
    scenario.sonars[0].gain = 1;
  });
  const int beams = ping.ping().beam_count;
  double of_steel = 0;
  double of_sand = 0;
  double steel_cells = 0;
  double sand_cells = 0;
  std::size_t loudest = 0;
  for (int bin = ping.bin_at(19); bin < ping.bin_at(24); ++bin) {
    for (int beam = 0; beam < beams; ++beam) {
      const std::size_t cell = ping.ping().index(bin, beam);
      loudest = ping.ping().intensity[cell] > ping.ping().intensity[loudest] ? cell : loudest;
      if (ping.visual(bin, beam) == "sand") {
        of_sand += ping.ping().intensity[cell];
        sand_cells += 1;
      } else if (ping.visual(bin, beam) == "structure") {
        of_steel += ping.ping().intensity[cell];
        steel_cells += 1;
      }
    }
  }
  EXPECT_GT(of_steel / steel_cells, 3 * of_sand / sand_cells);
  EXPECT_TRUE(ping.material(loudest).ends_with("steel") || ping.material(loudest) == "aluminium")
      << ping.material(loudest);
}

}  // namespace
}  // namespace insonify::cooler_scene_test

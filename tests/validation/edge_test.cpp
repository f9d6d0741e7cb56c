// edge_test.cpp -- pings of edges of plates, boxes and frames that are seen broadside (docs/concepts/scattering.md,
// "Edges"): their levels, their interference, and what hides or moves them.

#include <complex>
#include <numbers>

#include "validation/calibrated_scene.h"

namespace insonify::validation::edge_test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFrequency = 450e3, kSpeed = 1480, kWavelength = kSpeed / kFrequency;

Material polished(double reflection, double rms_height = 1e-6) {
  Material material = glinting(reflection, 0.05);
  material.rms_height = rms_height;
  return material;
}

// Odd numbers of beams and bins: what is straight ahead at `distance` is in the middle of one.
SonarConfig fan_at(double distance) {
  SonarConfig sonar;
  sonar.frequency = kFrequency;
  sonar.beam_count = 31;
  sonar.azimuth_aperture = 31 * kDegree;
  sonar.elevation_aperture = 20 * kDegree;
  sonar.min_range = distance - 1;
  sonar.max_range = distance + 1;
  sonar.bin_count = 25;
  sonar.sampling = {2, 60};  // No sample meets a lobe.
  return sonar;
}

Scenario scenario_at(double distance, const Method& method) {
  Scenario scenario = calibrated(fan_at(distance), method);
  scenario.water.sound_speed = kSpeed;
  return scenario;
}

// A square post whose nearest vertical edge is straight ahead, turned by `yaw`, 0 to 90 degrees: its faces are seen at
// the angles 180 - yaw and 90 + yaw from themselves.
Scene post_at(double distance, double yaw, const Material& material, double side = 0.4) {
  const double diagonal = 0.5 * side * std::numbers::sqrt2;
  const double turned = yaw - 45 * kDegree;  // At 45 degrees an edge points to the sonar.
  const Vec3 middle(distance + diagonal * std::cos(turned), diagonal * std::sin(turned), 0);
  return scene_of(make_box({side, side, 3}), material,
                  {.position = middle, .orientation = orientation_from_rpy(0, 0, yaw)});
}

// Keller's coefficient over sqrt(k/2 pi)^-1 in its own form, with R on the terms of reflection: exterior 3/2, so that
// sin(pi/n)/(2 pi n) = .091888 and cos(pi/n) = -1/2.
double right_angled(double degrees, double reflection) {
  const auto over = [](double angle) { return 1 / (-0.5 - std::cos(angle * kDegree / 1.5)); };
  return 0.0918881 * (over(0) + reflection * over(2 * degrees));
}

double post_level(double distance, double yaw_degrees, double reflection) {
  const double scattered = right_angled(180 - yaw_degrees, reflection);
  return 10 * std::log10(scattered * scattered * kWavelength / (2 * std::pow(distance, 3)));
}

// Fresnel's ripples by the ends of a post of 3 m: its ends are u = 17 zones off, each 1/(pi u), so at most 2 x
// .0184/sqrt 2 of the amplitude.
constexpr double kRipple = 0.23;  // [dB]

class EdgeTest : public testing::TestWithParam<Method> {};

// Of long vertical posts the nearest edge, by hand at 45 degrees and R = 1: .1225^2 x 3.2889 mm / (2 x 9^3) = -74.70
// dB. The other two that are seen lie 0.28 m off, and beside.
TEST_P(EdgeTest, PostHasTheEchoOfItsEdge) {
  EXPECT_NEAR(post_level(9, 45, 1), -74.70, 0.01);
  struct Case {
    double distance, yaw, reflection;
  };
  for (const Case& c : {Case{9, 45, 0.8}, Case{9, 45, 0.4}, Case{5, 33, 0.8}, Case{14, 61, 0.9}}) {
    const Ping ping =
        ping_of(scenario_at(c.distance, GetParam()), post_at(c.distance, c.yaw * kDegree, polished(c.reflection)));
    EXPECT_NEAR(cell_db(ping, 12, 15), post_level(c.distance, c.yaw, c.reflection), kRipple)
        << c.distance << ", " << c.yaw;
  }
}

// The post with every face given twice, in both windings, and its corners moved by up to 1e-6 m; and cut into two
// halves whose other faces are whole, so that corners lie on sides.
Mesh cut_otherwise(const Mesh& plain, bool twice, bool halves) {
  std::vector<std::array<Vec3f, 3>> triangles;
  for (const auto& [a, b, c] : plain.triangles) {
    const std::array<Vec3f, 3> corners = {plain.vertices[a], plain.vertices[b], plain.vertices[c]};
    // The faces across x are cut at z = 0.2: their two triangles into three each.
    if (halves && plain.normals[a].x() > 0.5F) {
      const auto above = [](const Vec3f& corner) { return corner.z() > 0.2F; };
      const int count = static_cast<int>(std::ranges::count_if(corners, above));
      int lone = 0;  // The corner that is on its side alone.
      while (above(corners[lone]) != (count == 1)) {
        ++lone;
      }
      const Vec3f &p = corners[lone], &q = corners[(lone + 1) % 3], &r = corners[(lone + 2) % 3];
      const auto cut = [&](const Vec3f& end) { return Vec3f(p + (0.2F - p.z()) / (end.z() - p.z()) * (end - p)); };
      triangles.push_back({p, cut(q), cut(r)});
      triangles.push_back({cut(q), q, r});
      triangles.push_back({cut(q), r, cut(r)});
    } else {
      triangles.push_back(corners);
    }
    if (twice) {
      triangles.push_back({corners[2], corners[1], corners[0]});
    }
  }
  Mesh mesh;
  float off = 0;
  for (const std::array<Vec3f, 3>& corners : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3f& corner : corners) {
      off = std::fmod(off + 0.618F, 1.0F);
      mesh.vertices.push_back(corner + 1e-6F * Vec3f(off, -off, 1 - 2 * off));
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_EQ(clean_mesh(mesh).dropped(), 0U);
  return mesh;
}

TEST_P(EdgeTest, PostIsTheSameHoweverItIsCut) {
  const Scene plain = post_at(9, 33 * kDegree, polished(0.8));
  for (const auto& [twice, halves] : {std::pair(true, false), std::pair(false, true), std::pair(false, false)}) {
    const Scene cut = scene_of(cut_otherwise(*plain.instances[0].mesh, twice, halves), polished(0.8),
                               plain.instances[0].world_from_mesh);
    for (const int bins : {25, 5}) {
      Scenario scenario = scenario_at(9, GetParam());
      scenario.sonars[0].bin_count = bins;
      EXPECT_NEAR(total_db(ping_of(scenario, cut)), total_db(ping_of(scenario, plain)), 0.01) << twice << halves;
      EXPECT_NEAR(cell_db(ping_of(scenario, cut), bins / 2, 15), post_level(9, 33, 0.8), kRipple) << twice << halves;
    }
  }
}

// Half-planes: n = 2 and R = .8, a sheet of 0.4 x 3 m turned by 40 degrees. By hand of its far border, at 50 degrees
// from the face, S = -(2 + .8 (cot 20 + cot(-110)))/8 pi = -(2 + .8 (2.74748 + .36397))/8 pi = -.178618; of the near
// one, at 130 degrees, -(2 + .8 (cot(-20) + cot(-70)))/8 pi = .019463. Both sides of the sheet as faces in one place,
// as a box of less than 1 mm and as two faces without a rim are the plate of one face.
TEST_P(EdgeTest, SheetsAreOnePlate) {
  const auto scene = [&](const Mesh& mesh) {
    return scene_of(mesh, polished(0.8),
                    {.position = {10, 0, 0}, .orientation = orientation_from_rpy(0, 0, 40 * kDegree)});
  };
  const Scenario scenario = scenario_at(10, GetParam());
  const Mesh plate = make_plane(-Vec3::UnitX(), 3, 0.4);
  const Ping one = ping_of(scenario, scene(plate));
  double expected = 0;
  for (const auto& [scattered, side] : {std::pair(0.178618, 1), {0.019463, -1}}) {
    const double range = std::hypot(10 + 0.2 * side * std::sin(40 * kDegree), 0.2 * std::cos(40 * kDegree));
    expected += scattered * scattered * kWavelength / (2 * std::pow(range, 3));
  }
  EXPECT_NEAR(total_db(one), 10 * std::log10(expected), kRipple);
  Mesh both = plate;
  for (const auto& [a, b, c] : plate.triangles) {
    both.triangles.push_back({c, b, a});
  }
  Mesh open = make_box({6e-4, 0.4, 3});
  std::erase_if(open.triangles, [&](const auto& corners) { return std::abs(open.normals[corners[0]].x()) < 0.5F; });
  for (const Mesh& mesh : {both, open, make_box({1e-5, 0.4, 3}), make_box({3e-4, 0.4, 3}), make_box({9e-4, 0.4, 3})}) {
    EXPECT_NEAR(total_db(ping_of(scenario, scene(mesh))), total_db(one), 0.05);
  }
}

// A sheet head on is the mirror of its nearer side alone, up to 2 mm thick as well as beyond: |R|^2/(2 d)^2 of a large
// one, -20 log 20 + 20 log .8 = -27.96 dB; its Fresnel zones are 13 cm wide.
TEST_P(EdgeTest, SheetsHaveOneGlint) {
  for (const double thickness : {2e-4, 1.3e-3, 1.9e-3, 3e-3}) {
    const double x = 10 + 0.5 * thickness;
    const Ping ping = ping_of(scenario_at(10, GetParam()),
                              scene_of(make_box({thickness, 3, 3}), polished(0.8), {.position = {x, 0, 0}}));
    EXPECT_NEAR(total_db(ping), -27.96, 0.5) << thickness;
  }
}

// Foam is softer than water: its reflection is negative, and its edge as strong again. By hand: 200 kg/m^3 and 500 m/s
// in water of 1026 and 1500, Rayleigh's R at 45 degrees (.1949 x .7071 - sqrt(9 - .5)) / (.1949 x .7071 + sqrt(9 - .5))
// =
// -.9097; 6.68 dB more than with +.9097.
TEST_P(EdgeTest, SoftBodiesHaveStrongerEdges) {
  Material foam;
  foam.density = 200;
  foam.sound_speed = 500;
  foam.lambert_db = -200;
  foam.rms_slope = 0.05;
  foam.rms_height = 1e-6;
  const Ping ping = ping_of(scenario_at(9, GetParam()), post_at(9, 45 * kDegree, foam));
  EXPECT_NEAR(cell_db(ping, 12, 15), post_level(9, 45, -0.9097), kRipple);
  EXPECT_NEAR(post_level(9, 45, -0.9097) - post_level(9, 45, 0.9097), 6.676, 0.01);
}

// A strip turned by t: both of its edges, S = (-+ 1 + 1/sin t)/(4 pi) for R = 1, and their sum with phases, which is
// Kirchhoff's integral over the strip but for 1/sin - 1/tan of each. All along its side lobes, from where its glint
// ends; the glint itself is Kirchhoff's.
TEST_P(EdgeTest, PlateHasTheSideLobesOfKirchhoffsIntegral) {
  constexpr double kDistance = 40, kSide = 0.15, kHeight = 6;
  Scenario scenario = scenario_at(kDistance, GetParam());
  scenario.receiver.speckle = true;  // Echoes of one cell interfere.
  double worst = 0;
  for (double degrees = 0.05; degrees < 5; degrees += 0.075) {
    const double t = degrees * kDegree;
    const Scene scene = scene_of(make_plane(-Vec3::UnitX(), kHeight, kSide), polished(1),
                                 {.position = {kDistance, 0, 0}, .orientation = orientation_from_rpy(0, 0, t)});
    ASSERT_NEAR(scene.bounds().high.z(), kHeight / 2, 1e-4);  // Of make_plane's sides the first is upright.
    const Ping ping = ping_of(scenario, scene);
    const double actual = std::sqrt(double{ping.intensity[ping.index(12, 15)]});
    // The strip's points, and sqrt(lambda r/2) along it: 1/lambda sum of cos e^(2ikr) / r^2.
    std::complex<double> sum = 0;
    constexpr int kSteps = 600;
    for (int i = 0; i < kSteps; ++i) {
      const double x = (-0.5 + (i + 0.5) / kSteps) * kSide;
      const double range = std::hypot(x * std::cos(t), kDistance + x * std::sin(t));
      sum += std::polar(kSide / kSteps * std::cos(t), 4 * kPi / kWavelength * range);
    }
    const double along = std::sqrt(0.5 * kWavelength * kDistance) / (kDistance * kDistance);
    const double expected = std::abs(sum) / kWavelength * along;
    // Largest of the lobes there, of which the glint's fast integrals are off by 3 %, and what Keller's edges have
    // beyond Kirchhoff's.
    const double largest = std::min(kSide / kWavelength, 1 / (2 * kPi * std::tan(t))) * along;
    const double beyond = (1 + std::tan(t / 2)) / (2 * kPi) * along;
    EXPECT_NEAR(actual, expected, 0.03 * largest + beyond) << degrees;
    worst = std::max(worst, std::abs(actual - expected) / largest);
  }
  EXPECT_LT(worst, 0.1);
}

// A square tube of 5 cm, thin at this range as well as near, has its edges as a thick post has; within the lobe of a
// face's facets it has that alone.
TEST_P(EdgeTest, ThinTubesHaveEdgesBesideTheirLobes) {
  for (const double distance : {4.0, 15.0}) {
    Scenario scenario = scenario_at(distance, GetParam());
    scenario.sonars[0].bin_count = 101;  // The edges behind are 3.5 cm off, nearly two bins.
    scenario.sonars[0].sampling = {4, 100};
    const Ping ping = ping_of(scenario, post_at(distance, 45 * kDegree, polished(0.8), 0.05));
    EXPECT_NEAR(cell_db(ping, 50, 15), post_level(distance, 45, 0.8), kRipple) << distance;
    for (const double yaw : {1.0, 5.0}) {
      const auto level = [&](double rms_height) {
        return total_db(ping_of(scenario, post_at(distance, yaw * kDegree, polished(0.8, rms_height), 0.05)));
      };
      EXPECT_NEAR(level(1e-6), level(0), 0.3) << distance << ", " << yaw;
    }
  }
}

// From above its end the echo of the edge goes on for Fresnel zones only; of a plate turned about both axes there is
// none.
TEST_P(EdgeTest, EchoesBroadsideOnly) {
  constexpr double kDistance = 10;
  const Scenario scenario = scenario_at(kDistance, GetParam());
  const auto level = [&](double roll, double pitch) {
    return total_db(ping_of(
        scenario, scene_of(make_box({0.3, 0.3, 0.6}), polished(0.9),
                           {.position = {kDistance, 0, 0},
                            .orientation = orientation_from_rpy(0, pitch, 0) * orientation_from_rpy(0, 0, roll)})));
  };
  const double broadside = level(40 * kDegree, 0);
  EXPECT_GT(broadside, post_level(kDistance, 40, 0.9) - 1);
  EXPECT_LT(level(40 * kDegree, 25 * kDegree), broadside - 40);
}

TEST_P(EdgeTest, HiddenOnesAreSilent) {
  constexpr double kDistance = 9;
  const Scene post = post_at(kDistance, 45 * kDegree, polished(0.8));
  const Scenario scenario = scenario_at(kDistance, GetParam());
  const Scene before = scene_of(make_sphere(0.1), diffuse(-200), {.position = {kDistance - 2, 0, 0}});
  EXPECT_LT(cell_db(ping_of(scenario, scene_of_all({post, before})), 12, 15), post_level(kDistance, 45, 0.8) - 60);
  // The far edge, 0.566 m behind, is hidden by the post itself.
  const Ping ping = ping_of(scenario, post);
  EXPECT_LT(cell_db(ping, 12 + 7, 15), post_level(kDistance, 45, 0.8) - 60);
}

// e^-g with g = 4 k^2 h^2 at all angles: h = 80 um, k = 1910.4 (450 kHz, 1480 m/s): 4 (.15284)^2 = .09344, .4058 dB;
// the materials' table has sea water's 1500 m/s, .09096 and .3951 dB.
TEST_P(EdgeTest, RoughFacesLoseTheirCoherentShare) {
  const auto level = [&](double rms_height, bool rough_mirrors) {
    Scenario scenario = scenario_at(9, GetParam());
    scenario.rough_mirrors = rough_mirrors;
    return cell_db(ping_of(scenario, post_at(9, 45 * kDegree, polished(0.8, rms_height))), 12, 15);
  };
  EXPECT_NEAR(level(8e-5, false) - level(1e-7, false), -0.395, 0.02);
  EXPECT_LT(level(1e-6, true), level(1e-6, false) - 60);
  EXPECT_LT(level(0, false), level(1e-6, false) - 60);
}

// Through array, pulse, absorption, elevation pattern and bins that are coarser or finer than the pulse, an edge is a
// point at the foot of the perpendicular.
TEST_P(EdgeTest, ReachesTheReceiverAsAPointDoes) {
  for (const int bins : {25, 425}) {
    constexpr double kDistance = 11;
    Scenario scenario = scenario_at(kDistance, GetParam());
    scenario.primary = PrimaryEchoes::kAuto;  // Rasterised primaries have no elevation pattern.
    scenario.water.absorption = true;
    scenario.sonars[0].bin_count = bins;
    scenario.sonars[0].orientation = {0, 6 * kDegree, 3 * kDegree};
    scenario.receiver.azimuth_pattern = BeamPattern::kHann;
    scenario.receiver.elevation_pattern = BeamPattern::kRectangular;
    scenario.receiver.pulse = PulseKind::kLfm;
    scenario.receiver.pulse_duration = 50e-6;
    const Ping post = ping_of(scenario, post_at(kDistance, 52 * kDegree, polished(0.8)));
    scenario.points = {{.position = {kDistance, 0, 0},
                        .target_strength_db = post_level(kDistance, 52, 0.8) + 40 * std::log10(kDistance)}};
    const Ping point = ping_of(scenario, {});
    const auto strongest = std::ranges::max_element(point.intensity) - point.intensity.begin();
    for (const auto cell : {strongest, strongest + 1, strongest - 1}) {
      EXPECT_NEAR(10 * std::log10(post.intensity[cell] / point.intensity[cell]), 0, kRipple + 0.05) << bins;
    }
  }
}

TEST_P(EdgeTest, MovesWithItsObjectAndWithTheSonar) {
  const Scene post = post_at(9, 45 * kDegree, polished(0.8));
  const std::string name = post.instances[0].name;
  Simulator simulator(scenario_at(9, GetParam()), post, 2, std::vector<MovableObject>{{name}});
  EXPECT_NEAR(cell_db(simulator.ping(0, {}), 12, 15), post_level(9, 45, 0.8), kRipple);
  Pose away = post.instances[0].world_from_mesh;
  away.position.x() += 0.4;  // Five bins.
  const Ping moved = simulator.ping(0, {.moved = {{.name = name, .world_from_object = away}}});
  EXPECT_LT(cell_db(moved, 12, 15), post_level(9, 45, 0.8) - 60);
  EXPECT_NEAR(cell_db(moved, 17, 15), post_level(9.4, 45, 0.8), kRipple);
  PingRequest nearer;
  nearer.world_from_vehicle.position.x() = 0.16;
  EXPECT_NEAR(cell_db(simulator.ping(0, nearer), 10, 15), post_level(8.84, 45, 0.8), kRipple);
}

// Batches of pings by several threads have the same bytes.
TEST_P(EdgeTest, BatchesAreTheSame) {
  const Scene post = post_at(9, 45 * kDegree, polished(0.8));
  std::vector<PingRequest> requests(9);
  for (std::size_t i = 0; i < requests.size(); ++i) {
    requests[i].number = static_cast<int>(i);
    requests[i].world_from_vehicle.position.y() = 0.01 * static_cast<double>(i);
  }
  Simulator simulator(scenario_at(9, GetParam()), post, 2);
  std::vector<Ping> together(requests.size());
  simulator.ping(0, requests, together);
  Simulator one(scenario_at(9, GetParam()), post, 1);
  for (std::size_t i = 0; i < requests.size(); ++i) {
    EXPECT_EQ(one.ping(0, requests[i]).intensity, together[i].intensity) << i;
  }
}

// A frame of four posts and a rail, box profiles of 0.15 m, none of which is square to the sonar: of the posts up to
// three edges each, with the mean intensity S^2 lambda/(2 r^3) over places.
TEST_P(EdgeTest, FrameShowsItsLines) {
  constexpr double kDistance = 8, kSide = 0.15, kYaw = 38;
  Scenario scenario = scenario_at(kDistance, GetParam());
  scenario.sonars[0].min_range = 4;
  scenario.sonars[0].max_range = 12;
  scenario.sonars[0].azimuth_aperture = 93 * kDegree;
  double actual = 0, expected = 0;
  constexpr int kPlaces = 6;
  for (int place = 0; place < kPlaces; ++place) {
    std::vector<Scene> parts;
    for (const auto& [x, y] :
         {std::pair(-0.5, -0.9), std::pair(-0.5, 0.9), std::pair(0.8, -0.75), std::pair(0.8, 0.6)}) {
      const Vec3 middle(kDistance + x + 0.0371 * place, y + 0.0613 * place, 0);
      parts.push_back(scene_of(make_box({kSide, kSide, 2}), polished(0.9),
                               {.position = middle, .orientation = orientation_from_rpy(0, 0, kYaw * kDegree)}));
      // By hand: each edge by its angle to the line of sight; those behind are hidden.
      for (int corner = 0; corner < 4; ++corner) {
        const double turn = kYaw * kDegree + (45 + 90 * corner) * kDegree;
        const Vec3 edge = middle + kSide / std::numbers::sqrt2 * Vec3(std::cos(turn), std::sin(turn), 0);
        // Angle from the edge's outward bisector to the sonar; the first face lies 135 degrees from it.
        const double off = std::remainder(std::atan2(-edge.y(), -edge.x()) - turn, 2 * kPi) / kDegree;
        if (std::abs(off) < 135) {
          const double scattered = right_angled(135 + off, 0.9);
          expected += scattered * scattered * kWavelength / (2 * std::pow(edge.norm(), 3));
        }
      }
    }
    const Ping ping = ping_of(scenario, scene_of_all(parts));
    for (const float value : ping.intensity) {
      actual += value;
    }
  }
  EXPECT_NEAR(10 * std::log10(actual / expected), 0, 0.4);
}

INSTANTIATE_TEST_SUITE_P(Methods, EdgeTest, testing::Values(kRays, kRaster, kReference),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace insonify::validation::edge_test

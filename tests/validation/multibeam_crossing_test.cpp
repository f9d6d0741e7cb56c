// multibeam_crossing_test.cpp -- soundings of multibeams where effects meet: coarse bins, rolling vehicles, a sea with
// ripples, moved objects, two sonars that share a ping, noise alone, the paper's model.

#include <complex>

#include "validation/multibeam_scene.h"
#include "validation/pi.h"

namespace insonify::validation::multibeam_crossing_test {
namespace {

constexpr double kDepth = 9.3;

Scenario speckled(const SonarConfig& sonar, BeamPattern pattern = BeamPattern::kHamming) {
  Scenario scenario = with_arrays(sonar);
  scenario.receiver.azimuth_pattern = pattern;
  scenario.receiver.pulse = PulseKind::kInstrument;
  scenario.receiver.speckle = true;
  return scenario;
}

// Bins of 17 cm and a pulse of 4 cm.
TEST(MultibeamCrossingTest, CoarseBinsCostNoMoreThanABin) {
  SonarConfig sonar = crossed_lines();
  sonar.bin_count = 176;
  sonar.pulse = PulseKind::kCw;
  sonar.pulse_duration = 53e-6;
  for (const Decimation decimation : {Decimation::kPeak, Decimation::kMean}) {
    Scenario scenario = speckled(sonar);
    scenario.receiver.decimation = decimation;
    const Ping ping = ping_at(scenario, seabed_at(-kDepth, diffuse(-24)));
    double sum = 0;
    int count = 0;
    for (int beam = 4; beam < ping.beam_count - 4; ++beam) {
      ASSERT_TRUE(ping.soundings[static_cast<std::size_t>(beam)].found()) << beam;
      const double stretch = stretch_of(kDepth, sonar.beam_azimuth(beam), 2 * kDegree);
      const double off = off_level_bed(ping, beam, -kDepth);
      EXPECT_NEAR(off, 0, sonar.bin_length() + 0.3 * stretch) << beam;
      if (std::abs(sonar.beam_azimuth(beam)) < 35 * kDegree) {
        sum += off;
        ++count;
      }
    }
    EXPECT_NEAR(sum / count, 0, 0.3 * sonar.bin_length());  // No bias of half a bin.
  }
}

// A vehicle that rolls, pitches and moves while it listens, over speckle: soundings stay on the bed, with and without
// stabilisation, and within the swath that each has.
TEST(MultibeamCrossingTest, RollingVehiclesSoundTheSameBed) {
  SonarConfig sonar = crossed_lines();
  sonar.bin_count = 1300;
  sonar.beam_spacing = BeamSpacing::kEquidistant;
  for (const bool stabilised : {false, true}) {
    SonarConfig held = sonar;
    held.roll_stabilised = held.pitch_stabilised = stabilised;
    Scenario scenario = speckled(held, BeamPattern::kTaylor);
    scenario.motion_in_ping = true;
    Simulator simulator(scenario, seabed_at(-kDepth, diffuse(-24)), 2);
    for (const double roll : {-7.3, 4.1}) {
      PingRequest request;
      request.number = 3;
      request.world_from_vehicle = {Vec3(2.7, -1.9, 0), orientation_from_rpy(roll * kDegree, 2.2 * kDegree, 1.1)};
      request.twist.linear = Vec3(1.4, 0.6, 0);
      const Ping ping = simulator.ping(0, request);
      double port = 0, starboard = 0;
      for (int beam = 5; beam < ping.beam_count - 5; ++beam) {
        const Sounding& sounding = ping.soundings[static_cast<std::size_t>(beam)];
        ASSERT_TRUE(sounding.found()) << stabilised << roll << " " << beam;
        const Vec3 at = position_of(sounding, ping.world_from_sonar);
        const double angle =
            std::acos(std::min(1.0, (request.world_from_vehicle.position.z() - at.z()) / double{sounding.range}));
        EXPECT_NEAR(at.z(), -kDepth, 0.03 + 0.35 * stretch_of(kDepth, angle, 2 * kDegree))
            << stabilised << roll << " " << beam;
        const double across =
            (request.world_from_vehicle.orientation.conjugate() * Vec3(at - request.world_from_vehicle.position)).y();
        port = std::max(port, across);
        starboard = std::max(starboard, -across);
      }
      // Stabilised swaths reach as far to both sides on the bed.
      const Pose level{request.world_from_vehicle.position, orientation_from_rpy(0, 0, 1.1)};
      const Vec3 first = level.inverse() * position_of(ping.soundings[5], ping.world_from_sonar);
      const Vec3 last = level.inverse() * position_of(ping.soundings[ping.beam_count - 6], ping.world_from_sonar);
      EXPECT_EQ(std::abs(first.y() + last.y()) < 0.5, stabilised) << roll;
      EXPECT_GT(port, 5);
      EXPECT_GT(starboard, 5);
    }
  }
}

// A rippled bed under a sea with secondary echoes, a box that is moved onto it, and another sonar that uses the same
// ping before and after.
TEST(MultibeamCrossingTest, SeaRipplesBoxesAndAnotherSonar) {
  SonarConfig sonar = crossed_lines();
  sonar.name = "mbes";
  sonar.bin_count = 900;
  SonarConfig ahead;
  ahead.name = "ahead";
  ahead.beam_count = 32;
  ahead.bin_count = 100;
  Scenario scenario = speckled(sonar);
  scenario.sonars.push_back(ahead);
  scenario.secondary = SecondaryEchoes::kSelective;
  scenario.surface = SeaSurface{.level = 3.1};
  scenario.surface->wind_speed = 4;
  Material sand = diffuse(-24);
  sand.name = "sand";
  sand.relief = std::make_shared<const Relief>(make_relief({.ripple_wavelength = 0.6, .ripple_height = 0.05}));
  Scene bed = seabed_at(-kDepth, sand);
  bed.instances[0].reliefs = {sand.relief};
  const Scene scene =
      scene_of_all({bed, scene_of(make_box(Vec3(3, 3, 1.5)), diffuse(-15), {.position = Vec3(60, 0, -kDepth)})});
  const std::vector<MovableObject> movable = {{"diffuse"}};
  Simulator simulator(scenario, scene, 2, movable);
  Ping ping;
  PingRequest request;
  const auto depths = [&] {
    simulator.ping(0, request, ping);
    std::vector<double> heights;
    for (int beam = 8; beam < ping.beam_count - 8; ++beam) {
      const Sounding& sounding = ping.soundings[static_cast<std::size_t>(beam)];
      EXPECT_TRUE(sounding.found()) << beam;
      heights.push_back(position_of(sounding, ping.world_from_sonar).z());
      const double stretch = stretch_of(kDepth, sonar.beam_azimuth(beam), 2 * kDegree);
      if (request.moved.empty()) {
        EXPECT_NEAR(heights.back(), -kDepth, 0.06 + 0.35 * stretch) << beam;
      }
    }
    return heights;
  };
  depths();
  EXPECT_EQ(ping.phase.size(), ping.intensity.size());
  simulator.ping(1, request, ping);
  EXPECT_TRUE(ping.soundings.empty());
  EXPECT_TRUE(ping.phase.empty());
  // The box stands below and to port: its top is what is met there.
  request.moved = {{.name = "diffuse", .world_from_object = {.position = Vec3(0, 2.6, -kDepth + 0.75)}}};
  const std::vector<double> over = depths();
  const int beams = static_cast<int>(over.size());
  const int on_top = (beams - 1) / 2 - static_cast<int>(std::lround(std::atan(2.6 / (kDepth - 1.5)) / (2 * kDegree)));
  EXPECT_NEAR(over[static_cast<std::size_t>(on_top)], -kDepth + 1.5, 0.1);
  EXPECT_NEAR(over[static_cast<std::size_t>(beams - 1 - on_top)], -kDepth, 0.1);
}

// Noise alone has no bottom, and no direction either.
TEST(MultibeamCrossingTest, NoiseHasNoBottomAndNoPhase) {
  SonarConfig sonar = crossed_lines();
  sonar.dead_range = 0.4;
  Scenario scenario = speckled(sonar);
  scenario.receiver.noise = true;
  const Ping ping = ping_at(scenario, Scene{});
  int found = 0;
  for (const Sounding& sounding : ping.soundings) {
    found += sounding.found() ? 1 : 0;
  }
  EXPECT_LE(found, 1);
  for (int beam = 0; beam < ping.beam_count; beam += 15) {
    std::complex<double> sum = 0;
    int bins = 0;
    for (int bin = 50; bin < ping.bin_count; ++bin, ++bins) {
      sum += std::polar(1.0, static_cast<double>(ping.phase[ping.index(bin, beam)]));
    }
    EXPECT_LT(std::abs(sum), 3.5 * std::sqrt(bins)) << beam;
  }
}

// It has one fan, as high as elevation_aperture, and no arrays.
TEST(MultibeamCrossingTest, ThePapersModelFindsTheBottomByAmplitude) {
  SonarConfig sonar = multibeam();
  sonar.elevation_aperture = 1.5 * kDegree;
  Scenario scenario;
  scenario.model = EchoModel::kPaper;
  scenario.engine = "cpu";
  scenario.sonars = {sonar};
  // The ping was one of the other model, with phases.
  Ping ping = ping_at(speckled(crossed_lines()), seabed_at(-kDepth, diffuse(-24)));
  ASSERT_FALSE(ping.phase.empty());
  Simulator(scenario, seabed_at(-kDepth, diffuse(-24)), 1).ping(0, {}, ping);
  EXPECT_TRUE(ping.phase.empty());
  for (int beam = 6; beam < ping.beam_count - 6; ++beam) {
    const Sounding& sounding = ping.soundings[static_cast<std::size_t>(beam)];
    EXPECT_EQ(sounding.detection, Detection::kAmplitude) << beam;
    const double stretch = stretch_of(kDepth, sonar.beam_azimuth(beam), 2 * kDegree);
    EXPECT_NEAR(off_level_bed(ping, beam, -kDepth), 0, sonar.bin_length() + 0.5 * stretch) << beam;
  }
}

}  // namespace
}  // namespace insonify::validation::multibeam_crossing_test

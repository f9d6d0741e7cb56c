// gpu_reception_test.cpp -- what a card receives itself are the pings that the host makes of the same cells. With
// motion during a ping the host receives, so that a sonar that stands still shows both ways.

#include "simulator/crossing.h"

namespace insonify::gpu_reception_test {
namespace {

using namespace testing_scenes;

// Sum of the differences over the sum of the intensities: places of scatterers are rounded in another order, and 1e-5
// of a step is 1e-3 of their phase.
constexpr double kRounding = 2e-3;

// The same where volume or noise are louder than surfaces: 3e-4 is measured, the half of the bins in which hits end the
// volume is 1e-3.
constexpr double kSmoothRounding = 5e-4;

struct Case {
  const char* name;
  void (*change)(Scenario&);
  bool on_device = true;
  double lambert_db = 0;  // Of all materials, with little reflection; 0: their own.
};

Scene scene_of(const Case& of) {
  Scene scene = crossing_scene(0);
  for (Material& material : scene.materials) {
    if (of.lambert_db != 0) {
      material.lambert_db = of.lambert_db;
      material.reflection = 0.01;
    }
  }
  return scene;
}

class GpuReceptionTest : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    if (std::ranges::find(usable_engines(), "gpu") == usable_engines().end()) {
      GTEST_SKIP() << "no device of Vulkan here";
    }
  }
};

bool received_on_device(const Simulator& simulator) {
  return std::ranges::any_of(simulator.step_times(), [](const StepTime& time) { return time.step == "form_beams"; });
}

Scenario scenario_of(const Case& of) {
  Scenario scenario = crossing_scenario(kTwo, "gpu");
  scenario.receiver.azimuth_pattern = BeamPattern::kHann;
  scenario.sonars[0].source_level_db = 150;  // Weak echoes among the noise.
  of.change(scenario);
  return scenario;
}

void expect_same_counts(const Ping& device, const Ping& host) {
  ASSERT_EQ(device.counts.size(), host.counts.size());
  double apart = 0;
  for (std::size_t at = 0; at < host.counts.size(); ++at) {
    apart += std::abs(static_cast<double>(device.counts[at]) - host.counts[at]);
  }
  EXPECT_LE(apart, 0.05 * static_cast<double>(host.counts.size()));  // Of 255: few are at the limit between two.
}

void expect_same_field(const Ping& device, const Ping& host) {
  ASSERT_EQ(device.field.size(), host.field.size());
  double apart = 0, sum = 0;
  for (std::size_t at = 0; at < host.field.size(); ++at) {
    apart += double{std::norm(device.field[at] - host.field[at])};
    sum += double{std::norm(host.field[at])};
  }
  EXPECT_LE(apart, kRounding * sum);
}

// @param weak  Whether echoes may be below the unit of the card's sums: those of echo sources count as one unit where
// the
//              card adds them, and as what they are where the host does, which decides a few labels.
void expect_same_labels(const Ping& device, const Ping& host, bool weak) {
  ASSERT_EQ(device.instance.size(), host.instance.size());
  double others = 0;
  for (std::size_t at = 0; at < host.instance.size(); ++at) {
    if (device.instance[at] != host.instance[at] || device.material[at] != host.material[at]) {
      ++others;
      continue;
    }
    const float one = device.elevation[at], other = host.elevation[at];
    ASSERT_TRUE((std::isnan(one) && std::isnan(other)) || std::abs(one - other) < 1e-6F || weak) << at;
  }
  EXPECT_LE(others, weak ? 1e-3 * static_cast<double>(host.instance.size()) : 0.0);
}

TEST_P(GpuReceptionTest, GivesThePingsOfTheHostsReceiver) {
  const Scene scene = scene_of(GetParam());
  const bool weak = GetParam().lambert_db != 0;
  Scenario on_host = scenario_of(GetParam());
  on_host.motion_in_ping = true;
  Simulator device(scenario_of(GetParam()), scene, 2, crossing_objects());
  Simulator host(on_host, scene, 2, crossing_objects());
  CrossingOrders received(device.scenario(), kMoved), expected(host.scenario(), kMoved);
  for (CrossingOrders* orders : {&received, &expected}) {
    for (PingRequest& request : orders->requests) {
      request.twist = {};
      request.number += std::uint64_t{3} << 32;  // The noise of a ping depends on all of its number.
    }
  }
  device.ping(received.orders);
  EXPECT_EQ(received_on_device(device), GetParam().on_device);
  host.ping(expected.orders);
  EXPECT_FALSE(received_on_device(host));
  for (std::size_t i = 0; i < received.pings.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "ping " << i);
    EXPECT_LE(apart(expected.pings[i], received.pings[i]), weak ? kSmoothRounding : kRounding);
    expect_same_counts(received.pings[i], expected.pings[i]);
    expect_same_field(received.pings[i], expected.pings[i]);
    expect_same_labels(received.pings[i], expected.pings[i], weak);
  }
}

constexpr Case kCases[] = {
    {"Plain", [](Scenario&) {}},
    {"Silent", [](Scenario& of) { of.receiver.noise = false; }},
    {"NoPulse", [](Scenario& of) { of.receiver.pulse = PulseKind::kNone; }},
    {"LongPulse",  // Scatterers are shared between bins.
     [](Scenario& of) {
       of.receiver.pulse = PulseKind::kCw;
       of.receiver.pulse_duration = 6e-4;
     }},
    {"ChirpOfCoarseBins",
     [](Scenario& of) {
       of.receiver.pulse = PulseKind::kLfm;
       of.receiver.pulse_duration = 1e-3;
       of.receiver.decimation = Decimation::kSample;
     }},
    {"TopHat",  // Beams are cells.
     [](Scenario& of) { of.receiver.azimuth_pattern = BeamPattern::kTopHat; }},
    {"FaultyArray",  // Complex gains.
     [](Scenario& of) {
       of.receiver.elements = 48;
       of.receiver.element_error = 0.2;
       of.receiver.dead_elements = {3, 17};
     }},
    {"OutOfFocus",
     [](Scenario& of) {
       of.sonars[0].azimuth_resolution = 0.6 * kDegree;
       of.sonars[0].focus_range = 3;
       of.sonars[1].focus_range = 4;
     }},
    {"LoudVolume",  // Louder than the surfaces that end it, half-way through coarse bins.
     [](Scenario& of) {
       of.water.volume_backscatter_db = -20;
       of.receiver.noise = false;
       of.sonars[0].bin_count = of.sonars[1].bin_count = 24;
     },
     true, -70},
    {"NoiseOfTheSurface",  // Another in each beam of a sonar that lies on its side; whole blocks of bins.
     [](Scenario& of) {
       of.receiver.surface_noise = true;
       of.receiver.wind_noise = 12;
       of.sonars[0].bin_count = 128;
       of.sonars[0].orientation = {1.2, 0, 0};
       of.sonars[0].source_level_db = 100;
     },
     true, -70},
    {"Crosstalk",  // The host adds the noise.
     [](Scenario& of) {
       of.sonars[0].crosstalk_db = -30;
       of.sonars[0].missing_beams = {2};
     }},
    {"LeakCountsAndField",
     [](Scenario& of) {
       of.sonars[0].leak_db = -60;
       of.sonars[0].dead_range = 1.5;
       of.receiver.counts = of.receiver.field = true;
       of.receiver.time_varied_gain = 30;
       of.receiver.full_scale_share = 0.002;
     }},
    {"Thrusters",
     [](Scenario& of) {
       of.thrusters = {{.position = {0.6, 0.3, 0}}};
     }},
    {"SourcesOfEchoes",
     [](Scenario& of) {
       of.random_walks = 150;
       of.points = {{.position = {6, 1, -0.5}, .target_strength_db = -20}};
     }},
    {"Head", [](Scenario& of) { of.sonars.push_back(scanning_head()); }},
    {"Motion", [](Scenario& of) { of.motion_in_ping = true; }, false},
    {"Looks",  // Bins that keep the greatest of several looks.
     [](Scenario& of) {
       of.receiver.pulse = PulseKind::kCw;
       of.receiver.pulse_duration = 2e-5;
       of.receiver.decimation = Decimation::kPeak;
     },
     false},
    {"NoSpeckle", [](Scenario& of) { of.receiver.speckle = false; }, false},
    {"FullTruth", [](Scenario& of) { of.ground_truth = GroundTruth::kFull; }, false}};

// A sonar among balls that have moved. One more than so many, and the host receives.
TEST_F(GpuReceptionTest, WithManyMovedObjectsTheHostReceives) {
  constexpr int kMost = 16;
  SceneMaker maker;
  std::vector<MovableObject> objects;
  PingRequest request;
  for (int i = 0; i <= kMost; ++i) {
    const std::string name = "ball" + std::to_string(i);
    maker.add(name, make_sphere(0.3, 0.3), {.position = {5 + 0.5 * i, 0, -1}}, 0.7);
    objects.push_back({name});
    request.moved.push_back({.name = name, .world_from_object = {.position = {5 + 0.5 * i, 0.3, -1}}});
  }
  Simulator simulator(crossing_scenario(0, "gpu"), maker.scene(), 2, objects);
  (void)simulator.ping(0, request);
  EXPECT_FALSE(received_on_device(simulator));
  request.moved.pop_back();
  (void)simulator.ping(0, request);
  EXPECT_TRUE(received_on_device(simulator));
}

INSTANTIATE_TEST_SUITE_P(Cases, GpuReceptionTest, testing::ValuesIn(kCases),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace insonify::gpu_reception_test

// gpu_engine_test.cpp -- what engine `gpu` computes as `cpu` does, beside the cases of agreement_test.cpp.

#include <map>

#include "echo/model/left_out.h"
#include "echo/targets/scene_targets.h"
#include "engines/gpu_test.h"

namespace insonify::gpu_engine_test {
namespace {

using namespace testing_scenes;

// Bars as thick as the thickest thin parts: rounding decides which of their triangles are thin. Each engine must leave
// out those for which there are pieces.
TEST_F(GpuEngineTest, ThinPartsAreThoseThatCpuFinds) {
  SceneMaker maker;
  for (int i = 0; i < 40; ++i) {
    maker.add("bar" + std::to_string(i), make_box({double{ThinParts::kThickest}, double{ThinParts::kThickest}, 1}),
              {.position = {7.3 + 0.31 * (i % 8), 0.4 * i - 8.2, 0.17 * (i % 5)}});
  }
  const Scene scene = maker.scene();
  Workers workers(2);
  const auto thickness = [&](std::string_view name) {
    const std::unique_ptr<Engine> engine = make_engine(name, workers);
    engine->set_scene(scene);
    const SceneTargets targets = find_targets(scene, {}, {}, *engine, workers);
    std::vector<std::vector<float>> tables;
    for (const auto& table : targets.thin_parts->triangles->thickness) {
      tables.push_back(table ? *table : std::vector<float>());
    }
    return tables;
  };
  const std::vector<std::vector<float>> expected = thickness("cpu");
  EXPECT_TRUE(std::ranges::any_of(expected, [](const auto& table) { return !table.empty(); }));
  EXPECT_EQ(thickness("gpu"), expected);
  EXPECT_EQ(thickness("reference"), expected);
}

// 200 rows are three blocks of kSelectionRows and one of eight rows, in each of which the sum of probabilities starts
// again.
TEST_F(GpuEngineTest, LongColumnsReflectTheRaysThatCpuReflects) {
  constexpr double kRounding = 1e-3;
  const Scene scene = SceneMaker().add_floor(-3).add_wall(11).add_sphere({8, 0.5, -1}, 1).scene();
  SonarConfig sonar;
  sonar.beam_count = 24;
  sonar.bin_count = 150;
  sonar.max_range = 15;
  sonar.azimuth_aperture = 60 * kDegree;
  sonar.elevation_aperture = 40 * kDegree;
  sonar.sampling = {.columns_per_beam = 2, .rows = 200};
  ASSERT_GT(*sonar.sampling.rows, 3 * kSelectionRows);
  for (const EchoModel model : {EchoModel::kPaper, EchoModel::kCalibrated}) {
    const FlatPlanSettings settings{.sonar = sonar, .model = model, .materials = scene.materials};
    const EchoGrid cpu = echoes_of("cpu", scene, settings), gpu = echoes_of("gpu", scene, settings);
    EXPECT_GT(total(cpu, 2), 0);
    EXPECT_LE(difference(cpu, gpu, 1), kRounding);
    EXPECT_LE(difference(cpu, gpu, 2), kRounding);
  }
}

// Every second triangle loses the coherent share of its glint; every third is thin beyond a fifth of the
// range.
TEST_F(GpuEngineTest, LeavesOutTheThinPartsAndGlintsThatCpuLeavesOut) {
  constexpr double kRounding = 1e-4;
  for (const int seed : {2, 6}) {
    RandomScene random(seed);
    for (Material& material : random.scene.materials) {
      material.rms_height = 1e-4;
    }
    const FlatPlanSettings settings{.sonar = random.sonar,
                                    .model = EchoModel::kCalibrated,
                                    .materials = random.scene.materials,
                                    .secondary = SecondaryEchoes::kNone,
                                    .rough_mirrors = seed == 6};
    const float thin_beyond =
        0.2F * thin_per_metre(*make_flat_plan(settings)) * static_cast<float>(random.sonar.max_range);
    const auto left_out = std::make_shared<LeftOut>();
    for (const Instance& instance : random.scene.instances) {
      std::vector<float> thickness;
      std::vector<std::uint8_t> glinting;
      for (std::size_t triangle = 0; triangle < instance.mesh->triangles.size(); ++triangle) {
        thickness.push_back(triangle % 3 == 0 ? thin_beyond : INFINITY);
        glinting.push_back(triangle % 2);
      }
      left_out->thickness.push_back(std::make_shared<const std::vector<float>>(thickness));
      left_out->glinting.push_back(std::make_shared<const std::vector<std::uint8_t>>(glinting));
    }
    const auto echoes = [&](const char* name, bool leaves_out) {
      const auto engine = test_engine(name);
      engine->set_scene(random.scene);
      (void)echoes_of(*engine, settings, random.pose);  // With all echoes: what follows must not use what this left.
      engine->leave_out(leaves_out ? left_out : nullptr);
      return echoes_of(*engine, settings, random.pose);
    };
    const EchoGrid cpu = echoes("cpu", true);
    EXPECT_GT(difference(cpu, echoes("cpu", false), 1), 0.01);
    EXPECT_LE(difference(cpu, echoes("gpu", true), 1), kRounding) << seed;
  }
}

TEST_F(GpuEngineTest, StepsAreNamedAfterTheirShaders) {
  SonarConfig sonar;
  sonar.beam_count = 8;
  const auto steps_of = [&](EchoModel model) {
    Scenario scenario = quiet_scenario(sonar);
    scenario.engine = "gpu";
    scenario.model = model;
    Simulator simulator(scenario, SceneMaker().add_floor(-3).scene(), 1);
    (void)simulator.ping(0, PingRequest());
    std::vector<std::string_view> names;
    for (const StepTime& step : simulator.step_times()) {
      EXPECT_GE(step.seconds, 0);
      names.push_back(step.step);
    }
    return names;
  };
  EXPECT_EQ(steps_of(EchoModel::kPaper),
            (std::vector<std::string_view>{"clear", "trace_primaries", "evaluate", "select", "deposit", "reflect",
                                           "gather", "copy"}));
  EXPECT_EQ(steps_of(EchoModel::kCalibrated),
            (std::vector<std::string_view>{"clear", "trace_primaries", "turn_up", "evaluate", "select", "deposit",
                                           "mirror", "gather", "copy"}));
}

// 130 pings are three batches, of which the last has two pings.
TEST_F(GpuEngineTest, StepsTakeTheTimeOfAllBatches) {
  SonarConfig sonar;
  sonar.beam_count = 8;
  sonar.bin_count = 50;
  Scenario scenario = quiet_scenario(sonar);
  scenario.engine = "gpu";
  scenario.model = EchoModel::kPaper;
  Simulator simulator(scenario, SceneMaker().add_floor(-3).scene(), 1);
  const std::vector<PingRequest> requests(130);
  std::vector<Ping> pings(requests.size());
  const auto time_of = [&](std::size_t count) {
    simulator.ping(0, std::span(requests).first(count), std::span(pings).first(count));
    double sum = 0;
    for (const StepTime& step : simulator.step_times()) {
      sum += step.seconds;
    }
    return sum;
  };
  double two = time_of(2);  // The first time, memory is made for them.
  for (int turn = 0; turn < 4; ++turn) {
    two = std::min(two, time_of(2));
  }
  EXPECT_GT(time_of(130), 4 * two);  // 65 times as many.
}

// Faces of one mesh with materials and reliefs of their own, in two objects that share it but not these.
TEST_F(GpuEngineTest, EachFaceHasTheMaterialOfItsSlot) {
  Mesh mesh = make_plane(Vec3::UnitX(), 4, 4);
  mesh.material_slots = {0, 1};
  Scene scene = SceneMaker()
                    .add("low", mesh, {.position = {8, 0, -2}}, 0.9)
                    .add("high", mesh, {.position = {8, 0, 2}}, 0.2)
                    .scene();
  const auto material = [&](double reflectivity) {
    Material made = scene.materials[0];
    made.reflectivity = reflectivity;
    scene.materials.push_back(made);
    return static_cast<std::uint16_t>(scene.materials.size() - 1);
  };
  const auto relief = [](float slope) {
    Relief made;
    made.slopes = {1, 1, {{slope, 0}}};
    made.by_position = true;
    return std::make_shared<const Relief>(made);
  };
  for (Instance& instance : scene.instances) {
    const bool low = instance.name == "low";
    instance.materials.push_back(material(low ? 0.1 : 0.6));
    instance.reliefs = {low ? relief(0.3F) : nullptr, relief(low ? -0.5F : 0.8F)};
  }
  SonarConfig sonar;
  sonar.beam_count = 8;
  sonar.bin_count = 50;
  sonar.max_range = 15;
  sonar.azimuth_aperture = 40 * kDegree;
  sonar.elevation_aperture = 60 * kDegree;
  const FlatPlanSettings settings{.sonar = sonar, .secondary = SecondaryEchoes::kNone};
  const EchoGrid cpu = echoes_of("cpu", scene, settings), gpu = echoes_of("gpu", scene, settings);
  const auto energies = [&](const EchoGrid& grid) {
    std::map<SurfaceLabel, double> sums;
    for (int beam = 0; beam < sonar.beam_count; ++beam) {
      for (int bin = 0; bin < sonar.bin_count; ++bin) {
        grid.for_each_surface(beam, bin, [&](const SurfaceEcho& echo) { sums[echo.surface] += double{echo.energy}; });
      }
    }
    return sums;
  };
  EXPECT_LE(difference(cpu, gpu, 1), 1e-4);
  const std::map<SurfaceLabel, double> expected = energies(cpu), found = energies(gpu);
  EXPECT_EQ(expected.size(), 4U);
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [surface, energy] : expected) {
    EXPECT_NEAR(found.at(surface), energy, 1e-4 * energy);
  }
}

// A plan in the memory of another one, and a scene in that of another one, with a view that is the same.
TEST_F(GpuEngineTest, NothingIsLeftOfAnEarlierPlanOrScene) {
  const RandomScene first(4), second(6);
  Scene scene = first.scene;
  FlatPlan plan = *make_flat_plan({.sonar = first.sonar});
  Workers workers(2);
  const std::unique_ptr<Engine> engine = make_engine("gpu", workers);
  engine->set_scene(scene);
  const std::unique_ptr<EchoBatch> batch = engine->make_batch();
  const auto echoes = [&](const Pose& pose) {
    const PingView view{.plan = &plan, .world_from_sonar = pose};
    batch->start({&view, 1});
    return batch->map(0);
  };
  (void)echoes(first.pose);
  scene = second.scene;
  engine->set_scene(scene);
  expect_same_bytes(echoes(first.pose), echoes_of("gpu", second.scene, {.sonar = first.sonar}, first.pose));
  plan = *make_flat_plan({.sonar = second.sonar});
  expect_same_bytes(echoes(second.pose), echoes_of("gpu", second.scene, {.sonar = second.sonar}, second.pose));
}

// Objects that are added, moved and removed, through the simulator.
TEST_F(GpuEngineTest, ChangedScenesGiveThePingsOfCpu) {
  SonarConfig sonar;
  sonar.beam_count = 64;
  sonar.bin_count = 100;
  sonar.max_range = 20;
  std::vector<Ping> pings[2];
  for (const int which : {0, 1}) {
    Scenario scenario = quiet_scenario(sonar);
    scenario.engine = which == 0 ? "cpu" : "gpu";
    scenario.secondary = SecondaryEchoes::kSelective;
    Simulator simulator(scenario, SceneMaker().add_floor(-3).add_sphere({8, 0, -1}, 1).scene(), 1);
    const auto ping = [&] { simulator.ping(0, PingRequest(), pings[which].emplace_back()); };
    ping();
    const SceneMaker more = SceneMaker().add("box", make_box({1, 1, 1}), {.position = {12, 3, -2}});
    simulator.add_objects(more.scene());
    ping();
    simulator.remove_object("box");
    ping();
  }
  for (std::size_t i = 0; i < pings[0].size(); ++i) {
    double apart = 0, sum = 0;
    for (std::size_t cell = 0; cell < pings[0][i].intensity.size(); ++cell) {
      apart += std::abs(pings[0][i].intensity[cell] - pings[1][i].intensity[cell]);
      sum += pings[0][i].intensity[cell];
    }
    EXPECT_GT(sum, 0);
    EXPECT_LE(apart, 1e-3 * sum) << i;
  }
  EXPECT_NE(pings[1][0].intensity, pings[1][1].intensity);
  EXPECT_EQ(pings[1][0].intensity, pings[1][2].intensity);
}

// Rays that are not those of a ping, as cameras trace them.
TEST_F(GpuEngineTest, LooseRaysMeetObjectsWhereTheyWerePlaced) {
  Scene scene = SceneMaker().add_sphere({8, 0, 0}, 1).scene();
  scene.instances[0].moving = true;
  const auto engine = test_engine("gpu");
  engine->set_scene(scene);
  const std::vector<Ray> ray = {{.origin = Vec3::Zero(), .direction = Vec3::UnitX()}};
  std::vector<Hit> hit(1);
  engine->engine().trace(ray, hit);
  EXPECT_NEAR(hit[0].distance, 7, 1e-3);
  engine->move_instance(0, {.position = {5, 0, 0}});
  engine->engine().trace(ray, hit);
  EXPECT_NEAR(hit[0].distance, 4, 1e-3);
}

}  // namespace
}  // namespace insonify::gpu_engine_test

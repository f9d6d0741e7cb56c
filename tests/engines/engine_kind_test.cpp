// engine_kind_test.cpp -- properties that every engine reports and must satisfy.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "engines/random_scene.h"
#include "insonify/error.h"

namespace insonify::engine_kind_test {
namespace {

using namespace testing_scenes;

TEST(EngineKindTest, EveryEngineIsFoundByItsName) {
  std::set<std::string_view> names;
  for (const std::string_view name : usable_engines()) {
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_EQ(engine_kind(name).name, name);
    EXPECT_EQ(&test_engine(name, 1)->kind(), &engine_kind(name));
  }
  EXPECT_TRUE(names.contains("cpu") && names.contains("reference"));
}

TEST(EngineKindTest, UnknownEnginesAndThreadsAreRefused) {
  const auto message_of = [](std::string_view name, int threads) {
    try {
      (void)test_engine(name, threads);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message_of("abacus", 1),
            fmt::format("engine \"abacus\" is unknown; there are {}", fmt::join(engine_names(), ", ")));
  EXPECT_EQ(message_of("cpu", 1025), "threads = 1025 must be from 0 to 1024");
}

// An engine without a rasteriser traces its primary rays, whatever is requested.
TEST(EngineKindTest, EnginesDrawPrimariesIfTheySaySo) {
  const RandomScene random(1);
  for (const std::string_view name : usable_engines()) {
    const auto engine = test_engine(name, 2);
    engine->set_scene(random.scene);
    static_cast<void>(echoes_of(*engine, {.sonar = random.sonar, .primary = PrimaryEchoes::kRaster}, random.pose));
    EXPECT_EQ(engine->ray_counts().primary == 0, engine_kind(name).draws_primaries) << name;
  }
}

TEST(EngineKindTest, BareTraversalIsTimedOnceARepetitionOrNotAtAll) {
  const RandomScene random(1);
  const auto plan = make_flat_plan({.sonar = random.sonar});
  for (const std::string_view name : usable_engines()) {
    const auto engine = test_engine(name, 2);
    engine->set_scene(random.scene);
    const std::vector<double> seconds = engine->time_traversal(*plan, random.pose, 3);
    EXPECT_TRUE(seconds.size() == 3 || seconds.empty()) << name;
    EXPECT_TRUE(std::ranges::all_of(seconds, [](double time) { return time > 0; })) << name;
  }
  EXPECT_EQ(test_engine("reference")->time_traversal(*plan, random.pose, 3), std::vector<double>());
}

TEST(EngineKindTest, ManyPingsInOneCallAreThoseMadeOneByOne) {
  const RandomScene random(2);
  const FlatPlanSettings settings{.sonar = random.sonar, .secondary = SecondaryEchoes::kAll};
  std::vector<Pose> poses(3, random.pose);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].position.z() += 0.1 * static_cast<double>(i);
  }
  for (const std::string_view name : usable_engines()) {
    const auto engine = test_engine(name, 2);
    engine->set_scene(random.scene);
    std::vector<EchoGrid> grids(poses.size(),
                                EchoGrid(settings.sonar.beam_count, settings.sonar.bin_count, kPathOrders));
    engine->insonify_all(*make_flat_plan(settings), poses, grids);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const EchoGrid single = echoes_of(*engine, settings, poses[i]);
      for (int order = 1; order <= kPathOrders; ++order) {
        for (int beam = 0; beam < settings.sonar.beam_count; ++beam) {
          ASSERT_TRUE(std::ranges::equal(grids[i].energy(order, beam), single.energy(order, beam))) << name;
          ASSERT_TRUE(std::ranges::equal(grids[i].weight(order, beam), single.weight(order, beam))) << name;
        }
      }
    }
  }
}

}  // namespace
}  // namespace insonify::engine_kind_test

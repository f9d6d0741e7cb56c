// plan_copy_test.cpp -- a plan is plain numbers and tables: rebuilt from their bytes it gives the same echoes.

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

#include "engines/random_scene.h"
#include "engines/test_scenes.h"

namespace insonify::plan_copy_test {
namespace {

// The numbers, and the length and the values of each table.
std::vector<std::byte> bytes_of(const FlatPlan& plan) {
  std::vector<std::byte> bytes;
  const auto put = [&](const void* from, std::size_t count) {
    const auto* const first = static_cast<const std::byte*>(from);
    bytes.insert(bytes.end(), first, first + count);
  };
  const auto put_numbers = [&]<typename Numbers>(const Numbers& numbers) {
    static_assert(std::is_trivially_copyable_v<Numbers>);
    put(&numbers, sizeof numbers);
  };
  const auto put_table = [&]<typename Value>(const char* /*name*/, const std::vector<Value>& table) {
    static_assert(std::is_trivially_copyable_v<Value>);
    put_numbers(table.size());
    put(table.data(), table.size() * sizeof(Value));
  };
  FlatPlan::visit_parts(plan, put_numbers, put_table);
  return bytes;
}

FlatPlan plan_of(const std::vector<std::byte>& bytes) {
  std::size_t at = 0;
  const auto take = [&](void* to, std::size_t count) {
    std::memcpy(to, &bytes.at(at), count);
    at += count;
  };
  const auto take_numbers = [&]<typename Numbers>(Numbers& numbers) { take(&numbers, sizeof numbers); };
  const auto take_table = [&]<typename Value>(const char* /*name*/, std::vector<Value>& table) {
    std::size_t size = 0;
    take_numbers(size);
    table.resize(size);
    if (size > 0) {
      take(table.data(), size * sizeof(Value));
    }
  };
  FlatPlan plan;
  FlatPlan::visit_parts(plan, take_numbers, take_table);
  EXPECT_EQ(at, bytes.size());
  return plan;
}

EchoGrid grid_of(TestEngine& engine, const Pose& pose, const FlatPlan& plan) {
  EchoGrid grid(plan.beam_count, plan.bin_count, kPathOrders);
  engine.insonify(plan, pose, grid);
  return grid;
}

class PlanCopyTest : public testing::TestWithParam<testing_scenes::EngineAndModel> {};

TEST_P(PlanCopyTest, GivesTheSameEchoes) {
  for (int seed = 0; seed < 6; ++seed) {
    testing_scenes::RandomScene random(seed);
    Scene scene = random.scene;
    for (Material& material : scene.materials) {
      material.rms_height = 1e-4;
      if (seed % 2 == 0) {
        material.shear_speed = 1200;  // Its laws have tables over the angle of incidence.
      }
    }
    FlatPlanSettings settings{.sonar = random.sonar, .model = GetParam().model, .materials = scene.materials};
    if (GetParam().model == EchoModel::kCalibrated && seed % 3 > 0) {
      settings.elevation_array.emplace();
      settings.beam_shape = BeamShape::kCone;
      if (seed % 3 == 1) {
        settings.sent_across = ElevationWay{ArraySettings{}, 0.5 * random.sonar.elevation_aperture};
      }
    }
    const FlatPlan plan(settings);
    const FlatPlan copy = plan_of(bytes_of(plan));
    const auto engine = test_engine(GetParam().engine, 2);
    engine->set_scene(scene);
    const EchoGrid first = grid_of(*engine, random.pose, plan), second = grid_of(*engine, random.pose, copy);
    EXPECT_GT(testing_scenes::total(first, 1), 0) << seed;
    for (int order = 1; order <= kPathOrders; ++order) {
      for (int beam = 0; beam < plan.beam_count; ++beam) {
        ASSERT_TRUE(std::ranges::equal(first.energy(order, beam), second.energy(order, beam))) << seed << ' ' << beam;
        ASSERT_TRUE(std::ranges::equal(first.weight(order, beam), second.weight(order, beam))) << seed << ' ' << beam;
      }
    }
  }
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Engines, PlanCopyTest, testing::ValuesIn(testing_scenes::engines_and_models()), kName);

}  // namespace
}  // namespace insonify::plan_copy_test

// selection_test.cpp -- rays saved by `secondary: selective` on the shipped scenes, and the error of its echoes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "echo/model/flat_plan.h"
#include "insonify/files.h"
#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"
#include "support/test_engine.h"

namespace insonify::selection_test {
namespace {

// Secondary echoes of a scene's first sonar, summed over some of its pings, beside those of `all` in the first stagger
// phase.
struct Tally {
  double rays = 0;  // Reflected rays and return legs.
  double energy = 0;
  double difference = 0;  // Sum over cells of the difference from that `all`; below, of its square.
  double squares = 0, squared_difference = 0;
};

class Scan {
 public:
  explicit Scan(const std::string& name)
      : simulator_([&] {
          Scenario scenario = load_scenario(INSONIFY_SOURCE_DIR "/scenes/" + name + ".yaml");
          Scene scene = load_scene(scenario);
          return Simulator(std::move(scenario), std::move(scene), 2);
        }()) {
    engine_.set_scene(simulator_.scene());
  }

  [[nodiscard]] int phases() const { return *simulator_.sonar(0).sampling.columns_per_beam; }

  Tally tally(SecondaryEchoes secondary, int stagger_phase) {
    if (reference_.empty()) {
      for_pings(SecondaryEchoes::kAll, 0, [&](const EchoGrid& grid) { reference_.push_back(grid); });
    }
    const SonarConfig& sonar = simulator_.sonar(0);
    Tally tally;
    auto all = reference_.cbegin();
    for_pings(secondary, stagger_phase, [&](const EchoGrid& grid) {
      const RayCounts counts = engine_.ray_counts();
      tally.rays += static_cast<double>(counts.secondary + counts.return_legs);
      for (int beam = 0; beam < sonar.beam_count; ++beam) {
        for (int bin = 0; bin < sonar.bin_count; ++bin) {
          const double energy = grid.energy(2, beam)[bin];
          tally.energy += energy;
          const double apart = energy - static_cast<double>(all->energy(2, beam)[bin]);
          tally.difference += std::abs(apart);
          tally.squares += energy * energy;
          tally.squared_difference += apart * apart;
        }
      }
      ++all;
    });
    return tally;
  }

 private:
  // Calls visit(grid) with the echoes of each ping; of every fourth; of a scanning head, of every tenth.
  template <typename Visit>
  void for_pings(SecondaryEchoes secondary, int stagger_phase, const Visit& visit) {
    const Scenario& scenario = simulator_.scenario();
    SonarConfig sonar = simulator_.sonar(0);
    sonar.transmit_width.reset();  // As in the paper model.
    const FlatPlanSettings settings{.sonar = sonar,
                                    .water = scenario.water,
                                    .paper = scenario.paper,
                                    .secondary = secondary,
                                    .seed = scenario.seed,
                                    .stagger_phase = stagger_phase};
    const auto plan = make_flat_plan(settings);
    const std::uint64_t step = sonar.beam_count == 1 ? 10 : 4;
    EchoGrid grid(sonar.beam_count, sonar.bin_count, kPathOrders);
    for (std::uint64_t ping = 0; ping < static_cast<std::uint64_t>(scenario.pings); ping += step) {
      engine_.insonify(*plan, simulator_.world_from_head(0, ScenarioRequests(scenario).at(0, ping)), grid);
      visit(grid);
    }
  }

  Simulator simulator_;
  TestEngine engine_{"cpu", 2};
  std::vector<EchoGrid> reference_;  // Echoes of each ping with `all`, first stagger phase.
};

class SceneSelectionTest : public testing::TestWithParam<std::string> {};

// `selective` traces at most half the rays of `all`, within a hundredth. The sums are the same, and cells differ from
// those of `all` by less than the cells of two stagger phases of `all` differ. The squared difference is at most a
// fiftieth of that without any secondary echoes.
TEST_P(SceneSelectionTest, HalfTheRaysGiveTheSameEchoes) {
  Scan scan(GetParam());
  const Tally all = scan.tally(SecondaryEchoes::kAll, 0);
  const Tally selective = scan.tally(SecondaryEchoes::kSelective, 0);
  Tally resampled;  // The first of the other phases that differs by more; if none does, the last.
  for (int phase = 1; phase < scan.phases() && resampled.difference <= selective.difference; ++phase) {
    resampled = scan.tally(SecondaryEchoes::kAll, phase);
  }
  RecordProperty("share_of_rays", std::to_string(selective.rays / all.rays));
  RecordProperty("squared_difference", std::to_string(selective.squared_difference / all.squares));
  RecordProperty("squared_difference_of_another_phase", std::to_string(resampled.squared_difference / all.squares));
  RecordProperty("difference", std::to_string(selective.difference / all.energy));
  RecordProperty("difference_of_another_phase", std::to_string(resampled.difference / all.energy));
  ASSERT_GT(all.energy, 0);
  EXPECT_EQ(all.difference, 0);
  EXPECT_LE(selective.rays, 0.505 * all.rays);
  EXPECT_NEAR(selective.energy / all.energy, 1, 0.01);
  EXPECT_LT(selective.difference, resampled.difference);
  EXPECT_LE(selective.squared_difference, 0.02 * all.squares);  // Without any secondary echoes it is all of it.
}

// Over an even bed only few reflected rays come near the single sphere, and all of those are traced.
TEST(SelectionTest, AllRemainingRaysAreTracedWhereBoxesCullMost) {
  Scan scan("sphere");
  const Tally all = scan.tally(SecondaryEchoes::kAll, 0);
  const Tally selective = scan.tally(SecondaryEchoes::kSelective, 0);
  EXPECT_GT(all.energy, 0);
  EXPECT_LT(selective.difference, 1e-5 * all.energy);  // Packets are filled differently, which changes rounding.
  EXPECT_LT(selective.rays, 0.2 * all.rays);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneSelectionTest,
                         testing::Values("sphere", "ferry", "cooler", "car", "christmas_tree", "ssiv", "tank"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace insonify::selection_test

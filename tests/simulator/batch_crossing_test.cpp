// batch_crossing_test.cpp -- a batch gives the bytes of its pings made alone, whatever effects meet in it.

#include "engines/remote_engine.h"
#include "simulator/crossing.h"

namespace insonify::batch_crossing_test {
namespace {

using namespace testing_scenes;

class BatchCrossingTest : public testing::TestWithParam<unsigned> {};

TEST_P(BatchCrossingTest, GivesTheBytesOfPingsMadeAlone) {
  const unsigned effects = GetParam();
  const Scene scene = crossing_scene(effects);
  Simulator alone(crossing_scenario(effects, "cpu"), scene, 1, crossing_objects());
  CrossingOrders one_by_one(alone.scenario(), effects);
  for (const PingOrder& order : one_by_one.orders) {
    alone.ping({&order, 1});
  }
  for (const char* engine : {"cpu", "remote"}) {
    Simulator simulator(crossing_scenario(effects, engine), scene, 3, crossing_objects());
    if (auto* remote = dynamic_cast<RemoteEngine*>(&simulator.engine())) {
      remote->has_walks = (effects & kWalks) != 0;
    }
    CrossingOrders batch(simulator.scenario(), effects);
    for (int round = 0; round < 2; ++round) {  // The second reuses all memory.
      simulator.ping(batch.orders);
      for (std::size_t i = 0; i < batch.pings.size(); ++i) {
        SCOPED_TRACE(testing::Message() << engine << ", ping " << i << ", round " << round);
        expect_same(batch.pings[i], one_by_one.pings[i]);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Effects, BatchCrossingTest, testing::ValuesIn(kCrossings));

}  // namespace
}  // namespace insonify::batch_crossing_test

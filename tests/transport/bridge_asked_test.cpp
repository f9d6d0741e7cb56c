// bridge_asked_test.cpp -- pings that a bridge makes on request.

#include <atomic>
#include <chrono>
#include <future>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include "transport/bridge_kit.h"

namespace insonify::bridge_test {
namespace {

class BridgeAskedTest : public BridgeTest {
 protected:
  std::unique_ptr<Bridge> bridge() {
    BridgeOptions options{.scenario = "dive.yaml", .lossless = true, .quiet = true};
    options.live.driven = options.live.on_request = true;
    return std::make_unique<Bridge>(options, transport_, MessageForm::kRos1);
  }
};

// Faster than they are made, and held until their sound is back: none is lost, none comes in between.
TEST_F(BridgeAskedTest, EachPoseHasAPingOnRequest) {
  constexpr int kPoses = 12;
  const auto bridge = this->bridge();
  bridge->start();
  for (int i = 0; i < kPoses; ++i) {
    const Pose pose{Vec3(0.1 * i, 0, 0), Eigen::Quaterniond::Identity()};
    bridge->loop().drive({.world_from_vehicle = pose, .stamp = 70.0 + i});
  }
  (void)transport_.wait_for(MessageKind::kSonarImage, kPoses);
  bridge->loop().drive({.world_from_vehicle = Pose(), .stamp = 90});
  const std::vector<Sent> images = transport_.wait_for(MessageKind::kSonarImage, kPoses + 1);
  bridge->end();
  ASSERT_EQ(images.size(), std::size_t{kPoses + 1});
  for (std::size_t i = 0; i < kPoses; ++i) {
    EXPECT_EQ(images[i].time_ns, (70 + i) * 1'000'000'000) << i;
    EXPECT_EQ(sequence(images[i]), i);
  }
  EXPECT_EQ(images.back().time_ns, 90'000'000'000U);
}

// Twelve at once, and one that is refused among them; nobody reads the images.
TEST_F(BridgeAskedTest, WhoAsksForAPingGetsItsImageOrAReason) {
  constexpr int kPoses = 12, kWrong = 5;
  transport_.read = MessageKind::kPose;
  const auto bridge = this->bridge();
  bridge->start();
  std::mutex mutex;
  std::map<int, std::pair<std::size_t, std::string>> answers;  // Sizes of images, and errors.
  testing::internal::CaptureStderr();
  for (int i = 0; i < kPoses; ++i) {
    const Pose pose{Vec3(i == kWrong ? 1e9 : 0.1 * i, 0, 0), Eigen::Quaterniond::Identity()};
    bridge->ask({.world_from_vehicle = pose, .stamp = 70.0 + i}, 0,
                [&, i](const std::vector<std::byte>& image, const std::string& error) {
                  const std::lock_guard lock(mutex);
                  EXPECT_TRUE(answers.try_emplace(i, image.size(), error).second) << i;
                });
  }
  (void)transport_.wait_for(MessageKind::kPose, kPoses - 1);
  bridge->end();
  (void)testing::internal::GetCapturedStderr();
  ASSERT_EQ(answers.size(), std::size_t{kPoses});
  for (const auto& [i, answer] : answers) {
    EXPECT_EQ(answer.first > 0, i != kWrong) << i << answer.second;
    EXPECT_EQ(answer.second.empty(), i != kWrong) << i;
  }
}

TEST_F(BridgeAskedTest, WhoAsksForAPingIsAnsweredAtTheEnd) {
  transport_.takes = std::chrono::milliseconds(100);
  const auto bridge = this->bridge();
  bridge->start();
  std::atomic<int> images = 0, reasons = 0;
  for (int i = 0; i < 30; ++i) {
    bridge->ask({.world_from_vehicle = Pose(), .stamp = 70.0 + i}, 0,
                [&](const std::vector<std::byte>& /*image*/, const std::string& error) {
                  ++(error.empty() ? images : reasons);
                  EXPECT_TRUE(error.empty() || error == "the simulation ends") << error;
                });
  }
  bridge->end();
  EXPECT_EQ(images + reasons, 30);
  EXPECT_GT(reasons, 0);
}

// With the second pose the slower sonar's time has not come.
TEST_F(BridgeAskedTest, WhoAsksASonarThatDoesNotPingYetIsTold) {
  folder_.write("dive.yaml", R"(world: none
points: [{position: [3, 0.2, 0], target_strength_db: -10}]
sonars:
  - {name: fast, beam_count: 12, bin_count: 30, max_range: 6, ping_period: 0.01, sampling: {columns_per_beam: 1, rows: 4}}
  - {name: slow, beam_count: 12, bin_count: 30, max_range: 6, ping_period: 0.05, sampling: {columns_per_beam: 1, rows: 4}}
)");
  const auto bridge = this->bridge();
  bridge->start();
  for (const bool pings : {true, false}) {
    std::promise<std::string> reason;
    bridge->ask({.world_from_vehicle = Pose(), .stamp = pings ? 70.0 : 71.0}, 1,
                [&](const std::vector<std::byte>& image, const std::string& error) {
                  EXPECT_EQ(!image.empty(), pings);
                  reason.set_value(error);
                });
    EXPECT_EQ(reason.get_future().get(), pings ? "" : "the sonar does not ping yet: its ping_period is longer");
  }
}

// Nothing is waited for that will never come.
TEST_F(BridgeAskedTest, WhoAsksAfterTheEndIsAnsweredAtOnce) {
  const auto bridge = this->bridge();
  bridge->start();
  bridge->end();
  std::string reason;
  bridge->ask({.world_from_vehicle = Pose(), .stamp = 70}, 0,
              [&](const std::vector<std::byte>& image, const std::string& error) {
                EXPECT_TRUE(image.empty());
                reason = error;
              });
  EXPECT_EQ(reason, "the simulation ends");
}

}  // namespace
}  // namespace insonify::bridge_test

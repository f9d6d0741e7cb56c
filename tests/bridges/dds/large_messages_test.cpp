// large_messages_test.cpp -- messages of megabytes reach readers whose sockets hold a tenth of one.

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "bridges/dds/fast_node.h"
#include "bridges/dds/own_domain.h"
#include "dds/dds_configuration.h"
#include "dds/raw_type.h"

namespace insonify {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

TEST(SendPaceTest, LetsABurstPassAndSlowsDownWhatFollows) {
  constexpr double kRate = 65e3;
  SendPace pace(kRate);
  const auto start = Clock::now();
  pace.wait(65'000);
  pace.wait(65'000);
  EXPECT_LT(seconds_since(start), 1);  // A fragment takes 1 s at this rate: neither was waited for.
  for (int i = 0; i < 2; ++i) {
    pace.wait(65'000);
  }
  EXPECT_GE(seconds_since(start), 2 * 0.999);
}

TEST(SendPaceTest, AFragmentLargerThanABurstIsSent) {
  constexpr double kRate = 5e6;
  SendPace pace(kRate);
  const auto start = Clock::now();
  pace.wait(200'000);
  pace.wait(200'000);  // Once the first is gone.
  EXPECT_GE(seconds_since(start), 200'000 / kRate * 0.999);
}

TEST(LargeMessagesTest, ReachReadersWithTheSocketBufferThatLinuxGives) {
  constexpr std::size_t kSize = 2'000'000;
  constexpr int kMessages = 40;
  const OwnDomain domain;
  const auto number = static_cast<dds_domainid_t>(domain.number());
  const DdsEntity entered(dds_create_domain(number, dds_configuration({.local = true}).c_str()), "enter the domain");
  const DdsEntity participant(dds_create_participant(number, nullptr, nullptr), "enter the domain");
  const RawTopic topic(participant.get(), "rt/large", "sensor_msgs::msg::dds_::Image_", nullptr);
  const DdsQos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 10);
  const DdsEntity writer(dds_create_writer(participant.get(), topic.get(), qos.get(), nullptr), "write");

  // Each in a program of its own, so to speak: participants do not share their sockets.
  FastNode node(domain.number(), 0), other_node(domain.number(), 0);
  const std::string type = "sensor_msgs::msg::dds_::Image_";
  const auto reader = node.reader("rt/large", type, {.kept = 10});  // As ROS 2 has it.
  const auto best_effort = other_node.reader("rt/large", type, {.reliable = false, .kept = 10});
  ASSERT_TRUE(reader->wait_for_writer());
  ASSERT_TRUE(best_effort->wait_for_writer());
  std::this_thread::sleep_for(kDiscovery);

  SendPace pace;
  Bytes message(kSize);
  message[1] = std::byte{1};  // Little-endian.
  for (int i = 0; i < kMessages; ++i) {
    message[4] = static_cast<std::byte>(i);
    message.back() = static_cast<std::byte>(i);
    const auto start = Clock::now();
    ASSERT_EQ(write_raw(writer.get(), topic, message, pace), DDS_RETCODE_OK);
    std::this_thread::sleep_until(start + std::chrono::milliseconds(50));
  }
  EXPECT_TRUE(reader->wait_for(kMessages));
  // Without a pace 0 to 9 of 40 arrived, with it 23 to 40, on a machine with a load average of 7 to 11.
  EXPECT_GE(best_effort->messages().size(), 15U);
  const std::vector<Bytes> messages = reader->messages();
  for (std::size_t i = 0; i < messages.size(); ++i) {
    ASSERT_EQ(messages[i].size(), kSize);
    EXPECT_EQ(messages[i][4], static_cast<std::byte>(i));
    EXPECT_EQ(messages[i].back(), static_cast<std::byte>(i));
  }
}

}  // namespace
}  // namespace insonify

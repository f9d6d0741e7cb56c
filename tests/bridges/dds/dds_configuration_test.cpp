// dds_configuration_test.cpp -- what the environment of ROS 2 says acts on the bridge to DDS, and nonsense is refused.

#include "dds/dds_configuration.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "support/message_of.h"

namespace insonify {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

class DdsConfigurationTest : public testing::Test {
 protected:
  DdsConfigurationTest() { clear(); }
  ~DdsConfigurationTest() override { clear(); }

  static std::string refusal(const char* name, const char* value) {
    setenv(name, value, 1);
    const std::string text = message_of([] { (void)with_environment({}); });
    unsetenv(name);
    return text;
  }

 private:
  static void clear() {
    for (const char* name : {"ROS_DOMAIN_ID", "ROS_LOCALHOST_ONLY", "ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_STATIC_PEERS",
                             "CYCLONEDDS_URI"}) {
      unsetenv(name);
    }
  }
};

TEST_F(DdsConfigurationTest, WithoutAnEnvironmentNothingIsChanged) {
  const DdsOptions options = with_environment({});
  EXPECT_FALSE(options.domain);
  EXPECT_FALSE(options.local);
  EXPECT_TRUE(options.peers.empty());
}

TEST_F(DdsConfigurationTest, TheEnvironmentOfRos2IsRead) {
  setenv("ROS_DOMAIN_ID", "17", 1);
  setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST", 1);
  setenv("ROS_STATIC_PEERS", "192.168.7.2;;robot.local", 1);
  const DdsOptions options = with_environment({.peers = {"10.0.0.3"}});
  EXPECT_EQ(options.domain, 17);
  EXPECT_TRUE(options.local);
  EXPECT_THAT(options.peers, ElementsAre("10.0.0.3", "192.168.7.2", "robot.local"));
}

TEST_F(DdsConfigurationTest, ADomainThatIsGivenHolds) {
  setenv("ROS_DOMAIN_ID", "17", 1);
  EXPECT_EQ(with_environment({.domain = 5}).domain, 5);
}

TEST_F(DdsConfigurationTest, TheOlderNameOfLocalIsReadToo) {
  setenv("ROS_LOCALHOST_ONLY", "1", 1);
  EXPECT_TRUE(with_environment({}).local);
  setenv("ROS_LOCALHOST_ONLY", "0", 1);
  EXPECT_FALSE(with_environment({}).local);
}

TEST_F(DdsConfigurationTest, WrongValuesAreRefusedInOneLine) {
  EXPECT_EQ(refusal("ROS_DOMAIN_ID", "233"), "ROS_DOMAIN_ID = 233 must be a whole number from 0 to 232");
  EXPECT_EQ(refusal("ROS_DOMAIN_ID", "7x"), "ROS_DOMAIN_ID = 7x must be a whole number from 0 to 232");
  EXPECT_EQ(refusal("ROS_AUTOMATIC_DISCOVERY_RANGE", "NEAR"),
            "ROS_AUTOMATIC_DISCOVERY_RANGE = NEAR must be SUBNET, LOCALHOST or SYSTEM_DEFAULT");
  EXPECT_EQ(
      refusal("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF"),
      "ROS_AUTOMATIC_DISCOVERY_RANGE = OFF must be SUBNET, LOCALHOST or SYSTEM_DEFAULT: with OFF nobody would find "
      "the bridge");
}

TEST_F(DdsConfigurationTest, PeersAreAskedAndAreNoXml) {
  const std::string text = dds_configuration({.peers = {"192.168.7.2", "\"/><x a=\"&"}});
  EXPECT_THAT(text, HasSubstr("<Peer address=\"192.168.7.2\"/>"));
  EXPECT_THAT(text, HasSubstr("<Peer address=\"&quot;/&gt;&lt;x a=&quot;&amp;\"/>"));
  EXPECT_THAT(text, Not(HasSubstr("AllowMulticast")));
}

TEST_F(DdsConfigurationTest, LocalNeedsNoMulticast) {
  const std::string text = dds_configuration({.local = true});
  EXPECT_THAT(text, HasSubstr("<NetworkInterface address=\"127.0.0.1\"/>"));
  EXPECT_THAT(text, HasSubstr("<AllowMulticast>false</AllowMulticast>"));
  EXPECT_THAT(text, HasSubstr("<Peer address=\"127.0.0.1\"/>"));
}

// CycloneDDS reads pieces in order; later ones change what earlier ones say.
TEST_F(DdsConfigurationTest, WhatTheUserConfiguresComesLast) {
  setenv("CYCLONEDDS_URI", "file:///etc/cyclone.xml", 1);
  EXPECT_THAT(dds_configuration({}), EndsWith("</CycloneDDS>,file:///etc/cyclone.xml"));
}

}  // namespace
}  // namespace insonify

// bridge_program_test.cpp -- command lines of bridges whose options may come from elsewhere too.

#include "transport/bridge_program.h"

#include <gmock/gmock.h>

#include <map>

#include "console/outcome.h"
#include "support/message_of.h"

namespace insonify::bridge_program_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// Parses words for ROS 1, with options from a table.
BridgeRequest parsed(const std::vector<std::string>& words, std::map<std::string, std::vector<std::string>> more = {},
                     std::vector<std::string>* asked = nullptr) {
  return parsed_bridge(bridge_kind("ros1"), words, [&](const std::string& option) {
    if (asked != nullptr) {
      asked->push_back(option);
    }
    return more[option];
  });
}

TEST(BridgeProgramTest, OptionsComeFromTheCommandLineOrElse) {
  const BridgeRequest request =
      parsed({"dive.yaml", "--fan-height", "300", "--set", "a=1"}, {{"fan-height", {"500"}},
                                                                    {"levels", {"-95:-45"}},
                                                                    {"odometry", {"/auv/odom"}},
                                                                    {"quiet", {"true"}},
                                                                    {"rate", {"2.5"}},
                                                                    {"set", {"b=2"}}});
  EXPECT_EQ(request.bridge.scenario, "dive.yaml");
  EXPECT_EQ(request.bridge.messages.fan_height, 300);  // The command line holds.
  EXPECT_THAT(request.bridge.settings, ElementsAre("a=1"));
  EXPECT_EQ(request.bridge.messages.low_db, -95);
  EXPECT_EQ(request.bridge.messages.high_db, -45);
  EXPECT_EQ(request.bridge.live.rate_limit, 2.5);
  EXPECT_EQ(request.odometry, "/auv/odom");
  EXPECT_TRUE(request.bridge.quiet);
}

TEST(BridgeProgramTest, AnOptionThatMayBeRepeatedHasSeveralValues) {
  EXPECT_THAT(parsed({"dive.yaml"}, {{"set", {"b=2", "c=3 4"}}}).bridge.settings, ElementsAre("b=2", "c=3 4"));
}

TEST(BridgeProgramTest, AFlagIsOnWhereItsValueIsTrue) {
  EXPECT_FALSE(parsed({"dive.yaml"}, {{"quiet", {"false"}}}).bridge.quiet);
}

TEST(BridgeProgramTest, AsksForOptionsByTheirLongNamesOnce) {
  std::vector<std::string> asked;
  (void)parsed({"dive.yaml", "-q"}, {}, &asked);
  EXPECT_THAT(asked, Contains("world-frame").Times(1));
  EXPECT_THAT(asked, Contains("tf").Times(1));
  EXPECT_THAT(asked, Not(Contains("quiet")));  // It is on the command line.
  EXPECT_THAT(asked, Not(Contains("help")));
  EXPECT_THAT(asked, Not(Contains("")));
}

TEST(BridgeProgramTest, WordsForRosAreLeftToIt) {
  EXPECT_EQ(parsed({"dive.yaml", "__name:=dory", "_range:=3"}).bridge.scenario, "dive.yaml");
  EXPECT_THAT(parsed({"dive.yaml", "--set", "a=1", "__name:=dory", "--set", "b=2"}).bridge.settings,
              ElementsAre("a=1", "b=2"));
  EXPECT_THROW((void)parsed({"dive.yaml", "dory"}), InputError);
}

TEST(BridgeProgramTest, WrongValuesAreToldAsThoseOfTheCommandLine) {
  EXPECT_THAT(message_of([] { (void)parsed({"dive.yaml"}, {{"bits", {"9"}}}); }), HasSubstr("--bits"));
  EXPECT_THAT(message_of([] {
                (void)parsed({"dive.yaml", "--tf", "base_link"}, {{"odometry", {"/odom"}}});
              }),
              HasSubstr("--odometry"));
}

}  // namespace
}  // namespace insonify::bridge_program_test

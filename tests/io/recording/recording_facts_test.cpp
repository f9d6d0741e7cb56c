// recording_facts_test.cpp -- what a recording tells beside its pings: axes, units, names, the run and every setting.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "insonify/files.h"
#include "io/h5_read.h"
#include "io/recording/made_recording.h"

namespace insonify::recording_facts_test {
namespace {

using testing::ElementsAre;
constexpr double kPi = std::numbers::pi;

TEST(RecordingFactsTest, HoldsTheAxes) {
  // Three beams over 90 degrees: 30 degrees each. Four bins from 1 m to 9 m: 2 m each.
  const auto path = scratch("axes");
  record(path, fan_sonar(), 0);
  const H5Reader file(path);
  const auto near = [](double value) { return testing::DoubleNear(value, 1e-15); };
  EXPECT_THAT(file.values<double>("azimuth"), ElementsAre(near(kPi / 6), near(0), near(-kPi / 6)));
  EXPECT_THAT(file.values<double>("azimuth_edges"),
              ElementsAre(near(kPi / 4), near(kPi / 12), near(-kPi / 12), near(-kPi / 4)));
  EXPECT_THAT(file.values<double>("range"), ElementsAre(2, 4, 6, 8));
}

TEST(RecordingFactsTest, TellsUnitsAxesAndWhatStandsForNothing) {
  const auto path = scratch("units");
  record(path, fan_sonar(), 1);
  const H5Reader file(path);
  const std::vector<std::array<std::string, 3>> expected{{"intensity", "1", "ping bin beam"},
                                                         {"instance", "1", "ping bin beam"},
                                                         {"material", "1", "ping bin beam"},
                                                         {"elevation", "rad", "ping bin beam"},
                                                         {"time", "s", "ping"},
                                                         {"world_from_sonar", "m m m 1 1 1 1", "ping pose"}};
  for (const auto& [name, units, axes] : expected) {
    EXPECT_EQ(file.attribute<std::string>(name, "units"), units) << name;
    EXPECT_EQ(file.attribute<std::string>(name, "axes"), axes) << name;
    EXPECT_NE(file.attribute<std::string>(name, "description"), "") << name;
  }
  EXPECT_EQ(file.attribute<std::string>("azimuth", "units"), "rad");
  EXPECT_EQ(file.attribute<std::string>("range", "units"), "m");
  EXPECT_EQ(file.attribute<std::uint64_t>("instance", "none"), 65535U);
  EXPECT_EQ(file.attribute<std::uint64_t>("material", "none"), 65535U);
}

TEST(RecordingFactsTest, NamesWhatTheLabelsMean) {
  const auto path = scratch("names");
  record(path, fan_sonar(), 1);
  const H5Reader file(path);
  EXPECT_THAT(file.texts("instance_names"), ElementsAre("ship::hull", "seabed"));
  EXPECT_THAT(file.texts("material_names"), ElementsAre("steel"));
  EXPECT_THAT(file.values<double>("settings/materials/density"), ElementsAre(7700));
  EXPECT_THAT(file.values<double>("settings/materials/sound_speed"), ElementsAre(5900));
  EXPECT_THAT(file.values<double>("settings/materials/reflectivity"), ElementsAre(0.875));
}

TEST(RecordingFactsTest, HoldsTheRun) {
  const auto path = scratch("run");
  record(path, fan_sonar(), 1);
  const H5Reader file(path);
  EXPECT_EQ(file.attribute<std::uint64_t>("/", "format"), 1U);
  EXPECT_EQ(file.attribute<std::string>("/", "model"), "paper");
  EXPECT_EQ(file.attribute<std::string>("/", "engine"), "reference");
  EXPECT_EQ(file.attribute<std::string>("/", "primary"), "rays");
  EXPECT_EQ(file.attribute<std::string>("/", "version"), "0.2.0");
  EXPECT_EQ(file.attribute<std::uint64_t>("/", "seed"), 18'446'744'073'709'551'615U);
  EXPECT_EQ(file.attribute<std::string>("/", "scenario"), "world: wreck.sdf\nmodel: paper\n");
  EXPECT_EQ(file.attribute<std::string>("/", "sonar"), "bow");
  EXPECT_EQ(file.attribute<std::string>("/", "sonar_model"), "Märzen 7");
  EXPECT_EQ(file.attribute<double>("/", "frequency"), 455e3);
  EXPECT_EQ(file.attribute<double>("/", "sound_speed"), 1477);
  EXPECT_EQ(file.attribute<double>("/", "source_level_db"), 200);
  EXPECT_EQ(file.attribute<double>("/", "absorption_db_per_m"), scenario().water.absorption_db_per_m_at(455e3));
}

TEST(RecordingFactsTest, HoldsEverySetting) {
  const auto path = scratch("settings");
  record(path, scanning_sonar(), 1);
  const H5Reader file(path);
  const auto number = [&file](const char* name) { return file.values<double>(name).at(0); };
  const auto word = [&file](const char* name) { return file.texts(name).at(0); };
  EXPECT_EQ(word("settings/sonar/name"), "bow");
  EXPECT_EQ(word("settings/sonar/type"), "msis");
  EXPECT_EQ(word("settings/sonar/mounting"), "vertical");
  EXPECT_EQ(file.values<std::int64_t>("settings/sonar/bin_count").at(0), 4);
  EXPECT_EQ(number("settings/sonar/max_range"), 9);
  EXPECT_EQ(file.attribute<std::string>("settings/sonar/max_range", "units"), "m");
  EXPECT_EQ(file.attribute<std::string>("settings/sonar/max_range", "description"), "Far edge of the last bin.");
  EXPECT_EQ(file.attribute<std::string>("settings/sonar/azimuth_aperture", "units"), "rad");
  EXPECT_EQ(number("settings/sonar/ping_period"), 0.2);
  EXPECT_FALSE(file.has("settings/sonar/assumed_sound_speed"));
  EXPECT_THAT(file.values<double>("settings/sonar/position"), ElementsAre(1, 2, -3));
  EXPECT_EQ(file.values<std::int64_t>("settings/sonar/sampling/rows").at(0), 77);
  EXPECT_EQ(number("settings/water/salinity"), 7.5);
  EXPECT_EQ(word("settings/paper/sigmoid"), "authors");
  EXPECT_EQ(word("settings/secondary"), "all");
  EXPECT_TRUE(file.has("settings/receiver/noise"));
  const SonarConfig sonar = scanning_sonar();
  SonarConfig::visit_fields(sonar, [&](const Field& field, const auto& member) {
    const std::string name = "settings/sonar/" + std::string(field.name);
    if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(member)>>) {
      EXPECT_TRUE(file.has(name)) << name;
    }
  });
}

}  // namespace
}  // namespace insonify::recording_facts_test

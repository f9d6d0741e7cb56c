// bench_test.cpp -- output of the benchmarks; the times themselves are not tested.

#include <nlohmann/json.hpp>

#include "apps/cli.h"

namespace insonify::bench_test {
namespace {

using nlohmann::json;

class BenchTest : public CliTest {};

TEST_F(BenchTest, ThePapersTablesHaveThreeRowsASonar) {
  ASSERT_EQ(shell("insonify bench paper --samples 1 --json rows.json --markdown rows.md").status, 0);
  const json rows = json::parse(text_of("rows.json"));
  ASSERT_EQ(rows.size(), 36U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const json& row = rows[i];
    EXPECT_EQ(row.at("mode"), (std::vector<std::string>{"primary", "hybrid", "full"}[i % 3]));
    for (const char* key : {"mean_ms", "setup_ms", "pings_per_s", "floor_ms"}) {
      EXPECT_GT(row.at(key).get<double>(), 0) << key << i;
    }
    EXPECT_EQ(row.at("std_ms"), 0);  // Only one sample.
    const double samples = row.at("beams").get<double>() * 4 * 200;
    EXPECT_EQ(row.at("rays_primary"), row.at("mode") == "full" || row.at("beams") == 1 ? samples : 0) << i;
  }
  EXPECT_EQ(rows[6].at("beams"), 256);
  EXPECT_EQ(rows[6].at("bins"), 500);
  EXPECT_EQ(rows[6].at("azimuth_deg"), 120);
  EXPECT_EQ(rows[6].at("elevation_deg"), 20);
  EXPECT_THAT(text_of("rows.md"), testing::HasSubstr("| 256 x 500 | 120 x 20 | hybrid | "));
}

TEST_F(BenchTest, AFilledFanTakesHalfTheRaysOfAllOrFewer) {
  ASSERT_EQ(shell("insonify bench paper --samples 1 --scene filled --json rows.json").status, 0);
  const json rows = json::parse(text_of("rows.json"));
  for (std::size_t i = 0; i < rows.size(); i += 3) {
    const auto rays = [&](std::size_t row) { return rows[row].at("rays_secondary").get<double>(); };
    EXPECT_EQ(rays(i), 0);
    EXPECT_GT(rays(i + 1), 0);
    if (rows[i].at("beams") > 1) {
      EXPECT_LE(rays(i + 1), 0.5 * rays(i + 2)) << i;
    }
  }
}

TEST_F(BenchTest, TellsWhatTheChoiceOfPrimariesCosts) {
  ASSERT_EQ(shell("insonify bench primary --triangles 300 --repetitions 1 --json rows.json").status, 0);
  const json rows = json::parse(text_of("rows.json"));
  ASSERT_EQ(rows.size(), 4U);
  for (const json& row : rows) {
    const double rays = row.at("rays_ms"), raster = row.at("raster_ms");
    const double chosen = row.at("auto") == "rays" ? rays : raster;
    EXPECT_NEAR(row.at("regret"), chosen / std::min(rays, raster) - 1, 1e-12);
  }
}

TEST_F(BenchTest, TimesWhatChangesWhileASimulatorRuns) {
  ASSERT_EQ(shell("insonify bench changes --triangles 300 --repetitions 1 --json rows.json").status, 0);
  const json rows = json::parse(text_of("rows.json"));
  ASSERT_EQ(rows.size(), 10U);
  EXPECT_EQ(rows[1].at("change"), "set_sonar");
  EXPECT_GT(rows[1].at("change_ms").get<double>(), 0);
  for (const json& row : rows) {
    EXPECT_GT(row.at("ping_ms").get<double>(), 0);
  }
}

// A ball above a floor of steel, which mirrors it.
constexpr const char* kBall = R"(<sdf version='1.9'><model name='m'><static>true</static><link name='l'>
<visual name='ball'><pose>5 0.3 -0.8 0 0 0</pose><geometry><sphere><radius>0.5</radius></sphere></geometry></visual>
<visual name='steel'><pose>6 0 -2 0 0 0</pose><geometry><box><size>9 9 0.2</size></box></geometry></visual>
</link></model></sdf>)";

// The converged sampling among the others has no error; a coarser one has a larger error than a finer one.
TEST_F(BenchTest, SamplingHasAnErrorThatVanishesWithItsSize) {
  folder.write("ball.sdf", kBall);
  folder.write(
      "fan.yaml",
      "world: ball.sdf\nsonars:\n  - {beam_count: 32, azimuth_aperture_deg: 40, bin_count: 100, max_range: 12, "
      "orientation_deg: [0, 15, 0], sampling: {columns_per_beam: 2, rows: 30}}\n");
  const auto done = shell(
      "insonify bench sampling fan.yaml --triangles 0 --sampling 4x120 8x400 --converged 8x400 --pings 1 "
      "--repetitions 1 --json rows.json");
  ASSERT_EQ(done.status, 0) << done.err;
  const json rows = json::parse(text_of("rows.json"));
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].at("scene"), "fan");
  EXPECT_EQ(rows[0].at("columns_per_beam"), 2);
  EXPECT_EQ(rows[0].at("rows"), 30);
  EXPECT_GT(rows[1].at("rms_db").get<double>(), 0);
  EXPECT_GT(rows[0].at("rms_db").get<double>(), rows[1].at("rms_db").get<double>());
  EXPECT_GT(rows[0].at("secondary_rms_db").get<double>(), rows[1].at("secondary_rms_db").get<double>());
  EXPECT_LT(std::abs(rows[0].at("level_db").get<double>()), 1);
  for (const char* key : {"rms_db", "spots", "holes", "level_db", "secondary_rms_db", "secondary_level_db"}) {
    EXPECT_NEAR(rows[2].at(key).get<double>(), 0, 1e-5) << key;  // Every hit is followed in both, with rounded weights.
  }
  for (const json& row : rows) {
    EXPECT_GT(row.at("ping_ms").get<double>(), 0);
    EXPECT_GT(row.at("rays_secondary").get<double>(), 0);
  }
}

TEST_F(BenchTest, SamplingIsOfTheCalibratedModel) {
  const Outcome form = shell("insonify bench sampling --triangles 0 --sampling 4");
  EXPECT_EQ(form.status, 2);
  EXPECT_THAT(form.err,
              testing::HasSubstr("4 must be columns per beam, from 1 to 256, and rows, from 2 to 8192, such as "
                                 "4x200"));
  folder.write("ball.sdf", kBall);
  folder.write("paper.yaml", "world: ball.sdf\nmodel: paper\nsonars: [{max_range: 12}]\n");
  EXPECT_EQ(shell("insonify bench sampling paper.yaml --triangles 0").err,
            "insonify: paper.yaml: has model: paper; bench sampling takes scenarios of the calibrated model\n");
}

TEST_F(BenchTest, GrowthHasAnExponentBetweenRows) {
  ASSERT_EQ(
      shell("insonify bench growth --divided-by 50 --doublings 1 --repetitions 1 --threads 1 --json rows.json").status,
      0);
  const json rows = json::parse(text_of("rows.json"));
  std::vector<std::string> names;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const json& row = rows[i];
    EXPECT_GT(row.at("ping_ms").get<double>(), 0);
    EXPECT_GE(row.at("setup_ms").get<double>(), 0);
    if (const std::string grows = row.at("grows"); names.empty() || names.back() != grows) {
      names.push_back(grows);
      EXPECT_FALSE(row.contains("ping_exponent"));
      continue;
    }
    EXPECT_EQ(row.at("size").get<int>(), 2 * rows[i - 1].at("size").get<int>());
    const double ratio = row.at("ping_ms").get<double>() / rows[i - 1].at("ping_ms").get<double>();
    EXPECT_NEAR(row.at("ping_exponent").get<double>(), std::log2(ratio), 1e-9);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"beams", "focus", "bins", "range", "surfaces", "triangles", "faces",
                                             "instances"}));
  EXPECT_EQ(rows.size(), 2 * names.size());
  EXPECT_THAT(shell("insonify bench growth depth").err, testing::HasSubstr("depth"));
}

TEST_F(BenchTest, RowsThatCannotBeWrittenAreAnError) {
  const Outcome outcome = shell("insonify bench primary --triangles 300 --repetitions 1 --json none/rows.json");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "insonify: none/rows.json: cannot be written\n");
}

}  // namespace
}  // namespace insonify::bench_test

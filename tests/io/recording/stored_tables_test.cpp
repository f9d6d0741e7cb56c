// stored_tables_test.cpp -- blocks of a recording's tables are read back as they were written.

#include "insonify/stored_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "insonify/files.h"
#include "insonify/mesh.h"
#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify::stored_tables_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr int kPings = 3, kBins = 4, kBeams = 5;

// instance of ping p, bin i, beam j is 100 p + 10 i + j.
void write_recording(const std::string& path) {
  Scenario scenario;
  SonarConfig sonar;
  sonar.bin_count = kBins;
  sonar.beam_count = kBeams;
  Scene scene;
  for (const char* name : {"floor", "wreck::hull"}) {
    scene.instances.push_back({.name = name, .mesh = std::make_shared<const Mesh>(make_sphere(1))});
  }
  assign_materials(scene, {});
  Recording recording(path, scenario, scene, sonar);
  for (int number = 0; number < kPings; ++number) {
    Ping ping;
    ping.number = number;
    ping.time = number / 4.0;
    ping.bin_count = kBins;
    ping.beam_count = kBeams;
    ping.intensity.resize(kBins * kBeams);
    ping.material.resize(kBins * kBeams);
    ping.elevation.resize(kBins * kBeams);
    for (int bin = 0; bin < kBins; ++bin) {
      for (int beam = 0; beam < kBeams; ++beam) {
        ping.instance.push_back(static_cast<std::uint16_t>(100 * number + 10 * bin + beam));
      }
    }
    recording.add(ping);
  }
}

std::vector<std::uint16_t> block(const StoredTables& tables, std::vector<TableSlice> slices) {
  std::size_t count = 1;
  for (const TableSlice& slice : slices) {
    count *= slice.count;
  }
  std::vector<std::uint16_t> values(count);
  tables.read(*tables.find("instance"), slices, std::as_writable_bytes(std::span(values)));
  return values;
}

TEST(StoredTablesTest, ListTypesShapesAndUnits) {
  const WorkingFolder folder;
  write_recording("a.h5");
  const StoredTables tables("a.h5");
  const StoredTable* elevation = tables.find("elevation");
  ASSERT_NE(elevation, nullptr);
  EXPECT_EQ(elevation->type, NumberType::kFloat32);
  EXPECT_THAT(elevation->shape, ElementsAre(kPings, kBins, kBeams));
  EXPECT_TRUE(elevation->by_ping);
  EXPECT_EQ(elevation->unit, "rad");
  EXPECT_EQ(tables.find("instance")->type, NumberType::kUint16);
  EXPECT_EQ(tables.find("range")->type, NumberType::kFloat64);
  EXPECT_THAT(tables.find("range")->shape, ElementsAre(kBins));
  EXPECT_FALSE(tables.find("range")->by_ping);
  EXPECT_EQ(tables.find("shadow"), nullptr);
  EXPECT_EQ(tables.find("instance_names"), nullptr);
}

TEST(StoredTablesTest, BlocksAreRead) {
  const WorkingFolder folder;
  write_recording("a.h5");
  const StoredTables tables("a.h5");
  EXPECT_THAT(block(tables, {{2, 1}, {1, 2}, {3, 2}}), ElementsAre(213, 214, 223, 224));
  EXPECT_THAT(block(tables, {{0, 2, 2}, {0, 2, 3}, {1, 2, 3}}), ElementsAre(1, 4, 31, 34, 201, 204, 231, 234));
  EXPECT_THAT(block(tables, {{3, 0}, {0, 4}, {0, 5}}), IsEmpty());
}

TEST(StoredTablesTest, TextsAreRead) {
  const WorkingFolder folder;
  write_recording("a.h5");
  const StoredTables tables("a.h5");
  EXPECT_THAT(tables.texts("instance_names"), ElementsAre("floor", "wreck::hull"));
  EXPECT_THAT(tables.texts("nothing"), IsEmpty());
  EXPECT_EQ(message_of([&] { (void)tables.texts("range"); }), "a.h5: range must hold texts");
}

TEST(StoredTablesTest, BlocksThatAreNotThereAreRefused) {
  const WorkingFolder folder;
  write_recording("a.h5");
  const StoredTables tables("a.h5");
  const std::string text = "a.h5: instance does not have that block";
  EXPECT_EQ(message_of([&] { block(tables, {{0, 4}, {0, 1}, {0, 1}}); }), text);
  EXPECT_EQ(message_of([&] { block(tables, {{0, 1}, {1, 2, 3}, {0, 1}}); }), text);
  EXPECT_EQ(message_of([&] { block(tables, {{0, 1}, {0, 1}}); }), text);
  EXPECT_EQ(message_of([&] { block(tables, {{0, 1}, {0, 1}, {0, 1, 0}}); }), text);
  EXPECT_EQ(message_of([] { StoredTables("none.h5"); }), "none.h5: no such file");
}

}  // namespace
}  // namespace insonify::stored_tables_test

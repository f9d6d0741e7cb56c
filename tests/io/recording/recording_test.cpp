// recording_test.cpp -- a recording contains the pings and the settings they were made with.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <new>
#include <numbers>
#include <span>

#include "insonify/error.h"
#include "insonify/files.h"
#include "io/h5_read.h"
#include "io/recording/made_recording.h"

namespace {
// Counts the allocations of this program.
std::size_t allocation_count = 0;
}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocation_count;
  if (void* memory = std::malloc(size > 0 ? size : 1)) {
    return memory;
  }
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace insonify::recording_test {
namespace {

using testing::ElementsAre;
constexpr double kPi = std::numbers::pi;

template <typename Act>
std::string message_of(Act&& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "no Error";
}

TEST(RecordingTest, HoldsEveryPing) {
  const auto path = scratch("pings");
  record(path, fan_sonar(), 2);
  const H5Reader file(path);
  for (const char* cells : {"intensity", "instance", "material", "elevation"}) {
    EXPECT_EQ(file.shape(cells), (std::vector<hsize_t>{2, 4, 3})) << cells;
  }
  for (const std::uint64_t number : {0U, 1U}) {
    const Ping ping = make_ping(fan_sonar(), number);
    EXPECT_EQ(file.row<float>("intensity", number), ping.intensity);
    EXPECT_EQ(file.row<std::uint16_t>("instance", number), ping.instance);
    EXPECT_EQ(file.row<std::uint16_t>("material", number), ping.material);
    EXPECT_THAT(file.row<float>("elevation", number),
                testing::Pointwise(testing::NanSensitiveFloatEq(), ping.elevation));
  }
  EXPECT_THAT(file.values<double>("time"), ElementsAre(0, 0.5));
  EXPECT_EQ(file.shape("world_from_sonar"), (std::vector<hsize_t>{2, 7}));
  EXPECT_THAT(file.row<double>("world_from_sonar", 1), ElementsAre(1, 1.25, 1.5, 0.5, -0.5, 0.5, -0.5));
  EXPECT_FALSE(file.has("head_angle"));
}

TEST(RecordingTest, HoldsTheHeadAngleOfAScanningSonar) {
  const auto path = scratch("scan");
  record(path, scanning_sonar(), 3);
  const H5Reader file(path);
  EXPECT_THAT(file.values<double>("head_angle"), ElementsAre(0, -0.125, -0.25));
  EXPECT_EQ(file.shape("intensity"), (std::vector<hsize_t>{3, 4, 1}));
  EXPECT_EQ(file.attribute<std::string>("head_angle", "units"), "rad");
}

TEST(RecordingTest, HoldsTheSoundingsOfAMultibeam) {
  record(scratch("swath"), swath_sonar(), 2);
  const H5Reader file(scratch("swath"));
  for (const char* name :
       {"range", "uncertainty", "quality", "intensity", "snippet_begin", "snippet_end", "detection"}) {
    EXPECT_EQ(file.shape(std::string("sounding_") + name), (std::vector<hsize_t>{2, 3})) << name;
  }
  EXPECT_THAT(file.values<double>("sounding_range"), ElementsAre(0, 0.5, 1, 1, 1.5, 2));
  EXPECT_THAT(file.values<double>("sounding_snippet_end"), ElementsAre(2, 3, 4, 2, 3, 4));
  EXPECT_THAT(file.values<double>("sounding_detection"), ElementsAre(1, 2, 1, 1, 2, 1));
  EXPECT_EQ(file.attribute<std::string>("sounding_range", "units"), "m");
  EXPECT_EQ(file.attribute<std::string>("sounding_range", "axes"), "ping beam");
}

TEST(RecordingTest, HoldsAsMuchGroundTruthAsIsAskedFor) {
  const std::vector<std::string> labels{"instance", "material", "elevation"};
  const std::vector<std::string> rest{"strongest_instance", "strongest_share", "elevation_spread",
                                      "path_order",         "shadow",          "direct_intensity"};
  for (const GroundTruth truth : {GroundTruth::kNone, GroundTruth::kLabels, GroundTruth::kFull}) {
    const auto path = scratch("truth");
    record(path, scanning_sonar(), 2, truth);  // A head angle gives the largest possible number of datasets.
    const H5Reader file(path);
    for (const std::string& name : labels) {
      EXPECT_EQ(file.has(name), truth != GroundTruth::kNone) << name;
    }
    for (const std::string& name : rest) {
      EXPECT_EQ(file.has(name), truth == GroundTruth::kFull) << name;
    }
    EXPECT_THAT(file.values<double>("head_angle"), ElementsAre(0, -0.125));
  }
  EXPECT_EQ(H5Reader(scratch("truth")).texts("settings/ground_truth").at(0), "full");
}

TEST(RecordingTest, HoldsTheFullGroundTruth) {
  const auto path = scratch("full");
  record(path, fan_sonar(), 2, GroundTruth::kFull);
  const H5Reader file(path);
  const Ping ping = make_ping(fan_sonar(), 1);
  for (const char* ranked : {"strongest_instance", "strongest_share"}) {
    EXPECT_EQ(file.shape(ranked), (std::vector<hsize_t>{2, 4, 3, 3})) << ranked;
    EXPECT_EQ(file.attribute<std::string>(ranked, "axes"), "ping bin beam rank") << ranked;
  }
  EXPECT_EQ(file.row<std::uint16_t>("strongest_instance", 1), ping.strongest_instance);
  EXPECT_EQ(file.row<float>("strongest_share", 1), ping.strongest_share);
  EXPECT_EQ(file.row<float>("elevation_spread", 1), ping.elevation_spread);
  EXPECT_EQ(file.row<std::uint8_t>("path_order", 1), ping.path_order);
  EXPECT_EQ(file.row<float>("shadow", 1), ping.shadow);
  EXPECT_EQ(file.row<float>("direct_intensity", 1), ping.direct_intensity);
  EXPECT_EQ(file.attribute<std::uint64_t>("strongest_instance", "none"), 65535U);
  EXPECT_EQ(file.attribute<std::string>("elevation_spread", "units"), "rad");
  for (const char* cells : {"strongest_share", "elevation_spread", "path_order", "shadow", "direct_intensity"}) {
    EXPECT_NE(file.attribute<std::string>(cells, "description"), "") << cells;
  }
}

TEST(RecordingTest, IsReadByH5py) {
  for (const auto& [name, sonar] : {std::pair{"h5py_fan", fan_sonar()}, std::pair{"h5py_scan", scanning_sonar()}}) {
    const auto path = scratch(name);
    record(path, sonar, 2, GroundTruth::kFull);
    const std::string command =
        std::string(INSONIFY_PYTHON) + " " INSONIFY_SOURCE_DIR "/tests/io/read_recording.py " + path.string();
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
  }
}

// For any number of threads that compress.
TEST(RecordingTest, HoldsTheSameWhenItIsCompressed) {
  const auto plain = scratch("plain"), compressed = scratch("compressed"), other = scratch("compressed_otherwise");
  record(plain, large_sonar(), 70, GroundTruth::kFull);
  record(compressed, large_sonar(), 70, GroundTruth::kFull, {.compress = true, .threads = 4});
  record(other, large_sonar(), 70, GroundTruth::kFull, {.compress = true, .threads = 1});
  EXPECT_TRUE(bytes_of(compressed) == bytes_of(other));
  EXPECT_LT(2 * std::filesystem::file_size(compressed), std::filesystem::file_size(plain));
  const H5Reader a(plain), b(compressed);
  const auto expect_same = [&](const char* name, auto value) {
    using Value = decltype(value);
    const std::vector<Value> of_a = a.values<Value>(name), of_b = b.values<Value>(name);
    // Compares bytes, since NaN differs from itself.
    EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(of_a)), std::as_bytes(std::span(of_b)))) << name;
  };
  for (const char* name : {"intensity", "elevation", "strongest_share", "elevation_spread", "shadow"}) {
    expect_same(name, float{});
  }
  expect_same("instance", std::uint16_t{});
  expect_same("strongest_instance", std::uint16_t{});
  expect_same("path_order", std::uint8_t{});
  expect_same("world_from_sonar", double{});
  expect_same("time", double{});
}

TEST(RecordingTest, IsTheSameBytesForTheSamePings) {
  record(scratch("once"), fan_sonar(), 3);
  record(scratch("again"), fan_sonar(), 3);
  EXPECT_TRUE(bytes_of(scratch("once")) == bytes_of(scratch("again")));
}

TEST(RecordingTest, AllocatesNothingWhilePingsCome) {
  for (const bool compress : {false, true}) {
    SonarConfig sonar = large_sonar();
    sonar.type = compress ? SonarType::kForwardLooking : SonarType::kMultibeam;
    Recording recording(fresh("allocations"), scenario(), scene(), sonar, {.compress = compress, .threads = 1});
    const Ping ping = make_ping(sonar, 0);
    recording.add(ping);
    recording.add(ping);
    const std::size_t before = allocation_count;
    recording.add(ping);
    recording.add(ping);
    EXPECT_EQ(allocation_count, before) << compress;
  }
}

TEST(RecordingTest, RefusesPingsOfAnotherShape) {
  const auto path = fresh("shape");
  Recording recording(path, scenario(), scene(), fan_sonar());
  EXPECT_EQ(message_of([&] { recording.add(make_ping(scanning_sonar(), 8)); }),
            path.string() + ": ping 8 has 4 bins x 1 beam, the recording 4 x 3");
  Ping truncated = make_ping(fan_sonar(), 9);
  truncated.elevation.pop_back();
  EXPECT_EQ(message_of([&] { recording.add(truncated); }),
            path.string() + ": ping 9 holds 11 values of elevation, not 12");
  Scenario full = scenario();
  full.ground_truth = GroundTruth::kFull;
  Ping unranked = make_ping(fan_sonar(), 9);
  unranked.strongest_share.resize(12);
  EXPECT_EQ(message_of([&] { Recording(fresh("ranks"), full, scene(), fan_sonar()).add(unranked); }),
            scratch("ranks").string() + ": ping 9 holds 12 values of strongest_share, not 36");
}

TEST(RecordingTest, LeavesAnEarlierOneAloneUntilItIsClosed) {
  const auto path = fresh("earlier");
  record(path, fan_sonar(), 3);
  EXPECT_EQ(message_of([&] { Recording(path, scenario(), scene(), fan_sonar()); }),
            path.string() + ": cannot create: it exists already");
  Recording next(path, scenario(), scene(), fan_sonar(), {.replace = true});
  next.add(make_ping(fan_sonar(), 0));
  EXPECT_EQ(H5Reader(path).shape("time").at(0), 3U);
  EXPECT_EQ(H5Reader(next.place()).shape("time").at(0), 1U);
  next.close();
  EXPECT_EQ(next.place(), path);
  EXPECT_EQ(H5Reader(path).shape("time").at(0), 1U);
}

// Smaller when compressed or stopped.
TEST(RecordingTest, NeedsNoMoreOnTheDiskThanForetold) {
  for (const SonarConfig& sonar : {fan_sonar(), large_sonar(), scanning_sonar(), swath_sonar()}) {
    for (const int pings : {0, 1, 300}) {
      const auto path = fresh("foretold");
      record(path, sonar, pings);
      const std::uint64_t foretold = recording_bytes(scenario(), sonar, pings);
      EXPECT_LE(std::filesystem::file_size(path), foretold) << pings;
      EXPECT_LT(foretold, std::filesystem::file_size(path) + 250'000 + pings * 1500) << pings;
    }
  }
}

TEST(RecordingTest, KeepsItsPingsWhenMoved) {
  const auto path = fresh("moved");
  Recording first(path, scenario(), scene(), fan_sonar());
  first.add(make_ping(fan_sonar(), 0));
  Recording second = std::move(first);
  second.add(make_ping(fan_sonar(), 1));
  EXPECT_THAT(H5Reader(path).values<double>("time"), ElementsAre(0, 0.5));
}

}  // namespace
}  // namespace insonify::recording_test

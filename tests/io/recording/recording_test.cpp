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
#include "support/test_files.h"

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

namespace insonify {
namespace {

using testing::ElementsAre;
constexpr double kPi = std::numbers::pi;

SonarConfig fan_sonar() {
  SonarConfig sonar;
  sonar.name = "bow";
  sonar.model = "Märzen 7";  // Not ASCII.
  sonar.frequency = 455e3;
  sonar.beam_count = 3;
  sonar.azimuth_aperture = kPi / 2;
  sonar.bin_count = 4;
  sonar.min_range = 1;
  sonar.max_range = 9;
  sonar.ping_period = 0.2;
  sonar.position = {1, 2, -3};
  sonar.sampling.rows = 77;
  return sonar;
}

SonarConfig scanning_sonar() {
  SonarConfig sonar = fan_sonar();
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.mounting = Mounting::kVertical;
  return sonar;
}

// With datasets large enough to be compressed.
SonarConfig large_sonar() {
  SonarConfig sonar = fan_sonar();
  sonar.beam_count = 24;
  sonar.bin_count = 60;
  return sonar;
}

Scenario scenario() {
  Scenario scenario;
  scenario.model = EchoModel::kPaper;
  scenario.text = "world: wreck.sdf\nmodel: paper\n";
  scenario.engine = "reference";
  scenario.seed = 18'446'744'073'709'551'615U;
  scenario.secondary = SecondaryEchoes::kAll;
  scenario.water.salinity = 7.5;
  scenario.water.sound_speed = 1477;
  scenario.paper.sigmoid = Sigmoid::kAuthors;
  scenario.receiver.noise = false;
  return scenario;
}

Scene scene() {
  Scene scene;
  for (const char* name : {"ship::hull", "seabed"}) {
    scene.instances.emplace_back();
    scene.instances.back().name = name;
    scene.instances.back().mesh = std::make_shared<const Mesh>();
  }
  scene.materials.push_back(
      {.name = "steel", .density = 7700, .sound_speed = 5900, .reflectivity = 0.875, .source = ""});
  return scene;
}

// Every value encodes its ping and its cell.
Ping make_ping(const SonarConfig& sonar, std::uint64_t number) {
  Ping ping;
  ping.number = number;
  const auto n = static_cast<double>(number);
  ping.time = 0.5 * n;
  ping.world_from_sonar.position = {n, n + 0.25, n + 0.5};
  ping.world_from_sonar.orientation = {0.5, -0.5, 0.5, -0.5};
  ping.head_angle = -0.125 * n;
  ping.bin_count = sonar.bin_count;
  ping.beam_count = sonar.beam_count;
  for (int cell = 0; cell < sonar.bin_count * sonar.beam_count; ++cell) {
    ping.intensity.push_back(static_cast<float>(100 * number) + static_cast<float>(cell));
    ping.instance.push_back(cell % 2 == 0 ? kNoLabel : static_cast<std::uint16_t>(cell + 1));
    ping.material.push_back(static_cast<std::uint16_t>(cell + 2));
    ping.elevation.push_back(cell % 2 == 0 ? std::nanf("") : -0.5F * static_cast<float>(cell));
    for (int rank = 0; rank < kStrongestCount; ++rank) {
      ping.strongest_instance.push_back(static_cast<std::uint16_t>(3 * cell + rank));
      ping.strongest_share.push_back(0.25F * static_cast<float>(cell) / static_cast<float>(1 + rank));
    }
    ping.elevation_spread.push_back(0.125F * static_cast<float>(cell));
    ping.path_order.push_back(static_cast<std::uint8_t>(cell % 4));
    ping.shadow.push_back(1 / static_cast<float>(1 + cell));
    ping.direct_intensity.push_back(static_cast<float>(10 * number) + static_cast<float>(cell));
  }
  return ping;
}

std::filesystem::path scratch(const std::string& name) {
  return process_folder() / ("recording_test_" + name + ".h5");
}

// Likewise, after removing what an earlier test has left.
std::filesystem::path fresh(const std::string& name) {
  const std::filesystem::path path = scratch(name);
  std::filesystem::remove(path);
  return path;
}

void record(const std::filesystem::path& path, const SonarConfig& sonar, std::uint64_t pings,
            GroundTruth ground_truth = GroundTruth::kLabels, const RecordingOptions& options = {}) {
  Scenario recorded = scenario();
  recorded.ground_truth = ground_truth;
  std::filesystem::remove(path);
  Recording recording(path, recorded, scene(), sonar, options);
  for (std::uint64_t number = 0; number < pings; ++number) {
    recording.add(make_ping(sonar, number));
  }
  recording.close();
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

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

TEST(RecordingTest, HoldsTheAxes) {
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

TEST(RecordingTest, TellsUnitsAxesAndWhatStandsForNothing) {
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

TEST(RecordingTest, NamesWhatTheLabelsMean) {
  const auto path = scratch("names");
  record(path, fan_sonar(), 1);
  const H5Reader file(path);
  EXPECT_THAT(file.texts("instance_names"), ElementsAre("ship::hull", "seabed"));
  EXPECT_THAT(file.texts("material_names"), ElementsAre("steel"));
  EXPECT_THAT(file.values<double>("settings/materials/density"), ElementsAre(7700));
  EXPECT_THAT(file.values<double>("settings/materials/sound_speed"), ElementsAre(5900));
  EXPECT_THAT(file.values<double>("settings/materials/reflectivity"), ElementsAre(0.875));
}

TEST(RecordingTest, HoldsTheRun) {
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

TEST(RecordingTest, HoldsEverySetting) {
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
    const SonarConfig sonar = large_sonar();
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
            path.string() + ": cannot create: it is there already");
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
  for (const SonarConfig& sonar : {fan_sonar(), large_sonar(), scanning_sonar()}) {
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
}  // namespace insonify

// recorded_pings.cpp -- finds the tables of a ping, and reads one row of each.

#include "insonify/recorded_pings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/sounding_columns.h"
#include "io/recorded/open_recording.h"

namespace insonify {
namespace {

template <typename Number>
std::vector<double> widened(std::span<const std::byte> bytes) {
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return {numbers.begin(), numbers.end()};
}

// Numbers of a table's type.
std::vector<double> numbers_of(const RecordedTable& table, std::span<const std::byte> bytes) {
  using Read = std::vector<double> (*)(std::span<const std::byte>);
  static constexpr std::pair<std::string_view, Read> kTypes[] = {
      {"f4", widened<float>},         {"f8", widened<double>},        {"u1", widened<std::uint8_t>},
      {"u2", widened<std::uint16_t>}, {"u4", widened<std::uint32_t>}, {"u8", widened<std::uint64_t>},
      {"i1", widened<std::int8_t>},   {"i2", widened<std::int16_t>},  {"i4", widened<std::int32_t>},
      {"i8", widened<std::int64_t>}};
  const std::string_view type = std::string_view(table.type).substr(1);
  const auto* found = std::ranges::find(kTypes, type, &std::pair<std::string_view, Read>::first);
  return found == std::end(kTypes) ? std::vector<double>() : found->second(bytes);
}

// Bins and beams of a table.
std::array<std::uint64_t, 2> shape_of(const RecordedTable& table, const std::filesystem::path& path) {
  constexpr std::uint64_t kMost = 1'000'000;  // Bins or beams: more would be some other table.
  const std::size_t axes = table.row.size() + (table.by_ping ? 1 : 0);
  if (!table.by_ping || axes != 3) {
    throw Error(fmt::format("{}: {} has {}; a recording has three: ping, bin, beam", path.string(), table.name,
                            axes == 1 ? "1 axis" : fmt::format("{} axes", axes)));
  }
  const std::uint64_t bins = table.row[0], beams = table.row[1];
  if (bins < 1 || beams < 1 || bins > kMost || beams > kMost) {
    throw Error(fmt::format("{}: {} has {} bins and {} beams; a recording has from 1 to {} of each", path.string(),
                            table.name, bins, beams, kMost));
  }
  return {bins, beams};
}

// Greatest number of a table's type; 1 for floating-point numbers, which have no full scale.
double full_scale_of(const RecordedTable& table) {
  constexpr int kBitsAByte = 8;
  const int bits = kBitsAByte * static_cast<int>(table.value_bytes);
  return table.type[1] == 'f' ? 1 : std::ldexp(1, table.type[1] == 'i' ? bits - 1 : bits) - 1;
}

}  // namespace

struct RecordedPings::State {
  std::unique_ptr<RecordedTables> tables;
  std::array<std::uint64_t, 2> shape{};  // Bins, beams.
  double full_scale = 1;
  std::string sonar = {}, model = {};
  mutable std::vector<double> azimuths = {};  // Of the beams; once asked for.

  [[nodiscard]] std::string path() const { return tables->path().string(); }

  // An attribute that is a list of texts.
  [[nodiscard]] std::vector<std::string> texts(const char* attribute) const {
    std::vector<std::string> texts;
    if (const auto found = tables->attributes().find(attribute);
        found != tables->attributes().end() && found->is_array()) {
      std::ranges::for_each(*found, [&](const nlohmann::json& text) { texts.push_back(text.is_string() ? text : ""); });
    }
    return texts;
  }

  // Centres of the beams [rad].
  const std::vector<double>& beam_azimuths() const {
    if (azimuths.empty()) {
      const RecordedTable& table = tables->table("azimuth");
      azimuths = numbers_of(table, tables->row(table, 0));
      if (table.by_ping || azimuths.size() != shape[1]) {
        throw Error(fmt::format("{}: azimuth must have a number for each beam", path()));
      }
    }
    return azimuths;
  }

  // `width` numbers for each ping.
  [[nodiscard]] std::vector<double> row(const std::string& name, std::uint64_t ping, std::uint64_t width) const {
    const RecordedTable* table = tables->find(name);
    std::vector<double> numbers;
    if (table != nullptr && table->by_ping && table->row_bytes() == width * table->value_bytes) {
      numbers = numbers_of(*table, tables->row(*table, ping));
    }
    if (numbers.size() != width) {
      throw Error(fmt::format("{}: {} must have {} for each ping", path(), name,
                              width == 1 ? "a number" : fmt::format("{} numbers", width)));
    }
    return numbers;
  }
};

RecordedPings::RecordedPings(const std::filesystem::path& path, const std::string& sonar)
    : state_(std::make_unique<State>(State{.tables = open_tables(path, sonar)})) {
  const RecordedTable* intensity = state_->tables->find("intensity");
  if (intensity == nullptr) {
    throw Error(fmt::format("{}: intensity must hold numbers", path.string()));
  }
  state_->shape = shape_of(*intensity, path);
  state_->full_scale = full_scale_of(*intensity);
  state_->sonar = state_->tables->text("sonar");
  state_->model = state_->tables->text("model");
}

RecordedPings::~RecordedPings() = default;
RecordedPings::RecordedPings(RecordedPings&&) noexcept = default;
RecordedPings& RecordedPings::operator=(RecordedPings&&) noexcept = default;

std::uint64_t RecordedPings::ping_count() const {
  return state_->tables->ping_count();
}

int RecordedPings::bin_count() const {
  return static_cast<int>(state_->shape[0]);
}

int RecordedPings::beam_count() const {
  return static_cast<int>(state_->shape[1]);
}

const std::string& RecordedPings::sonar() const {
  return state_->sonar;
}

const std::string& RecordedPings::model() const {
  return state_->model;
}

double RecordedPings::full_scale() const {
  return state_->full_scale;
}

std::vector<double> RecordedPings::intensity(std::uint64_t ping) const {
  return state_->row("intensity", ping, state_->shape[0] * state_->shape[1]);
}

std::string RecordedPings::foreign_format() const {
  return state_->tables->text("format");
}

std::vector<std::string> RecordedPings::sonars() const {
  return state_->texts("sonars");
}

std::vector<std::string> RecordedPings::notes() const {
  return state_->texts("notes");
}

std::vector<std::string> RecordedPings::assumed() const {
  return state_->texts("assumed");
}

std::optional<double> RecordedPings::altitude(std::uint64_t ping) const {
  if (state_->tables->find("altitude") == nullptr) {
    return std::nullopt;
  }
  const double altitude = state_->row("altitude", ping, 1)[0];
  return altitude > 0 ? std::optional(altitude) : std::nullopt;
}

std::optional<GeographicPoint> RecordedPings::origin() const {
  const nlohmann::json& attributes = state_->tables->attributes();
  const auto found = attributes.find("origin");
  if (found == attributes.end() || !found->is_array() || found->size() != 2 || !found->at(0).is_number() ||
      !found->at(1).is_number()) {
    return std::nullopt;
  }
  const GeographicPoint origin{found->at(0).get<double>(), found->at(1).get<double>()};
  check_origin(origin);
  return origin;
}

double RecordedPings::greatest_count() const {
  return state_->tables->find("counts") != nullptr ? std::ldexp(1, sonar_config().bits) - 1 : 0;
}

std::vector<double> RecordedPings::counts(std::uint64_t ping) const {
  if (shape_of(state_->tables->table("counts"), state_->path()) != state_->shape) {
    throw Error(fmt::format("{}: counts and intensity have different sizes", state_->path()));
  }
  return state_->row("counts", ping, state_->shape[0] * state_->shape[1]);
}

SonarConfig RecordedPings::sonar_config() const {
  return state_->tables->sonar_config();
}

ReceiverConfig RecordedPings::receiver_config() const {
  return state_->tables->receiver_config();
}

std::vector<Sounding> RecordedPings::soundings(std::uint64_t ping) const {
  std::vector<Sounding> soundings;
  if (!has_soundings()) {
    return soundings;
  }
  soundings.resize(state_->shape[1]);
  for (const SoundingColumn& column : sounding_columns()) {
    column.restore(state_->row(column.name, ping, soundings.size()), soundings);
  }
  const std::vector<double>& azimuths = state_->beam_azimuths();
  for (std::size_t beam = 0; beam < soundings.size(); ++beam) {
    soundings[beam].azimuth = static_cast<float>(azimuths[beam]);
  }
  return soundings;
}

bool RecordedPings::has_soundings() const {
  return state_->tables->find("sounding_range") != nullptr;
}

Pose RecordedPings::pose(std::uint64_t ping) const {
  const std::vector<double> pose = state_->row("world_from_sonar", ping, 7);
  return {Vec3(pose[0], pose[1], pose[2]), Eigen::Quaterniond(pose[3], pose[4], pose[5], pose[6])};
}

Ping RecordedPings::ping(std::uint64_t number) const {
  const std::vector<double> values = intensity(number);
  Ping ping;
  ping.number = number;
  ping.bin_count = bin_count();
  ping.beam_count = beam_count();
  ping.intensity.assign(values.begin(), values.end());
  for (const float value : ping.intensity) {
    if (!(value >= 0) || !std::isfinite(value)) {
      throw Error(fmt::format("{} ping {}: an intensity is {:.6g}, must be at least 0 and finite", state_->path(),
                              number, value));
    }
  }
  ping.time = state_->row("time", number, 1)[0];
  ping.world_from_sonar = pose(number);
  if (state_->tables->find("head_angle") != nullptr) {
    ping.head_angle = state_->row("head_angle", number, 1)[0];
  }
  ping.soundings = soundings(number);
  return ping;
}

}  // namespace insonify

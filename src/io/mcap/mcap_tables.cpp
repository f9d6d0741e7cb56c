// mcap_tables.cpp -- makes rows of tables from pings and from the settings in the metadata.

#include "io/mcap/mcap_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "io/mcap/mcap_metadata.h"
#include "io/message/cdr_reader.h"

namespace insonify {
namespace {

template <typename Number>
std::vector<std::byte> bytes_of(const std::vector<Number>& values) {
  const auto bytes = std::as_bytes(std::span(values));
  return {bytes.begin(), bytes.end()};
}

std::vector<std::byte> bytes_of(const Pose& pose) {
  const Vec3& p = pose.position;
  const Eigen::Quaterniond& q = pose.orientation;
  return bytes_of(std::vector<double>{p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()});
}

}  // namespace

std::string levels_text(const MessageLevels& levels, int bits) {
  const int steps = (1 << bits) - 1;
  if (!levels.decibels) {
    return fmt::format("linear from 0 to 1 in {} steps", steps);
  }
  return fmt::format("{:.6g} to {:.6g} dB in steps of {:.2g} dB{}; 0 below, cut above", levels.low_db, levels.high_db,
                     (levels.high_db - levels.low_db) / steps,
                     levels.gain_per_decade == 0
                         ? ""
                         : fmt::format(", with {:.6g} dB a decade of range added", levels.gain_per_decade));
}

nlohmann::json mcap_run_facts(const McapReader& file, const std::filesystem::path& path) {
  const auto about = file.metadata().find(mcap_metadata::kRun);
  if (about == file.metadata().end()) {
    throw Error(
        fmt::format("{}: was not recorded by insonify: it has no metadata {}", path.string(), mcap_metadata::kRun));
  }
  nlohmann::json facts = nlohmann::json::object();
  for (const char* key : {mcap_metadata::kVersion, mcap_metadata::kModel, mcap_metadata::kEngine}) {
    const auto found = about->second.find(key);
    facts[key] = found == about->second.end() ? "" : found->second;
  }
  if (const auto seed = about->second.find(mcap_metadata::kSeed); seed != about->second.end()) {
    std::uint64_t number = 0;
    const char* const end = seed->second.data() + seed->second.size();
    if (const auto read = std::from_chars(seed->second.data(), end, number);
        read.ec == std::errc() && read.ptr == end) {
      facts[mcap_metadata::kSeed] = number;
    }
  }
  facts["scenario"] = "";
  if (const auto& scenarios = file.messages("/scenario"); !scenarios.empty()) {
    const std::vector<std::byte> message = file.read(scenarios.front());
    try {
      facts["scenario"] = CdrReader(message).text();
    } catch (const Error& error) {
      throw Error(fmt::format("{}: its /scenario cannot be read: {}", path.string(), error.what()));
    }
  }
  return facts;
}

McapTables::McapTables(const std::filesystem::path& path, const std::string& sonar)
    : RecordedTables(path), pings_(path, sonar) {
  const SonarConfig& config = pings_.source().sonar;
  ping_count_ = pings_.ping_count();
  attributes_ = mcap_run_facts(pings_.file(), path);
  attributes_[mcap_metadata::kModel] = pings_.model();
  if (const auto start = mcap_start_ns(pings_.file(), path)) {
    attributes_[mcap_metadata::kStart] = start_text(*start);
  }
  attributes_["sonar"] = config.name;
  attributes_["sonar_model"] = config.model;
  attributes_["frequency"] = config.frequency;
  attributes_["source_level_db"] = config.source_level_db;
  if (const std::optional<double> absorption = pings_.source().absorption) {
    attributes_["absorption_db_per_m"] = *absorption;
  }
  attributes_["levels"] = levels_text(pings_.levels(), pings_.bits());
  add_tables();
  add_names();
}

void McapTables::add_names() {
  const auto& metadata = pings_.file().metadata();
  const auto add = [this](const std::map<std::string, std::string>& texts, const char* key) {
    const auto found = texts.find(key);
    if (found == texts.end()) {
      return;
    }
    try {
      names_.push_back({key, nlohmann::json::parse(found->second).get<std::vector<std::string>>()});
    } catch (const nlohmann::json::exception&) {
      throw Error(fmt::format("{}: its metadata {} must be a list of texts", path_.string(), key));
    }
  };
  add(metadata.at(mcap_metadata::kRun), mcap_metadata::kInstances);
  if (const auto marked = metadata.find(mcap_metadata::kMarked); marked != metadata.end()) {
    add(marked->second, mcap_metadata::kMarkers);
  }
  add(metadata.at(mcap_metadata::kRun), mcap_metadata::kMaterials);
}

std::span<const SoundingColumn> McapTables::columns() const {
  return pings_.has_soundings() ? sounding_columns() : std::span<const SoundingColumn>();
}

// In alphabetical order, as in HDF5.
void McapTables::add_tables() {
  const SonarConfig& config = pings_.source().sonar;
  const auto beams = static_cast<std::uint64_t>(config.beam_count), bins = static_cast<std::uint64_t>(config.bin_count);
  const auto add = [this](const char* name, const char* type, std::vector<std::uint64_t> row,
                          std::vector<std::string> axes, const char* units, const std::string& description) {
    const bool by_ping = !axes.empty();
    tables_.push_back({name,
                       type,
                       static_cast<std::size_t>(type[2] - '0'),
                       std::move(row),
                       by_ping,
                       std::move(axes),
                       {{"units", units}, {"description", description}},
                       true});
  };
  add("azimuth", "<f8", {beams}, {}, "rad", "Centre of each beam, positive to port.");
  const BearingGrid bearings = config.bearings();
  add("azimuth_edges", "<f8", {bearings.edges().size()}, {}, "rad", bearings.edges_text());
  if (config.scans()) {
    add("head_angle", "<f8", {}, {"ping"}, "rad", "Turn of the head in its housing, positive to port.");
  }
  add("intensity", "<f4", {bins, beams}, {"ping", "bin", "beam"}, "1",
      "Echo intensity, from levels of " + levels_text(pings_.levels(), pings_.bits()) + ".");
  add("range", "<f8", {bins}, {}, "m", "Centre of each bin.");
  for (const SoundingColumn& column : columns()) {
    add(column.name, column.type(), {beams}, {"ping", "beam"}, column.units, column.description);
  }
  std::ranges::sort(tables_, {}, &RecordedTable::name);
  add("time", "<f8", {}, {"ping"}, "s", "Time of transmission.");
  add("world_from_sonar", "<f8", {7}, {"ping", "pose"}, "m m m 1 1 1 1",
      "Pose of the housing: x y z, then the quaternion qw qx qy qz; sonar to world.");
}

nlohmann::json McapTables::settings() const {
  return {{"sonar", settings_json(pings_.source().sonar)}, {"receiver", settings_json(pings_.source().receiver)}};
}

std::vector<std::byte> McapTables::row(const RecordedTable& table, std::uint64_t ping) const {
  const SonarConfig& config = pings_.source().sonar;
  if (table.name == "intensity") {
    return bytes_of(pings_.ping(ping).intensity);
  }
  if (table.name == "time") {
    return bytes_of(std::vector{pings_.time(ping)});
  }
  if (table.name == "world_from_sonar") {
    return bytes_of(pings_.world_from_sonar(ping));
  }
  if (table.name == "head_angle") {
    return bytes_of(std::vector{pings_.ping(ping).head_angle});
  }
  if (table.name == "azimuth_edges") {
    return bytes_of(config.bearings().edges());
  }
  if (const auto column = std::ranges::find(columns(), table.name, &SoundingColumn::name); column != columns().end()) {
    std::vector<std::byte> values;
    column->store(pings_.soundings(ping), values);
    return values;
  }
  std::vector<double> centres;
  for (std::uint64_t i = 0; i < table.row.front(); ++i) {
    const int at = static_cast<int>(i);
    centres.push_back(table.name == "range" ? config.bin_range(at) : config.beam_azimuth(at));
  }
  return bytes_of(centres);
}

// The type is that of the table, but for whole numbers of 32 bits, which NumberType does not have.
void McapTables::read(const RecordedTable& table, NumberType type, std::span<const TableSlice> slices,
                      std::span<std::byte> bytes) const {
  if (type != NumberType::kInt64 || table.value_bytes != sizeof(std::int32_t)) {
    read_by_rows(table, slices, bytes);
    return;
  }
  std::vector<std::int32_t> narrow(bytes.size() / sizeof(std::int64_t));
  read_by_rows(table, slices, std::as_writable_bytes(std::span(narrow)));
  const std::vector<std::int64_t> wide(narrow.begin(), narrow.end());
  std::ranges::copy(std::as_bytes(std::span(wide)), bytes.begin());
}

}  // namespace insonify

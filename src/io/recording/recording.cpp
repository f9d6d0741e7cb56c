// recording.cpp -- which values of a run and of its pings go where in the HDF5 file.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "echo/engine.h"
#include "echo/rays/primary_choice.h"
#include "insonify/files.h"
#include "insonify/mcap_recording.h"
#include "insonify/printable.h"
#include "insonify/version.h"
#include "insonify/words.h"
#include "io/file/sounding_columns.h"
#include "io/recording/fletcher.h"
#include "io/recording/growing_file.h"
#include "io/recording/hdf5_writer.h"
#include "io/recording/ping_layers.h"
#include "io/recording/put_markers.h"
#include "io/recording/put_settings.h"

namespace insonify {
namespace {

// Raised when a reader of older files would misunderstand newer ones.
constexpr std::uint64_t kFormat = 1;

// x y z, then the quaternion with its scalar first.
using StoredPose = std::array<double, 7>;

StoredPose stored_pose(const Pose& pose) {
  const Vec3& p = pose.position;
  const Eigen::Quaterniond& q = pose.orientation;
  return {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
}

std::span<const SoundingColumn> columns_of(const SonarConfig& sonar) {
  return sonar.is_multibeam() ? sounding_columns() : std::span<const SoundingColumn>();
}

hid_t type_of(const SoundingColumn& column) {
  const std::string_view type = column.type();
  return type == "<f4" ? H5T_IEEE_F32LE : type == "<i4" ? H5T_STD_I32LE : H5T_STD_U8LE;
}

// In the order in which Recording::add hands over the values.
std::vector<GrowingDataset> growing_datasets(const SonarConfig& sonar, const std::vector<PingLayer>& layers,
                                             bool compress) {
  std::vector<GrowingDataset> datasets;
  for (const PingLayer& layer : layers) {
    std::vector<hsize_t> shape{static_cast<hsize_t>(sonar.bin_count), static_cast<hsize_t>(sonar.beam_count)};
    if (layer.each > 0) {
      shape.push_back(layer.each);
    }
    datasets.push_back({layer.name, layer.type(), shape, compress});
  }
  datasets.push_back({"time", H5T_IEEE_F64LE, {}, false});
  datasets.push_back({"world_from_sonar", H5T_IEEE_F64LE, {StoredPose{}.size()}, false});
  if (sonar.scans()) {
    datasets.push_back({"head_angle", H5T_IEEE_F64LE, {}, false});
  }
  for (const SoundingColumn& column : columns_of(sonar)) {
    datasets.push_back({column.name, type_of(column), {static_cast<hsize_t>(sonar.beam_count)}, false});
  }
  return datasets;
}

void describe_datasets(const H5Writer& writer, const SonarConfig& sonar, const std::vector<PingLayer>& layers) {
  const auto describe = [&writer](const std::string& name, std::string_view axes, const H5Note& note) {
    writer.annotate(name, note);
    writer.attribute(name, "axes", axes);
  };
  for (const PingLayer& layer : layers) {
    describe(layer.name, fmt::format("ping bin beam{}{}", layer.each > 0 ? " " : "", layer.axis), layer.note);
    if (layer.labels) {
      writer.attribute(layer.name, "none", std::uint64_t{kNoLabel});
    }
  }
  describe("time", "ping", {"s", "Time of transmission."});
  describe("world_from_sonar", "ping pose",
           {"m m m 1 1 1 1", "Pose of the housing: x y z, then the quaternion qw qx qy qz; sonar to world."});
  if (sonar.scans()) {
    describe("head_angle", "ping", {"rad", "Turn of the head in its housing, positive to port."});
  }
  for (const SoundingColumn& column : columns_of(sonar)) {
    describe(column.name, "ping beam", {column.units, column.description});
  }
}

void put_axes(const H5Writer& writer, const SonarConfig& sonar) {
  std::vector<double> azimuths(static_cast<std::size_t>(sonar.beam_count));
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    azimuths[static_cast<std::size_t>(beam)] = sonar.beam_azimuth(beam);
  }
  std::vector<double> ranges(static_cast<std::size_t>(sonar.bin_count));
  for (int bin = 0; bin < sonar.bin_count; ++bin) {
    ranges[static_cast<std::size_t>(bin)] = sonar.bin_range(bin);
  }
  writer.put("azimuth", azimuths, {"rad", "Centre of each beam, positive to port."});
  const BearingGrid beams = sonar.bearings();
  writer.put("azimuth_edges", beams.edges(), {"rad", beams.edges_text()});
  writer.put("range", ranges, {"m", "Centre of each bin."});
}

void put_names(const H5Writer& writer, const RunFacts& run) {
  writer.put("instance_names", run.instance_names, {"", "Scoped name of each instance of the scene."});
  writer.put("material_names", run.material_names, {"", "Name of each material of the scene."});
}

void put_run(const H5Writer& writer, const Scenario& scenario, const Scene& scene, const SonarConfig& sonar) {
  const std::string root = "/";
  writer.attribute(root, "format", kFormat);
  writer.attribute(root, "version", kVersion);
  writer.attribute(root, "model", std::string(word_of(scenario.model)));
  writer.attribute(root, "engine", scenario.engine);
  const EngineKind& kind = engine_kind(scenario.engine == kAutoEngine ? "cpu" : scenario.engine);
  const PrimaryEchoes primary = primary_echoes(scenario.primary, sonar, scene.triangle_count(), kind.draws_primaries,
                                               scenario.has_even_rows(sonar));
  writer.attribute(root, "primary", primary == PrimaryEchoes::kRays ? "rays" : "raster");
  writer.attribute(root, "seed", scenario.seed);
  writer.attribute(root, "scenario", scenario.text.empty() ? to_yaml(scenario) : scenario.text);
  writer.attribute(root, "sonar", sonar.name);
  writer.attribute(root, "sonar_model", sonar.model);
  writer.attribute(root, "frequency", sonar.frequency);
  writer.attribute(root, "source_level_db", sonar.source_level_db);
  const Water water = scenario.water_at(sonar);
  writer.attribute(root, "sound_speed", water.true_sound_speed());
  writer.attribute(root, "absorption_db_per_m", water.absorption_db_per_m_at(sonar.frequency));
}

template <typename Value>
std::span<const std::byte> bytes_of(const Value& value) {
  return std::as_bytes(std::span(&value, 1));
}

}  // namespace

struct Recording::State {
  GrowingFile file;
  std::vector<PingLayer> layers;
  int bin_count = 0, beam_count = 0;
  bool has_head = false;
  std::span<const SoundingColumn> columns = {};
  std::vector<std::span<const std::byte>> rows = {};       // Of the ping that is being added.
  std::vector<std::vector<std::byte>> column_values = {};  // Likewise, of each of the columns.
  std::vector<Marker> markers = {};

  void add_soundings(const Ping& ping);
};

Recording::Recording(const std::filesystem::path& path, const Scenario& scenario, const Scene& scene,
                     const SonarConfig& sonar, const RecordingOptions& options) {
  std::vector<PingLayer> layers = ping_layers(scenario, sonar);
  const auto describe = [&](hid_t file) {
    const H5Writer writer(file, path);
    describe_datasets(writer, sonar, layers);
    put_axes(writer, sonar);
    put_names(writer, run_facts(scenario, scene));
    put_run(writer, scenario, scene, sonar);
    put_settings(writer, scenario, scene, sonar);
  };
  GrowingFile file(path, growing_datasets(sonar, layers, options.compress), describe,
                   {.threads = options.threads, .replace = options.replace});
  state_ = std::make_unique<State>(
      State{std::move(file), std::move(layers), sonar.bin_count, sonar.beam_count, sonar.scans(), columns_of(sonar)});
  state_->column_values.resize(state_->columns.size());
}

void Recording::State::add_soundings(const Ping& ping) {
  if (!columns.empty() && ping.soundings.size() != static_cast<std::size_t>(beam_count)) {
    throw Error(fmt::format("{}: ping {} holds {}, not {}", file.path().string(), ping.number,
                            counted(ping.soundings.size(), "sounding"), beam_count));
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    columns[i].store(ping.soundings, column_values[i]);
    rows.emplace_back(column_values[i]);
  }
}

Recording::~Recording() = default;
Recording::Recording(Recording&&) noexcept = default;
Recording& Recording::operator=(Recording&&) noexcept = default;

void Recording::add(const Ping& ping) {
  const std::filesystem::path& path = state_->file.path();
  if (ping.bin_count != state_->bin_count || ping.beam_count != state_->beam_count) {
    throw Error(fmt::format("{}: ping {} has {} x {}, the recording {} x {}", path.string(), ping.number,
                            counted(ping.bin_count, "bin"), counted(ping.beam_count, "beam"), state_->bin_count,
                            state_->beam_count));
  }
  const std::size_t cells = static_cast<std::size_t>(ping.bin_count) * static_cast<std::size_t>(ping.beam_count);
  std::vector<std::span<const std::byte>>& rows = state_->rows;
  rows.clear();
  for (const PingLayer& layer : state_->layers) {
    const std::size_t wanted = cells * std::max<std::size_t>(layer.each, 1);
    if (layer.count(ping) != wanted) {
      throw Error(fmt::format("{}: ping {} holds {} of {}, not {}", path.string(), ping.number,
                              counted(layer.count(ping), "value"), layer.name, wanted));
    }
    rows.push_back(layer.bytes(ping));
  }
  const StoredPose pose = stored_pose(ping.world_from_sonar);
  rows.push_back(bytes_of(ping.time));
  rows.push_back(bytes_of(pose));
  if (state_->has_head) {
    rows.push_back(bytes_of(ping.head_angle));
  }
  state_->add_soundings(ping);
  state_->file.append(rows);
}

void Recording::mark(const std::vector<Marker>& markers) {
  state_->markers = markers;
}

void Recording::close() {
  state_->file.close();
  if (const std::vector<Marker> markers = std::exchange(state_->markers, {}); !markers.empty()) {
    put_markers(state_->file.path(), markers);
  }
}

const std::filesystem::path& Recording::place() const {
  return state_->file.place();
}

std::uint64_t recording_bytes(const Scenario& scenario, const SonarConfig& sonar, std::uint64_t pings) {
  constexpr std::uint64_t kFixed = 250'000;  // Settings, axes and names.
  constexpr std::uint64_t kIndex = 192;      // An entry in two versions of a node, and what aligns a chunk.
  std::uint64_t ping = 0;
  for (const GrowingDataset& dataset : growing_datasets(sonar, ping_layers(scenario, sonar), false)) {
    ping += dataset.row_bytes() + (kIndex + kChecksumBytes) / dataset.chunk_rows();
  }
  return kFixed + scenario.text.size() + pings * ping;
}

}  // namespace insonify

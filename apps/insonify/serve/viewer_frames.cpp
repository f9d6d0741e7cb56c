// viewer_frames.cpp -- encodes pings and scenes.

#include "serve/viewer_frames.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <span>
#include <unordered_map>

#include "insonify/words.h"
#include "serve/json_messages.h"

namespace insonify {
namespace {

static_assert(std::endian::native == std::endian::little, "messages are little-endian");

constexpr std::uint32_t kPing = 1, kScene = 2, kMoved = 3;

// A 4 x 4 matrix in column-major order.
Json matrix_of(const Pose& pose) {
  const Eigen::Matrix3d r = pose.orientation.toRotationMatrix();
  const Vec3& p = pose.position;
  return {r(0, 0), r(1, 0), r(2, 0), 0, r(0, 1), r(1, 1), r(2, 1), 0,
          r(0, 2), r(1, 2), r(2, 2), 0, p.x(),   p.y(),   p.z(),   1};
}

template <typename Value>
void append(std::string& bytes, std::span<const Value> values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

void pad(std::string& bytes) {
  bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
}

Bytes message(std::uint32_t kind, const Json& header, const std::string& body) {
  std::string text = header.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::array<std::uint32_t, 2> head = {kind, static_cast<std::uint32_t>(text.size())};
  std::string bytes;
  bytes.reserve(sizeof(head) + text.size() + body.size());
  append(bytes, std::span<const std::uint32_t>(head));
  bytes += text;
  bytes += body;
  return std::make_shared<const std::string>(std::move(bytes));
}

// Level in hundredths of a decibel above -400 dB; 0: no echo.
std::uint16_t level_of(float intensity) {
  if (!(intensity > 0)) {
    return 0;
  }
  const float level = (10 * std::log10(intensity) + 400) * 100;
  return static_cast<std::uint16_t>(std::clamp(std::lround(level), 1L, 65535L));
}

std::int32_t label_of(std::uint16_t label) {
  return label == kNoLabel ? -1 : label;
}

std::uint8_t share_of(float share) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0F, 1.0F)));
}

struct TableName {
  unsigned bit;
  const char *name, *type;
};
constexpr std::array<TableName, 8> kTables = {{{kLevelTable, "level", "uint16"},
                                               {kInstanceTable, "instance", "int32"},
                                               {kMaterialTable, "material", "int32"},
                                               {kElevationTable, "elevation", "float32"},
                                               {kShadowTable, "shadow", "uint8"},
                                               {kMultipathTable, "multipath", "uint8"},
                                               {kSoundingRangeTable, "sounding_range", "float32"},
                                               {kDetectionTable, "detection", "uint8"}}};

template <auto kConvert, typename Source>
void append_converted(std::string& bytes, const std::vector<Source>& values) {
  using Result = decltype(kConvert(values.front()));
  std::vector<Result> converted(values.size());
  std::transform(values.begin(), values.end(), converted.begin(), [](Source value) { return kConvert(value); });
  append(bytes, std::span<const Result>(converted));
}

// A member of all soundings.
template <auto kMember, typename Value>
void append_soundings(std::string& bytes, const std::vector<Sounding>& soundings) {
  std::vector<Value> values(soundings.size());
  std::ranges::transform(soundings, values.begin(),
                         [](const Sounding& sounding) { return static_cast<Value>(sounding.*kMember); });
  append(bytes, std::span<const Value>(values));
}

void append_table(std::string& bytes, const Ping& ping, unsigned table) {
  switch (table) {
    case kLevelTable:
      append_converted<level_of>(bytes, ping.intensity);
      break;
    case kInstanceTable:
      append_converted<label_of>(bytes, ping.instance);
      break;
    case kMaterialTable:
      append_converted<label_of>(bytes, ping.material);
      break;
    case kElevationTable:
      append(bytes, std::span<const float>(ping.elevation));
      break;
    case kShadowTable:
      append_converted<share_of>(bytes, ping.shadow);
      break;
    case kSoundingRangeTable:
      append_soundings<&Sounding::range, float>(bytes, ping.soundings);
      break;
    case kDetectionTable:
      append_soundings<&Sounding::detection, std::uint8_t>(bytes, ping.soundings);
      break;
    default:
      append(bytes, std::span<const std::uint8_t>(ping.path_order));
      break;
  }
}

bool has_table(const Ping& ping, unsigned table) {
  switch (table) {
    case kLevelTable:
      return true;
    case kInstanceTable:
      return !ping.instance.empty();
    case kMaterialTable:
      return !ping.material.empty();
    case kElevationTable:
      return !ping.elevation.empty();
    case kShadowTable:
      return !ping.shadow.empty();
    case kSoundingRangeTable:
    case kDetectionTable:
      return !ping.soundings.empty();
    default:
      return !ping.path_order.empty();
  }
}

struct DrawnMesh {
  std::vector<Vec3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Merges the vertices in each cell of a grid and drops degenerate triangles; tries finer grids first.
DrawnMesh thinned(const Mesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const Vec3f& vertex : mesh.vertices) {
    box.extend(vertex);
  }
  const float size = std::max(box.sizes().maxCoeff(), 1e-6F);
  DrawnMesh drawn;
  for (int cells = 512; cells >= 8; cells /= 2) {
    drawn = {};
    std::unordered_map<std::uint64_t, std::uint32_t> cell_vertices;
    std::vector<std::uint32_t> merged;
    for (const Vec3f& vertex : mesh.vertices) {
      const Vec3f place = (vertex - box.min()) / size * static_cast<float>(cells);
      const std::uint64_t key = static_cast<std::uint64_t>(place.x()) << 42 |
                                static_cast<std::uint64_t>(place.y()) << 21 | static_cast<std::uint64_t>(place.z());
      const auto [cell, is_new] = cell_vertices.emplace(key, static_cast<std::uint32_t>(drawn.vertices.size()));
      if (is_new) {
        drawn.vertices.push_back(vertex);
      }
      merged.push_back(cell->second);
    }
    for (const auto& [a, b, c] : mesh.triangles) {
      if (merged[a] != merged[b] && merged[b] != merged[c] && merged[c] != merged[a]) {
        drawn.triangles.push_back({merged[a], merged[b], merged[c]});
      }
    }
    if (drawn.triangles.size() <= kMostTriangles) {
      break;
    }
  }
  return drawn;
}

// Distinct colours for consecutive objects: hues a golden section apart.
Json colour_of(std::size_t index) {
  constexpr double kGolden = 0.618033988749895;
  const double hue = 6 * std::fmod(0.08 + static_cast<double>(index) * kGolden, 1.0);
  const auto channel = [hue](double offset) {
    const double k = std::fmod(offset + hue, 6.0);
    return std::round(1000 * (0.8 - 0.35 * std::clamp(std::min(k, 4 - k), 0.0, 1.0))) / 1000;
  };
  return {channel(5), channel(3), channel(1)};
}

}  // namespace

unsigned ping_table(std::string_view name) {
  const auto found = std::ranges::find_if(kTables, [&](const TableName& table) { return name == table.name; });
  return found == kTables.end() ? 0 : found->bit;
}

Bytes ping_frame(const LivePing& live, unsigned tables) {
  const Ping& ping = live.ping;
  Json listed_tables = Json::array();
  std::string body;
  for (const TableName& table : kTables) {
    if ((tables & table.bit) != 0 && has_table(ping, table.bit)) {
      listed_tables.push_back({{"name", table.name}, {"type", table.type}, {"offset", body.size()}});
      append_table(body, ping, table.bit);
      pad(body);
    }
  }
  const Json header = {{"sonar", live.world->sonars[static_cast<std::size_t>(live.sonar)].name},
                       {"number", ping.number},
                       {"time", ping.time},
                       {"change", live.world->change},
                       {"beams", ping.beam_count},
                       {"bins", ping.bin_count},
                       {"position", listed(ping.world_from_sonar.position)},
                       {"orientation", listed(ping.world_from_sonar.orientation)},
                       {"vehicle",
                        {{"position", listed(live.world_from_vehicle.position)},
                         {"orientation", listed(live.world_from_vehicle.orientation)}}},
                       {"head_angle", degrees_from_radians(ping.head_angle)},
                       {"ms", 1000 * live.computing_time},
                       {"made_at", live.made_at},
                       {"tables", listed_tables}};
  return message(kPing, header, body);
}

Bytes scene_frame(const LiveWorld& world) {
  struct Placed {
    Json vertices, triangles;
    bool thin;
  };
  std::map<const Mesh*, Placed> placed;
  Json objects = Json::array();
  std::string body;
  std::size_t thin_count = 0;
  for (std::size_t i = 0; i < world.scene.instances.size(); ++i) {
    const Instance& instance = world.scene.instances[i];
    const bool shown = instance.present && !instance.endless;
    auto found = placed.find(instance.mesh.get());
    if (shown && found == placed.end()) {
      const bool thin = instance.mesh->triangles.size() > kMostTriangles;
      const DrawnMesh few = thin ? thinned(*instance.mesh) : DrawnMesh{};
      const auto& vertices = thin ? few.vertices : instance.mesh->vertices;
      const auto& triangles = thin ? few.triangles : instance.mesh->triangles;
      Placed one{{{"offset", body.size()}, {"count", vertices.size()}}, {}, thin};
      append(body, std::span<const Vec3f>(vertices));
      one.triangles = {{"offset", body.size()}, {"count", triangles.size()}};
      append(body, std::span<const std::array<std::uint32_t, 3>>(triangles));
      found = placed.emplace(instance.mesh.get(), std::move(one)).first;
    }
    const Json none = {{"offset", 0}, {"count", 0}};
    thin_count += shown && found->second.thin ? 1 : 0;
    objects.push_back(
        {{"name", instance.name},
         {"material", instance.materials.empty() ? "" : world.scene.materials[instance.materials[0]].name},
         {"colour", colour_of(i)},
         {"matrix", matrix_of(instance.world_from_mesh)},
         {"vertices", shown ? found->second.vertices : none},
         {"triangles", shown ? found->second.triangles : none}});
  }
  Json sonars = Json::array();
  for (const SonarConfig& sonar : world.sonars) {
    const Pose mounting = sonar.vehicle_from_sonar();
    sonars.push_back({{"position", listed(mounting.position)}, {"orientation", listed(mounting.orientation)}});
  }
  Json points = Json::array();
  for (const PointTarget& point : world.scenario.points) {
    points.push_back(listed(point.position));
  }
  Json header = {{"objects", objects}, {"sonars", sonars}, {"points", points}};
  if (thin_count > 0) {
    header["note"] = "meshes of more than " + std::to_string(kMostTriangles) + " triangles are drawn with fewer";
  }
  return message(kScene, header, body);
}

Bytes moved_frame(const LivePing& ping) {
  Json objects = Json::array();
  for (const MovedInstance& moved : ping.moved) {
    objects.push_back({{"index", moved.instance}, {"matrix", matrix_of(moved.world_from_mesh)}});
  }
  return message(kMoved, {{"objects", objects}}, "");
}

bool same_scene(const LiveWorld& a, const LiveWorld& b) {
  const auto same = [](const Instance& one, const Instance& other) {
    return one.mesh == other.mesh && one.name == other.name && one.materials == other.materials &&
           one.present == other.present && one.world_from_mesh.position == other.world_from_mesh.position &&
           one.world_from_mesh.orientation.coeffs() == other.world_from_mesh.orientation.coeffs();
  };
  const auto same_mounting = [](const SonarConfig& one, const SonarConfig& other) {
    return one.position == other.position && one.orientation == other.orientation &&
           one.head.mounting == other.head.mounting;
  };
  return std::ranges::equal(a.scene.instances, b.scene.instances, same) &&
         std::ranges::equal(a.scene.materials, b.scene.materials, {}, &Material::name, &Material::name) &&
         std::ranges::equal(a.sonars, b.sonars, same_mounting) &&
         std::ranges::equal(a.scenario.points, b.scenario.points, {}, &PointTarget::position, &PointTarget::position);
}

}  // namespace insonify

// obj.cpp -- rounded, without repeated vertices, sorted by material.

#include "kit/obj.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>
#include <unordered_map>

namespace {

// A vertex in whole millimetres.
using Rounded = std::array<std::int32_t, 3>;

struct RoundedHash {
  std::size_t operator()(const Rounded& v) const {
    std::uint64_t hash = 0;
    for (const std::int32_t value : v) {
      hash = (hash ^ static_cast<std::uint32_t>(value)) * 0x9E3779B97F4A7C15U;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

Rounded rounded(const Vec3& position, const std::string& name) {
  Rounded result;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(position[axis]) < 1e5)) {
      throw std::runtime_error(
          fmt::format("{}: vertex ({}, {}, {}) is out of bounds", name, position.x(), position.y(), position.z()));
    }
    result[axis] = static_cast<std::int32_t>(std::lround(position[axis] * 1e3));
  }
  return result;
}

bool has_area(const Rounded& a, const Rounded& b, const Rounded& c) {
  const auto edge = [](const Rounded& from, const Rounded& to) {
    return Eigen::Vector3d(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
  };
  return edge(a, b).cross(edge(a, c)).squaredNorm() > 0;
}

// "12.34", "-0.5", "7": metres from millimetres, without zeros that say nothing.
void append_metres(std::string& text, std::int32_t millimetres) {
  if (millimetres < 0) {
    text += '-';
  }
  const std::int32_t size = std::abs(millimetres);
  fmt::format_to(std::back_inserter(text), "{}", size / 1000);
  if (size % 1000 != 0) {
    fmt::format_to(std::back_inserter(text), ".{:03}", size % 1000);
    text.erase(text.find_last_not_of('0') + 1);
  }
}

// Written under another name first, so that nobody ever reads half a file.
void write_file(const std::filesystem::path& path, const std::string& text) {
  const std::filesystem::path unfinished = path.string() + ".part";
  std::ofstream file(unfinished, std::ios::binary);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  if (!file) {
    throw std::runtime_error(fmt::format("{}: cannot be written", unfinished.string()));
  }
  std::filesystem::rename(unfinished, path);
}

// A colour for viewers of the file; sonars take materials by name.
std::string mtl_text(const std::vector<std::string>& materials, const Cover* cover) {
  static const std::map<std::string, std::string> colours = {
      {"hull", "0.45 0.22 0.16"}, {"deck", "0.30 0.38 0.32"},  {"superstructure", "0.80 0.80 0.75"},
      {"sand", "0.78 0.70 0.52"}, {"rock", "0.42 0.42 0.42"},  {"concrete", "0.65 0.65 0.63"},
      {"wood", "0.50 0.35 0.20"}, {"rubber", "0.10 0.10 0.10"}};
  std::string text;
  for (const std::string& name : materials) {
    const auto found = colours.find(name);
    text += fmt::format("newmtl {}\nKd {}\n", name, found == colours.end() ? "0.55 0.57 0.60" : found->second);
    if (cover != nullptr) {
      text += fmt::format("norm {}\n", cover->normal_map);
    }
  }
  return text;
}

}  // namespace

void write_obj(const std::filesystem::path& folder, const std::string& name, const Shape& shape, const Cover* cover) {
  std::string text = fmt::format("# {}: metres, z up. Made by make_meshes.\nmtllib {}.mtl\n", name, name);
  text.reserve(20 * shape.vertices.size() + 22 * shape.faces.size());

  // Vertices that fall together become one, so that readers see which triangles meet.
  std::vector<Rounded> positions;
  positions.reserve(shape.vertices.size());
  for (const Vec3& vertex : shape.vertices) {
    positions.push_back(rounded(vertex, name));
  }
  std::unordered_map<Rounded, std::size_t, RoundedHash> numbers;
  std::vector<std::size_t> number_of;
  number_of.reserve(positions.size());
  for (const Rounded& position : positions) {
    const auto [entry, is_new] = numbers.try_emplace(position, numbers.size() + 1);
    number_of.push_back(entry->second);
    if (is_new) {
      text += 'v';
      for (const std::int32_t value : position) {
        text += ' ';
        append_metres(text, value);
      }
      text += '\n';
      if (cover != nullptr) {
        const auto along = [&](std::int32_t millimetres, double low) {
          return (millimetres / 1e3 - low) / cover->area.size;
        };
        fmt::format_to(std::back_inserter(text), "vt {:.6f} {:.6f}\n", along(position[0], cover->area.low_x),
                       along(position[1], cover->area.low_y));
      }
    }
  }

  // One run of triangles for each material.
  for (std::size_t slot = 0; slot < shape.materials.size(); ++slot) {
    text += fmt::format("usemtl {}\n", shape.materials[slot]);
    for (const Shape::Face& face : shape.faces) {
      const auto [a, b, c] = face.corners;
      if (face.material == slot && has_area(positions[a], positions[b], positions[c])) {
        const auto line = cover == nullptr ? fmt::runtime("f {} {} {}\n") : fmt::runtime("f {0}/{0} {1}/{1} {2}/{2}\n");
        fmt::format_to(std::back_inserter(text), line, number_of[a], number_of[b], number_of[c]);
      }
    }
  }
  write_file(folder / (name + ".obj"), text);
  write_file(folder / (name + ".mtl"), mtl_text(shape.materials, cover));
}

// ply_header.h -- the header of a PLY file.

#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace insonify {

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

/// A number, or a list: a count followed by that many numbers.
struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat;
  PlyType count_type = PlyType::kUint8;
  bool is_list = false;
};

struct PlyElement {
  std::string name, count_as_written;
  std::uint64_t count = 0;
  int line = 1;
  std::vector<PlyProperty> properties;

  /// Index of the first property with one of these names; -1 if there is none.
  [[nodiscard]] int index_of(std::initializer_list<std::string_view> names) const;
};

struct PlyHeader {
  std::string format;
  std::vector<PlyElement> elements;
  int lines = 0;
};

/// Leaves the file at the first element.
/// @throws Error "PATH:LINE: ..."
[[nodiscard]] PlyHeader read_ply_header(std::ifstream& file, const std::filesystem::path& path);

}  // namespace insonify

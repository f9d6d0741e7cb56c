// hdf5_writer.h -- writes numbers, words and tables into an HDF5 file, each with its unit and description.

#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "io/file/hdf5.h"

namespace insonify {

/// Attributes of a dataset: `units` (omitted if empty) and `description`.
struct H5Note {
  std::string_view units;
  std::string_view description;
};

/// Writes into an open HDF5 file. Datasets are named by their path; groups on the way to them are made. Text is UTF-8
/// of variable length. Every function throws Error with the file's path.
class H5Writer {
 public:
  H5Writer(hid_t file, std::filesystem::path path);

  void put(const std::string& name, double value, const H5Note& note) const;
  void put(const std::string& name, bool value, const H5Note& note) const;
  void put(const std::string& name, std::int64_t value, const H5Note& note) const;
  void put(const std::string& name, std::uint64_t value, const H5Note& note) const;
  void put(const std::string& name, const std::string& value, const H5Note& note) const;
  void put(const std::string& name, std::span<const double> values, const H5Note& note) const;
  void put(const std::string& name, std::span<const std::string> values, const H5Note& note) const;
  void put(const std::string& name, std::span<const std::uint64_t> values, const H5Note& note) const;
  /// Rows of `columns` values each.
  void put_rows(const std::string& name, std::span<const double> values, std::uint64_t columns,
                const H5Note& note) const;

  /// Attributes of a dataset or group; "/" is the file itself.
  void attribute(const std::string& object, const std::string& name, std::string_view text) const;
  void attribute(const std::string& object, const std::string& name, double value) const;
  void attribute(const std::string& object, const std::string& name, std::uint64_t value) const;
  void annotate(const std::string& object, const H5Note& note) const;

 private:
  void add_checksum(hid_t creation, hid_t stored, hid_t space, const std::string& name) const;
  void put_values(const std::string& name, hid_t stored, hid_t given, hid_t space, const void* values,
                  const H5Note& note) const;
  void put_attribute(const std::string& object, const std::string& name, hid_t type, const void* value) const;
  [[nodiscard]] H5Handle own(hid_t id, H5Handle::Close close, const std::string& name) const;

  hid_t file_;
  std::filesystem::path path_;
};

}  // namespace insonify

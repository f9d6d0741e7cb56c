// hdf5_tables.h -- all contents at the root of an HDF5 recording: tables, lists of names, attributes, settings.

#pragma once

#include "io/file/hdf5.h"
#include "io/file/recorded_tables.h"
#include "io/recording/growing_image.h"

namespace insonify {

class Hdf5Tables : public RecordedTables {
 public:
  /// @throws Error with the path for a file that is missing, is not HDF5 or has no dataset `intensity`.
  explicit Hdf5Tables(const std::filesystem::path& path);

  [[nodiscard]] nlohmann::json settings() const override;
  [[nodiscard]] std::vector<std::byte> row(const RecordedTable& table, std::uint64_t ping) const override;
  void read(const RecordedTable& table, NumberType type, std::span<const TableSlice> slices,
            std::span<std::byte> bytes) const override;

 private:
  void add_table(const std::string& name);
  void read_axes(hid_t dataset, RecordedTable& table) const;

  H5Handle file_;
};

}  // namespace insonify

// hdf5_pings.h -- the pings of an HDF5 file with a dataset `intensity`, also from other programs.

#pragma once

#include <array>
#include <filesystem>

#include "io/file/hdf5.h"
#include "io/file/ping_reader.h"

namespace insonify {

class Hdf5Pings : public PingReader {
 public:
  /// @throws Error with the path for a file that is missing, is not HDF5, or has no such dataset.
  explicit Hdf5Pings(const std::filesystem::path& path);

  [[nodiscard]] std::uint64_t ping_count() const override { return shape_[0]; }
  [[nodiscard]] int bin_count() const override { return static_cast<int>(shape_[1]); }
  [[nodiscard]] int beam_count() const override { return static_cast<int>(shape_[2]); }
  [[nodiscard]] const std::string& sonar() const override { return sonar_; }
  [[nodiscard]] const std::string& model() const override { return model_; }
  [[nodiscard]] double full_scale() const override { return full_scale_; }
  [[nodiscard]] std::vector<double> intensity(std::uint64_t ping) const override;
  [[nodiscard]] double greatest_count() const override;
  [[nodiscard]] std::vector<double> counts(std::uint64_t ping) const override;
  [[nodiscard]] Ping ping(std::uint64_t ping) const override;
  [[nodiscard]] SonarConfig sonar_config() const override;
  [[nodiscard]] ReceiverConfig receiver_config() const override;

 private:
  [[nodiscard]] std::vector<double> values(const H5Handle& dataset, const char* name, std::uint64_t ping) const;

  std::filesystem::path path_;
  H5Handle file_, dataset_;
  std::array<hsize_t, 3> shape_{};  // Pings, bins, beams.
  double full_scale_ = 1;
  std::string sonar_, model_;
};

}  // namespace insonify

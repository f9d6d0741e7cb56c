// ping_layers.h -- the tables of a ping with a value for each bin, as stored in recordings.

#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "insonify/ping.h"
#include "insonify/scenario.h"
#include "io/recording/hdf5_writer.h"

namespace insonify {

struct PingLayer {
  const char* name;
  std::variant<std::vector<float> Ping::*, std::vector<std::complex<float>> Ping::*, std::vector<std::uint16_t> Ping::*,
               std::vector<std::uint8_t> Ping::*>
      table;
  bool (*recorded)(const Scenario&, const SonarConfig&);  ///< Whether it is.
  hsize_t each;      ///< Values of each bin; 0 for a single one, without an axis of their own.
  const char* axis;  ///< The name of that axis.
  H5Note note;
  bool labels = false;  ///< Whether values are rows of a list, kNoLabel for none.

  [[nodiscard]] hid_t type() const;                         ///< HDF5 type of a value in the file.
  [[nodiscard]] std::size_t count(const Ping& ping) const;  ///< Values that the ping holds.
  [[nodiscard]] std::span<const std::byte> bytes(const Ping& ping) const;
};

/// Tables of a sonar's recording, in order.
[[nodiscard]] std::vector<PingLayer> ping_layers(const Scenario& scenario, const SonarConfig& sonar);

}  // namespace insonify

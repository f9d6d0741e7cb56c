// ping_layers.h -- the tables of a ping that have a value for each bin, as recordings hold them.

#pragma once

#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "insonify/ping.h"
#include "io/hdf5_writer.h"

namespace insonify {

struct PingLayer {
  const char* name;
  std::variant<std::vector<float> Ping::*, std::vector<std::uint16_t> Ping::*, std::vector<std::uint8_t> Ping::*> table;
  GroundTruth least;  ///< Recorded with this or more.
  hsize_t ranks;      ///< Values of each bin, the strongest's first; 0 for a single one.
  H5Note note;

  [[nodiscard]] hid_t type() const;                         ///< Of a value in the file.
  [[nodiscard]] std::size_t count(const Ping& ping) const;  ///< Values that the ping holds.
  [[nodiscard]] std::span<const std::byte> bytes(const Ping& ping) const;
};

inline constexpr std::size_t kMostPingLayers = 10;

/// Those of a recording, in order; at most kMostPingLayers.
[[nodiscard]] std::vector<PingLayer> ping_layers(GroundTruth ground_truth);

}  // namespace insonify

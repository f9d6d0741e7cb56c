// ping_memory.h -- the memory of a ping on a device: samples, sums, and the list of hits that reflect.

#pragma once

#include "echo/batch/ping_view.h"
#include "echo/gpu/shaders/layout.h"
#include "gpu/device.h"

namespace insonify {

/// Memory for one ping of a batch, used again for others that need no more.
class PingMemory {
 public:
  /// Makes room for a ping.
  void reserve(gpu::Device& device, const PingView& view);

  /// Records that all sums are zero.
  void clear(gpu::Commands& commands) const;

  /// After the commands: whether the sums of all surfaces found room; if not, there is room now, and the ping has to
  /// run again.
  bool enough_room(gpu::Device& device);

  /// Records copies of what the host reads: as many surfaces as the ping before took, and a few more.
  void copy_sums(gpu::Commands& commands);

  /// After the commands: whether there are surfaces beyond these, and records their copy.
  [[nodiscard]] bool has_rest() const { return cells_.labelled != 0 && used_surfaces_ > copied_surfaces_; }
  void copy_rest(gpu::Commands& commands) const;

  [[nodiscard]] shader::Samples samples() const { return samples_; }
  [[nodiscard]] shader::Cells cells() const { return cells_; }
  [[nodiscard]] std::uint64_t reflecting() const { return reflecting_; }
  [[nodiscard]] const gpu::Buffer& sums() const { return sums_; }
  [[nodiscard]] std::size_t counters_offset() const { return counters_offset_; }

  /// What the host reads, after the commands have finished.
  [[nodiscard]] const shader::Counters& counters() const;
  [[nodiscard]] const std::int64_t* energy() const { return host_sums_.data<std::int64_t>(); }
  [[nodiscard]] const std::int64_t* weight() const { return energy() + cells_of_orders_; }
  [[nodiscard]] const std::int64_t* met_before() const { return weight() + cells_of_orders_; }
  [[nodiscard]] const std::uint32_t* first_surface() const;
  [[nodiscard]] const shader::SurfaceSum* surfaces() const { return host_surfaces_.data<const shader::SurfaceSum>(); }

 private:
  void reserve_surfaces(gpu::Device& device, std::uint32_t surfaces);
  void copy_surfaces(gpu::Commands& commands, std::uint32_t first, std::uint32_t last) const;

  gpu::Buffer work_;      // Samples and the hits that reflect.
  gpu::Buffer sums_;      // Energies, weights, met_before, counters, first surfaces.
  gpu::Buffer surfaces_;  // SurfaceSum[]
  gpu::Buffer host_sums_, host_surfaces_;
  shader::Samples samples_ = {};
  shader::Cells cells_ = {};
  std::uint64_t reflecting_ = 0;
  std::size_t cells_of_orders_ = 0, counters_offset_ = 0, first_surface_offset_ = 0, sums_bytes_ = 0;
  std::uint32_t used_surfaces_ = 0;    // SurfaceSums that are not zero.
  std::uint32_t copied_surfaces_ = 0;  // How many of them copy_sums() copies.
};

}  // namespace insonify

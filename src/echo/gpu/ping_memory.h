// ping_memory.h -- the memory of a ping on a device: samples, sums, and what the host reads.

#pragma once

#include "echo/batch/ping_view.h"
#include "echo/gpu/shaders/ping_layout.h"
#include "gpu/device.h"

namespace insonify {

/// Memory for one ping of a batch, used again for others that need no more.
class PingMemory {
 public:
  /// Makes room for a ping.
  /// @param relief  Whether any surface has a relief.
  void reserve(gpu::Device& device, const PingView& view, bool relief);

  /// Records that all sums are zero.
  void clear(gpu::Commands& commands) const;

  /// After the commands: whether the sums of all surfaces found room; if not, there is room now, and the ping has to
  /// run again.
  bool enough_room(gpu::Device& device);

  /// Records the copy of the counters, where the host reads nothing else.
  void copy_counters(gpu::Commands& commands) const;

  /// Records copies of what the host reads: room for as many further surfaces as the ping before had, and a few more.
  void copy_layers(gpu::Device& device, gpu::Commands& commands);

  /// After the commands: whether there are further surfaces beyond these, and records their copy.
  [[nodiscard]] bool has_rest() const { return counters().further > copied_further_; }
  void copy_rest(gpu::Device& device, gpu::Commands& commands);

  [[nodiscard]] shader::Samples samples() const { return samples_; }
  [[nodiscard]] shader::Cells cells() const { return cells_; }
  [[nodiscard]] shader::GridLayers layers() const { return layers_; }
  [[nodiscard]] std::uint64_t reflecting() const { return reflecting_; }

  /// Where the commands find the shader::Counters: at the start of this buffer.
  [[nodiscard]] const gpu::Buffer& counted() const { return to_host_; }

  /// What the host reads, after the commands have finished.
  [[nodiscard]] const shader::Counters& counters() const { return *host_.data<const shader::Counters>(); }
  template <typename Value>
  [[nodiscard]] const Value* on_host(std::uint64_t shader::GridLayers::*layer) const {
    return reinterpret_cast<const Value*>(host_.data() + (layers_.*layer - to_host_.address()));
  }
  [[nodiscard]] const shader::FurtherSum* further() const { return host_further_.data<const shader::FurtherSum>(); }

 private:
  void reserve_work(gpu::Device& device, const FlatPlan& plan, bool relief);
  void reserve_sums(gpu::Device& device, std::size_t beams);
  void reserve_layers(gpu::Device& device, std::size_t beams);
  void reserve_surfaces(gpu::Device& device, std::uint32_t surfaces);
  void copy_further(gpu::Device& device, gpu::Commands& commands, std::uint32_t count);

  gpu::Buffer work_;                    // Samples and the hits that reflect.
  gpu::Buffer sums_;                    // Energies, weights, met_before, first surfaces.
  gpu::Buffer surfaces_;                // SurfaceSum[]
  gpu::Buffer to_host_, host_;          // Counters and GridLayers.
  gpu::Buffer further_, host_further_;  // FurtherSum[]
  shader::Samples samples_ = {};
  shader::Cells cells_ = {};
  shader::GridLayers layers_ = {};
  std::uint64_t reflecting_ = 0;
  std::size_t cell_count_ = 0;
  std::size_t sums_bytes_ = 0, zeroed_bytes_ = 0, layer_bytes_ = 0;  // zeroed_bytes_: at the start of to_host_.
  std::uint32_t used_surfaces_ = 0;                                  // SurfaceSums that are not zero.
  std::uint32_t copied_further_ = 0;                                 // FurtherSums that copy_layers() copies.
};

}  // namespace insonify

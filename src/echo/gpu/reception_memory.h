// reception_memory.h -- the memory of a ping on a device between its cells and its beams, and the beams on the host.

#pragma once

#include <span>

#include "echo/batch/ping_view.h"
#include "echo/batch/reception.h"
#include "echo/gpu/shaders/ping_layout.h"
#include "gpu/staged.h"

namespace insonify {

/// Memory for receiving one ping of a batch, used again for others that need no more.
class ReceptionMemory {
 public:
  /// Makes room for a ping that a device receives, and fills in what it needs.
  /// @param tables  Address of its shader::ReceiverTables.
  /// @param lists   Echoes of its sources; their spread ones are added to the cells.
  void set(gpu::Device& device, const PingView& view, std::span<const EchoList* const> lists, std::uint64_t tables);

  /// The host receives the ping.
  void clear() { at_ = {}; }
  [[nodiscard]] bool used() const { return at_.tables != 0; }

  /// Records the copy of what set() has filled in.
  void copy_inputs(gpu::Commands& commands) { inputs_.copy(commands); }

  /// Records the copy of the beams to the host.
  void copy_beams(gpu::Commands& commands) const;

  /// For the kernels.
  [[nodiscard]] const shader::ReceptionAt& at() const { return at_; }

  /// The beams, after the commands have finished.
  [[nodiscard]] FormedBeams formed() const;

 private:
  void fill_inputs(gpu::Device& device, const PingView& view, std::span<const EchoList* const> lists);
  void reserve_work(gpu::Device& device, const FlatReceiver& receiver);
  void reserve_beams(gpu::Device& device, const FlatReceiver& receiver);

  gpu::StagedBuffer inputs_;
  gpu::Buffer work_;
  gpu::Buffer beams_, host_;
  std::size_t beam_bins_ = 0, beam_bytes_ = 0;
  shader::ReceptionAt at_ = {};
};

}  // namespace insonify

// raw_type.h -- DDS topics whose messages are already encoded, and the pace at which their fragments are sent.

#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "dds/dds_entity.h"

struct ddsi_serdata;
struct ddsi_sertype;

namespace insonify {

/// A write-only topic without keys whose messages are opaque bytes to CycloneDDS.
class RawTopic {
 public:
  /// @param name  As on the wire: "rt/fls/fan".
  /// @param type  As on the wire: "sensor_msgs::msg::dds_::Image_".
  RawTopic(dds_entity_t participant, const std::string& name, const std::string& type, const dds_qos_t* qos);

  [[nodiscard]] dds_entity_t get() const { return topic_.get(); }
  [[nodiscard]] const ddsi_sertype* type() const { return type_; }

 private:
  const ddsi_sertype* type_ = nullptr;  // Owned by the topic.
  DdsEntity topic_;
};

/// Limits how fast fragments are sent: kBurst bytes at once, then at kRate. A Linux socket buffers some 200 kB by
/// default (net.core.rmem_default) and drops what arrives while it is full. A best-effort reader loses a whole message
/// with one fragment.
class SendPace {
 public:
  using Clock = std::chrono::steady_clock;

  static constexpr double kBurst = 130'000;  ///< Two fragments [byte].
  static constexpr double kRate = 100e6;     ///< [byte/s], about that of an Ethernet of 1 Gbit/s.

  /// @param rate  [byte/s], > 0.
  explicit SendPace(double rate = kRate) : rate_(rate) {}

  /// Waits until a fragment may be sent, and counts it.
  /// @param size  [byte]
  void wait(std::size_t size);

 private:
  double rate_;
  double pending_ = 0;                   // Bytes that readers may not have read yet ...
  Clock::time_point at_ = Clock::now();  // ... at this time.
};

/// Sends a message to all readers.
/// @param message  CDR with its four-byte header.
/// @param pace     Shared by all messages of this participant: readers in one program share a socket.
/// @return  As dds_write(): DDS_RETCODE_TIMEOUT if a reliable reader could not keep up.
[[nodiscard]] dds_return_t write_raw(dds_entity_t writer, const RawTopic& topic, std::span<const std::byte> message,
                                     SendPace& pace);

}  // namespace insonify

// raw_type.h -- DDS topics whose messages are already encoded.

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "dds/dds_entity.h"
#include "dds/send_pace.h"

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

/// Sends a message to all readers.
/// @param message  CDR with its four-byte header.
/// @param pace     Shared by all messages of this participant: readers in one program share a socket.
/// @return  As dds_write(): DDS_RETCODE_TIMEOUT if a reliable reader could not keep up.
[[nodiscard]] dds_return_t write_raw(dds_entity_t writer, const RawTopic& topic, std::span<const std::byte> message,
                                     SendPace& pace);

}  // namespace insonify

// ping_source.h -- pings of a recording to be drawn, HDF5 or MCAP.

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "insonify/mcap_recording.h"
#include "insonify/recorded_pings.h"

namespace insonify {

class PingSource {
 public:
  /// @param sonar  Which one of an MCAP file; "" for the only one.
  /// @throws Error with the path for what is no recording of insonify's.
  PingSource(const std::filesystem::path& path, const std::string& sonar);

  [[nodiscard]] std::uint64_t ping_count() const;
  [[nodiscard]] Ping ping(std::uint64_t number) const;
  [[nodiscard]] const SonarConfig& sonar() const { return sonar_; }
  [[nodiscard]] const ReceiverConfig& receiver() const { return receiver_; }
  [[nodiscard]] EchoModel model() const { return model_; }

 private:
  std::optional<RecordedPings> h5_;
  std::optional<McapPings> mcap_;
  SonarConfig sonar_;
  ReceiverConfig receiver_;
  EchoModel model_ = EchoModel::kCalibrated;
};

}  // namespace insonify

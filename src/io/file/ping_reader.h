// ping_reader.h -- the pings of one sonar in a recording of any format.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "insonify/ping.h"
#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// The interface of a file format to RecordedPings, which documents the functions.
class PingReader {
 public:
  PingReader() = default;
  virtual ~PingReader() = default;
  PingReader(const PingReader&) = delete;
  PingReader& operator=(const PingReader&) = delete;

  [[nodiscard]] virtual std::uint64_t ping_count() const = 0;
  [[nodiscard]] virtual int bin_count() const = 0;
  [[nodiscard]] virtual int beam_count() const = 0;
  [[nodiscard]] virtual const std::string& sonar() const = 0;
  [[nodiscard]] virtual const std::string& model() const = 0;
  [[nodiscard]] virtual double full_scale() const = 0;
  [[nodiscard]] virtual std::vector<double> intensity(std::uint64_t ping) const = 0;
  [[nodiscard]] virtual double greatest_count() const = 0;
  [[nodiscard]] virtual std::vector<double> counts(std::uint64_t ping) const = 0;
  [[nodiscard]] virtual Ping ping(std::uint64_t ping) const = 0;
  [[nodiscard]] virtual SonarConfig sonar_config() const = 0;
  [[nodiscard]] virtual ReceiverConfig receiver_config() const = 0;
};

}  // namespace insonify

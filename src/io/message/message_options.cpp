// message_options.cpp -- limits of the options of messages, and the rate of fan pictures.

#include <fmt/format.h>

#include <cstdint>
#include <optional>

#include "insonify/error.h"
#include "insonify/messages.h"

namespace insonify {

void MessageOptions::validate() const {
  check_fields("messages", *this);
  if (bits != 8 && bits != 16) {
    throw Error("messages", "bits", fmt::format(" = {} must be 8 or 16", bits));
  }
  constexpr std::uint64_t kStartLimit = std::uint64_t{1'000'000'000} << 31U;  // [ns]
  if (start_ns && *start_ns >= kStartLimit) {
    throw Error("messages", "start_ns", fmt::format(" = {} ns must be below 2^31 s", *start_ns));
  }
  if (world_frame.empty()) {
    throw Error("messages", "world_frame", " must not be empty");
  }
}

std::optional<double> MessageOptions::fan_rate_of(const SonarConfig& sonar) const {
  const bool scans = sonar.product() == Product::kLine;
  return fan_rate || !scans ? fan_rate : std::optional(kScanningFanRate);
}

}  // namespace insonify

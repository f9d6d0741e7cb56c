// receiver_config.cpp -- what goes together.

#include "insonify/receiver_config.h"

#include "insonify/error.h"

namespace insonify {

void ReceiverConfig::validate() const {
  check_fields("receiver", *this);
  if (pulse == PulseKind::kLfm && pulse_duration * pulse_bandwidth < 10) {
    throw Error("receiver.pulse_bandwidth times pulse_duration must be at least 10 for a chirp");
  }
}

}  // namespace insonify

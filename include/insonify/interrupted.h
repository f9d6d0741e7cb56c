// interrupted.h -- exception of a long computation that is ended early.

#pragma once

#include "insonify/error.h"

namespace insonify {

/// Thrown by what was told to end before it was done, as by Simulator::stop_when().
class Interrupted : public Error {
 public:
  Interrupted() : Error("interrupted") {}
};

}  // namespace insonify

// interrupted.h -- what a long computation throws when it is told to end early.

#pragma once

#include "insonify/error.h"

namespace insonify {

/// Thrown by what was told to end before it was done, as by Simulator::stop_when().
class Interrupted : public Error {
 public:
  Interrupted() : Error("interrupted") {}
};

}  // namespace insonify

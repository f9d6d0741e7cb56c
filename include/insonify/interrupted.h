// interrupted.h -- the exception of an aborted computation.

#pragma once

#include "insonify/error.h"

namespace insonify {

/// Thrown by a computation that was asked to stop, as by Simulator::stop_when().
class Interrupted : public Error {
 public:
  Interrupted() : Error("interrupted") {}
};

}  // namespace insonify

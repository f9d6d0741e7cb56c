// device_failure.h -- the error of a device that cannot go on with its work.

#pragma once

#include "insonify/error.h"

namespace insonify {

/// A device was lost, has no memory left, or cannot do what was asked of it: what it held is of no use, but the same
/// work can be done elsewhere.
struct DeviceFailure : Error {
  using Error::Error;
};

}  // namespace insonify

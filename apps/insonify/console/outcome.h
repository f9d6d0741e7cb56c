// outcome.h -- how a command ends.

#pragma once

#include "insonify/error.h"

namespace insonify {

// Exit statuses.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;      ///< A failure while running, or the run was stopped.
inline constexpr int kWrongInput = 2;  ///< The input is wrong.

/// Wrong input, as opposed to a failure while running.
class InputError : public Error {
 public:
  using Error::Error;
};

}  // namespace insonify

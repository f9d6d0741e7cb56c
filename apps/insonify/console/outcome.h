// outcome.h -- how a command ends.

#pragma once

#include <utility>

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

/// Result of `make`, which reads or checks input.
/// @throws InputError with the message of an Error that `make` throws.
template <typename Make>
auto checked_input(Make&& make) {
  try {
    return std::forward<Make>(make)();
  } catch (const Error& error) {
    throw InputError(error.what());
  }
}

}  // namespace insonify

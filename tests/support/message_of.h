// message_of.h -- returns the message of the error that a callable throws.

#pragma once

#include <string>
#include <utility>

#include "insonify/error.h"

namespace insonify {

template <typename Act>
std::string message_of(Act&& act) {
  try {
    std::forward<Act>(act)();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace insonify

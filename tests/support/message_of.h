// message_of.h -- the message of the error that something throws.

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

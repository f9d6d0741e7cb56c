// sonar_index.cpp -- compares an index with the number of sonars.

#include "simulator/sonar_index.h"

#include <fmt/format.h>

#include "insonify/error.h"

namespace insonify {

std::size_t sonar_index(int sonar, std::size_t count) {
  if (sonar < 0 || static_cast<std::size_t>(sonar) >= count) {
    throw Error(fmt::format("sonar = {} must be from 0 to {}, the last", sonar, count - 1));
  }
  return static_cast<std::size_t>(sonar);
}

}  // namespace insonify

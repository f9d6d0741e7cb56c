// thruster.cpp -- spectrum of a thruster's noise, and rules between its settings.

#include "insonify/thruster.h"

#include <fmt/format.h>

#include <cmath>

#include "insonify/error.h"

namespace insonify {

double Thruster::spectrum_db(double at) const {
  return level_db + slope * std::log10(at / frequency);
}

void Thruster::validate(std::string_view object) const {
  check_fields(object, *this);
  if (modulation > 0 && !(blade_rate > 0)) {
    throw Error(object, "modulation", fmt::format(" = {} needs a blade_rate", modulation));
  }
  if (blade_rate > 0 && !(modulation > 0)) {
    throw Error(object, "blade_rate", fmt::format(" = {} Hz needs a modulation above 0", blade_rate));
  }
}

}  // namespace insonify

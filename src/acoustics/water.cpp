// water.cpp -- sound speed and absorption of a body of water, from its properties.

#include "insonify/water.h"

#include "insonify/acoustics/absorption.h"
#include "insonify/acoustics/sound_speed.h"

namespace insonify {

void Water::validate() const {
  check_fields("water", *this);
}

double Water::true_sound_speed() const {
  return sound_speed ? *sound_speed : chen_millero_sound_speed(temperature_c, salinity, depth);
}

double Water::absorption_db_per_m_at(double frequency) const {
  return absorption ? absorption_db_per_m.value_or(insonify::absorption_db_per_m(frequency, *this)) : 0;
}

}  // namespace insonify

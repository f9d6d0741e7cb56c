// water.cpp -- sound speed and absorption of a body of water, from its properties.

#include "insonify/water.h"

#include <fmt/format.h>

#include "insonify/acoustics/absorption.h"
#include "insonify/acoustics/sound_speed.h"
#include "insonify/error.h"

namespace insonify {

void Water::validate() const {
  check_fields("water", *this);
  check_profile(profile, "water.profile");
  if (sound_speed && !profile.empty()) {
    throw Error("water", "sound_speed",
                fmt::format(" = {:.10g} m/s and water.profile both give the speed; leave one out", *sound_speed),
                {"water.profile"});
  }
}

double Water::true_sound_speed() const {
  if (!profile.empty()) {
    return SoundSpeedProfile(profile, "water.profile").speed_at(depth);
  }
  return sound_speed ? *sound_speed : chen_millero_sound_speed(temperature_c, salinity, depth);
}

double Water::absorption_db_per_m_at(double frequency) const {
  return absorption ? absorption_db_per_m.value_or(insonify::absorption_db_per_m(frequency, *this)) : 0;
}

}  // namespace insonify

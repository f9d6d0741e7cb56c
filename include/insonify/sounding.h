// sounding.h -- soundings of a multibeam echosounder: where each beam met the bottom.

#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "insonify/words.h"

namespace insonify {

/// How a beam's bottom was found: by the time of its strongest echo, or by the phase between the halves of the receive
/// array, which is 0 where the echo comes from the middle of the beam.
enum class Detection : std::uint8_t { kNone, kAmplitude, kPhase };
template <>
constexpr auto words_of<Detection>() {
  return EnumWords<Detection, 3>{
      {{"none", Detection::kNone}, {"amplitude", Detection::kAmplitude}, {"phase", Detection::kPhase}}};
}

/// The bottom in one beam of one ping.
struct Sounding {
  float azimuth = 0;                                      ///< Of the beam in the sonar frame: SonarConfig::
                                                          ///< beam_azimuth() [rad], positive to port.
  float range = std::numeric_limits<float>::quiet_NaN();  ///< Slant range, as the sonar shows ranges [m]; NaN: none.
  float uncertainty = 0;                                  ///< Standard deviation of the range [m].
  float quality = 0;                                      ///< log10(range / uncertainty), the quality factor of Lurton
                                                          ///< and Augustin, IEEE JOE 35, 217 (2010); 0: none.
  float intensity = 0;                                    ///< Beam value: mean intensity of the snippet.
  std::int32_t snippet_begin = 0;                         ///< First bin of the echo of the bottom,
  std::int32_t snippet_end = 0;                           ///< and the bin behind the last: equal without an echo.
  Detection detection = Detection::kNone;

  [[nodiscard]] bool found() const { return detection != Detection::kNone; }
};

}  // namespace insonify

// oculus_sonar.h -- the simulated sonar for an Oculus's settings, and its pings as images.

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "insonify/files.h"
#include "insonify/messages.h"
#include "insonify/ping.h"
#include "insonify/scenario.h"
#include "insonify/wire/oculus_messages.h"

namespace insonify {

/// Gain from 50 to 100 percent [dB]; from 50 to 0 the same downwards. Our assumption, as are the next three: the
/// instrument's gains are not published.
inline constexpr double kOculusGainSpan = 10;

/// Gain words are power gains in units of 1 / kOculusGainUnit.
inline constexpr double kOculusGainUnit = 50;

/// Gain assist brings the brightest kOculusAssistShare of the pixels to half of the full amplitude, by at most
/// kOculusAssistSpan up or down [dB].
inline constexpr double kOculusAssistShare = 0.005, kOculusAssistSpan = 20;

/// One of an instrument's frequency modes.
struct OculusMode {
  SonarConfig sonar;                       ///< Over its longest range.
  std::optional<Preset> preset = {};       ///< Determines the length of rows.
  std::optional<double> ping_period = {};  ///< Shortest that the scenario allows [s].
};

struct OculusModes {
  OculusMode low;
  std::optional<OculusMode> high = {};  ///< None: the instrument has one mode.
  std::uint16_t part_number = 0;        ///< Part number of the model; 0: not an Oculus.
};

/// The modes of a sonar. One that has been made from a preset has the preset's modes "low" and "high", whichever it
/// was made in, with what the scenario has changed; another has one mode, itself.
/// @param high  A sonar for the mode "high"; null: the preset's.
/// @throws Error for presets that cannot be read.
[[nodiscard]] OculusModes oculus_modes(const Scenario& scenario, const SonarConfig& sonar,
                                       const SonarConfig* high = nullptr);

/// What a fire message means for a mode.
struct OculusPlan {
  OculusFire fire;        ///< As the sonar repeats it: a range beyond the longest is that; of the high mode, gains are
                          ///< from 40 to 100 percent.
  int rows = 0;           ///< Rows of the image, from range 0 on.
  int blank_rows = 0;     ///< Nearer than min_range: 0.
  double row_length = 0;  ///< [m]
  double range = 0;       ///< Far edge of the last row [m].
  double gain_db = 0;
  double period = 0;                      ///< Between pings [s]; 0 in standby.
  std::optional<SonarConfig> sonar = {};  ///< Its bins are the rows that are not blank; none where all are.
};

/// @param fire  Of decode_fire().
[[nodiscard]] OculusPlan oculus_plan(const OculusMode& mode, const Scenario& scenario, const OculusFire& fire);

/// Bearings of the beams, positive to starboard, rising [0.01 deg].
[[nodiscard]] std::vector<std::int16_t> oculus_bearings(const SonarConfig& sonar);

/// OculusPing::image. A pixel is amplitude^(gamma/255) of its full scale; full amplitude is levels.high_db after the
/// gain of its row: gain over range if the receiver applies none, the plan's gain, and gain assist. In the paper's
/// model amplitude is the ping's intensity, whose full scale is 1.
/// @param ping    Of plan.sonar; null if that is absent.
/// @param levels  SonarMessages::levels().
/// @param beams   Beams of the image.
[[nodiscard]] std::vector<std::uint8_t> oculus_image(const OculusPlan& plan, const Ping* ping,
                                                     const MessageLevels& levels, int beams);

}  // namespace insonify

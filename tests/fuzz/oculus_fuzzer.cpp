// oculus_fuzzer.cpp -- takes any bytes as what a client sends to an Oculus, and answers fire messages with images.

#include "fuzz/fuzzer.h"
#include "insonify/wire/oculus_sonar.h"

namespace insonify::oculus_fuzzer {
namespace {

using fuzz::expect;

// A sonar of 3 beams and 5 bins: what is fuzzed are settings, not sizes.
struct Sonar {
  Scenario scenario = parse_scenario(
      "points: [{position: [3, 0, 0], target_strength_db: -20}]\n"
      "sonars: [{beam_count: 3, bin_count: 5, min_range: 0.3, max_range: 12}]\n");
  OculusModes modes = oculus_modes(scenario, scenario.sonars[0]);
};

void answer(const Sonar& sonar, const OculusFire& fire) {
  const OculusPlan plan = oculus_plan(sonar.modes.low, sonar.scenario, fire);
  expect(plan.rows > 0 && plan.blank_rows >= 0 && plan.blank_rows <= plan.rows);
  Ping ping;
  if (plan.sonar) {
    plan.sonar->validate();
    ping.bin_count = plan.sonar->bin_count;
    ping.beam_count = plan.sonar->beam_count;
    ping.intensity.assign(static_cast<std::size_t>(ping.bin_count * ping.beam_count), 1e-6F);
  }
  OculusPing result{.fire = plan.fire, .range_count = static_cast<std::uint16_t>(plan.rows), .bearings = {-1, 0, 1}};
  result.image =
      oculus_image(plan, plan.sonar ? &ping : nullptr, {.low_db = -100, .high_db = -40, .gain_per_decade = 30}, 3);
  const std::size_t pixel = fire.wide() ? 4 : fire.has(kOculus16Bits) ? 2 : 1, word = fire.has(kOculusGainSent) ? 4 : 0;
  expect(result.image.size() == static_cast<std::size_t>(plan.rows) * (3 * pixel + word));
  expect(encode(result).size() == (fire.layout == 2 ? 202U : 122U) + 6 + result.image.size());
}

void take(fuzz::Bytes bytes) {
  static const Sonar sonar;
  const std::size_t cut = bytes.empty() ? 0 : bytes[0] % bytes.size();  // Bytes arrive in two pieces.
  OculusParser parser;
  std::size_t used = 0;
  for (const auto piece : {bytes.first(cut), bytes.subspan(cut)}) {
    parser.add(piece);
    while (const std::optional<OculusMessage> message = parser.next()) {
      used += kOculusHeaderSize + message->payload.size();
      fuzz::expect_error_or_nothing([&] { answer(sonar, decode_fire(*message)); });
    }
  }
  expect(used + parser.skipped() <= bytes.size());
}

const fuzz::Listed kListed("oculus", take);

}  // namespace
}  // namespace insonify::oculus_fuzzer

// ping360_fuzzer.cpp -- takes any bytes as what a client sends to a Ping360, on the serial line and in a datagram.

#include "fuzz/fuzzer.h"
#include "insonify/files.h"
#include "insonify/wire/ping360_sonar.h"

namespace insonify::ping360_fuzzer {
namespace {

using fuzz::expect;

void answer(Ping360& instrument, const PingEvent& event, const Scenario& scenario) {
  const Ping360Answer answer = instrument.take(event);
  for (const PingFrame& frame : answer.frames) {
    PingParser parser;  // What it sends is whole, or longer than what it takes.
    parser.add(encode(frame));
    const std::optional<PingEvent> sent = parser.next();
    expect(sent && (frame.payload.size() > kLongestPingPayload || sent->frame == frame));
  }
  if (instrument.sector()) {
    instrument.turn_to(12345);
    expect(instrument.settings().angle < kGradiansPerTurn);
  }
  if (answer.transmit || answer.scan_changed) {
    const SonarConfig& sonar = scenario.sonars[0];
    const auto config = ping360_config(sonar, scenario, instrument.settings(), 1500);
    const int blank = ping360_blank_samples(sonar, instrument.settings(), 1500);
    Ping ping;
    if (config) {
      config->validate();
      ping.bin_count = config->bin_count;
      ping.beam_count = 1;
      ping.intensity.assign(static_cast<std::size_t>(ping.bin_count), 1e-6F);
    }
    const auto samples =
        ping360_samples(config ? &ping : nullptr, config.value_or(sonar),
                        {.low_db = -100, .high_db = -40, .gain_per_decade = 30}, instrument.settings(), blank);
    expect(samples.size() == instrument.settings().sample_count);
    expect(encode(instrument.data(samples)).size() > samples.size());
  }
}

void take(fuzz::Bytes bytes) {
  static const Scenario scenario = parse_scenario(
      "points: [{position: [3, 0, 0], target_strength_db: -20}]\n"
      "sonars: [{type: msis, beam_count: 1, bin_count: 100, azimuth_aperture_deg: 2, min_range: 0.75, max_range: "
      "20}]\n");
  const std::size_t cut = bytes.empty() ? 0 : bytes[0] % bytes.size();  // Bytes arrive in two pieces.
  Ping360 line, datagram;
  PingParser parser;
  for (const auto piece : {bytes.first(cut), bytes.subspan(cut)}) {
    parser.add(piece);
    while (const std::optional<PingEvent> event = parser.next()) {
      answer(line, *event, scenario);
    }
  }
  PingParser whole;
  whole.add(bytes);
  while (const std::optional<PingEvent> event = whole.last()) {
    answer(datagram, *event, scenario);
  }
}

const fuzz::Listed kListed("ping360", take);

}  // namespace
}  // namespace insonify::ping360_fuzzer

// streamer_fuzzer.cpp -- takes any bytes as what a client sends to an Omniscan 450 and to a Surveyor 240-16.

#include "fuzz/fuzzer.h"
#include "insonify/files.h"
#include "insonify/wire/ping_streamer.h"

namespace insonify::streamer_fuzzer {
namespace {

using fuzz::expect;

// The messages of a ping with the settings, if the simulated sonar can have them.
void ping(const PingStreamer& streamer, const Scenario& scenario) {
  const SonarConfig sonar = streamer.config(scenario.sonars[0], scenario);
  sonar.validate();
  expect(streamer.period() >= 0);
  Ping ping;
  ping.bin_count = sonar.bin_count;
  ping.beam_count = sonar.beam_count;
  ping.intensity.assign(static_cast<std::size_t>(ping.bin_count) * ping.beam_count, 1e-6F);
  ping.intensity[ping.index(ping.bin_count / 3, 0)] = 1;
  for (const PingFrame& frame : streamer.data(ping, sonar, {}, 1e9)) {
    expect(frame.payload.size() < 65000);  // It fits a datagram.
  }
}

void take(fuzz::Bytes bytes) {
  static const Scenario scenario = parse_scenario(
      "model: calibrated\npoints: [{position: [3, 0, 0], target_strength_db: -20}]\n"
      "sonars: [{beam_count: 1, bin_count: 100, azimuth_aperture_deg: 2, min_range: 0.75, max_range: 20}]\n");
  for (const auto& streamer : {make_omniscan450(), make_surveyor240()}) {
    PingParser parser;
    parser.add(bytes);
    while (const std::optional<PingEvent> event = parser.last()) {
      const StreamerAnswer answer = event->kind == PingEvent::Kind::kFrame ? streamer->take(event->frame)  //
                                                                           : StreamerAnswer{};
      expect(!answer.accepted || answer.frames.empty());
      if (answer.accepted) {
        fuzz::expect_error_or_nothing([&] { ping(*streamer, scenario); });
      }
    }
  }
}

const fuzz::Listed kListed("streamer", take);

}  // namespace
}  // namespace insonify::streamer_fuzzer

// first_ping.cpp -- one ping of a scenario, and where its loudest echo comes from:
//
//     first_ping SCENARIO    # such as scenes/sphere.yaml

#include <insonify/error.h>
#include <insonify/files.h>
#include <insonify/simulator.h>

#include <algorithm>
#include <cstdio>

namespace {

void simulate(const char* file) {
  const insonify::Scenario scenario = insonify::load_scenario(file);
  insonify::Simulator simulator(scenario, insonify::load_scene(scenario));
  const insonify::SonarConfig& sonar = simulator.sonar(0);
  const insonify::Ping ping = simulator.make_ping(0, 0);

  // Values of a ping lie bin by bin, each bin from port to starboard.
  const auto loudest = std::max_element(ping.intensity.begin(), ping.intensity.end()) - ping.intensity.begin();
  const int bin = static_cast<int>(loudest / ping.beam_count), beam = static_cast<int>(loudest % ping.beam_count);
  const std::uint16_t instance = ping.instance[loudest];
  std::printf(
      "%d beams x %d bins; the loudest echo comes from %.2f m, %+.1f degrees, off %s\n", ping.beam_count,
      ping.bin_count, sonar.bin_range(bin), insonify::degrees_from_radians(sonar.beam_azimuth(beam)),
      instance == insonify::kNoLabel ? "nothing by itself" : simulator.scene().instances[instance].name.c_str());
}

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 2) {
    std::fprintf(stderr, "usage: first_ping SCENARIO\n");
    return 2;
  }
  try {
    simulate(arguments[1]);
    return 0;
  } catch (const insonify::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());  // One line: file, place, value and limit.
    return 1;
  }
}

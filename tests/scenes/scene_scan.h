// scene_scan.h -- the scan of a shipped scenario without noise and secondary echoes, with queries by angle and object.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "insonify/files.h"
#include "insonify/simulator.h"

namespace insonify::testing_scenes {

class SceneScan {
 public:
  explicit SceneScan(const std::string& name)
      : simulator_([&] {
          const std::array<std::string, 2> settings = {"receiver.noise=false", "secondary=none"};
          Scenario scenario = load_scenario(INSONIFY_SOURCE_DIR "/scenes/" + name + ".yaml", settings);
          Scene scene = load_scene(scenario);
          return Simulator(std::move(scenario), std::move(scene), 1);
        }()) {}

  [[nodiscard]] const SonarConfig& sonar() const { return simulator_.sonar(0); }
  [[nodiscard]] int pings() const { return simulator_.scenario().pings; }
  [[nodiscard]] Ping ping(int number) { return simulator_.make_ping(0, static_cast<std::uint64_t>(number)); }

  /// The ping whose head angle is nearest to an angle [degrees].
  [[nodiscard]] Ping ping_at(double head_angle_deg) {
    const auto off = [&](int number) {
      const double angle = degrees_from_radians(sonar().head_angle(static_cast<std::uint64_t>(number)));
      return std::abs(std::remainder(angle - head_angle_deg, 360));
    };
    int best = 0;
    for (int number = 1; number < pings(); ++number) {
      best = off(number) < off(best) ? number : best;
    }
    return ping(best);
  }

  /// Whether a bin's strongest echo is from a given model.
  [[nodiscard]] bool is_of(const Ping& ping, int bin, const std::string& model) const {
    const std::uint16_t instance = ping.instance[bin];
    return instance != kNoLabel && simulator_.scene().instances[instance].name.starts_with(model + "::");
  }

  /// Range of the first bin beyond `from` [m] whose strongest echo is from a given model [m].
  [[nodiscard]] std::optional<double> first_echo(const Ping& ping, const std::string& model, double from = 0) const {
    for (int bin = 0; bin < ping.bin_count; ++bin) {
      if (sonar().bin_range(bin) >= from && is_of(ping, bin, model)) {
        return sonar().bin_range(bin);
      }
    }
    return std::nullopt;
  }

  /// Material name of a bin's strongest echo.
  [[nodiscard]] std::string material(const Ping& ping, int bin) const {
    return simulator_.scene().materials[ping.material[bin]].name;
  }

  [[nodiscard]] static int strongest_bin(const Ping& ping) {
    return static_cast<int>(std::ranges::max_element(ping.intensity) - ping.intensity.begin());
  }

 private:
  Simulator simulator_;
};

}  // namespace insonify::testing_scenes

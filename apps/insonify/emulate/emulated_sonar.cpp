// emulated_sonar.cpp -- loads a scenario, picks the sonar and makes its pings.

#include "emulate/emulated_sonar.h"

#include "console/console.h"
#include "console/outcome.h"
#include "console/stop.h"
#include "insonify/files.h"

namespace insonify {
namespace {

Log log_to_user(bool quiet) {
  return [quiet](Severity severity, const std::string& message) {
    if (severity == Severity::kWarning) {
      complain("warning: " + message);
    } else if (!quiet) {
      say("{}\n", message);
    }
  };
}

template <typename Make>
auto checked(Make&& make) {
  try {
    return make();
  } catch (const Error& error) {
    throw InputError(error.what());
  }
}

std::string_view name_of(SonarType type) {
  return type == SonarType::kMechanicallyScanned ? "scanning (type: msis)" : "forward-looking (type: fls)";
}

int sonar_of(const EmulateOptions& options, const Scenario& scenario, SonarType type, std::string_view instrument) {
  for (std::size_t i = 0; i < scenario.sonars.size(); ++i) {
    const SonarConfig& sonar = scenario.sonars[i];
    if (options.sonar.empty() ? sonar.type == type : sonar.name == options.sonar) {
      if (sonar.type != type) {
        throw InputError(fmt::format("--sonar {}: is {}; emulate {} needs one that is {}", printable(options.sonar),
                                     name_of(sonar.type), instrument, name_of(type)));
      }
      return static_cast<int>(i);
    }
  }
  std::string names;
  for (const SonarConfig& sonar : scenario.sonars) {
    names += (names.empty() ? "" : ", ") + sonar.name;
  }
  throw InputError(options.sonar.empty()
                       ? fmt::format("{}: has no sonar that is {}, which emulate {} needs",
                                     printable(options.scenario.string()), name_of(type), instrument)
                       : fmt::format("--sonar {}: {} has no such sonar; it has {}", printable(options.sonar),
                                     printable(options.scenario.string()), printable(names)));
}

}  // namespace

EmulatedSonar::EmulatedSonar(const EmulateOptions& options, SonarType type, std::string_view instrument)
    : scenario_(checked([&] { return load_scenario(options.scenario, options.settings, log_to_user(options.quiet)); })),
      index_(sonar_of(options, scenario_, type, instrument)),
      given_(scenario_.sonars[static_cast<std::size_t>(index_)]),
      requests_(checked([&] { return ScenarioRequests(scenario_); })),
      simulator_(checked(
          [&] { return Simulator(scenario_, load_scene(scenario_, log_to_user(options.quiet)), options.threads); })) {
  note_when_asked();
  simulator_.stop_when(&stop_asked());
}

MessageLevels EmulatedSonar::levels() const {
  return SonarMessages(message_source(scenario_, config())).levels();
}

const Ping& EmulatedSonar::ping(std::optional<double> head_angle) {
  const WallClock::time_point begin = WallClock::now();
  const double time = std::chrono::duration<double>(begin - start_).count();
  PingRequest request = requests_.at(index_, number_++, time);
  request.head_angle = head_angle;
  simulator_.ping(index_, request, ping_);
  computing_time_ = std::chrono::duration<double>(WallClock::now() - begin).count();
  return ping_;
}

}  // namespace insonify

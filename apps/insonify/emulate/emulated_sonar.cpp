// emulated_sonar.cpp -- loads a scenario, picks the sonar and makes its pings.

#include "emulate/emulated_sonar.h"

#include <algorithm>

#include "console/console.h"
#include "console/outcome.h"
#include "console/stop.h"
#include "insonify/files.h"
#include "insonify/printable.h"
#include "insonify/scene_view.h"

namespace insonify {
namespace {

std::string_view name_of(Product product) {
  constexpr std::string_view kNames[] = {"forward-looking (type: fls)", "scanning (type: msis)",
                                         "side-scan (type: sss)"};
  return kNames[static_cast<std::size_t>(product)];
}

std::string names_in(const Scenario& scenario) {
  std::string names;
  for (const SonarConfig& sonar : scenario.sonars) {
    names += (names.empty() ? "" : ", ") + sonar.name;
  }
  return names;
}

// @param option  That gives the name.
int sonar_named(const Scenario& scenario, const std::string& name, std::string_view option, Product product,
                std::string_view instrument) {
  for (std::size_t i = 0; i < scenario.sonars.size(); ++i) {
    if (scenario.sonars[i].name == name) {
      if (scenario.sonars[i].product() != product) {
        throw InputError(fmt::format("{} {}: is {}; emulate {} needs one that is {}", option, printable(name),
                                     name_of(scenario.sonars[i].product()), instrument, name_of(product)));
      }
      return static_cast<int>(i);
    }
  }
  throw InputError(fmt::format("{} {}: {} has no such sonar; it has {}", option, printable(name),
                               printable(scenario.file.string()), printable(names_in(scenario))));
}

int sonar_of(const EmulateOptions& options, const Scenario& scenario, Product product, std::string_view instrument) {
  if (!options.sonar.empty()) {
    return sonar_named(scenario, options.sonar, "--sonar", product, instrument);
  }
  const auto first = std::ranges::find(scenario.sonars, product, &SonarConfig::product);
  if (first == scenario.sonars.end()) {
    throw InputError(fmt::format("{}: has no sonar that is {}, which emulate {} needs",
                                 printable(options.scenario.string()), name_of(product), instrument));
  }
  return static_cast<int>(first - scenario.sonars.begin());
}

}  // namespace

EmulatedSonar::EmulatedSonar(const EmulateOptions& options, Product product, std::string_view instrument)
    : scenario_(
          checked_input([&] { return load_scenario(options.scenario, options.settings, log_to_user(options.quiet)); })),
      index_(sonar_of(options, scenario_, product, instrument)),
      given_(scenario_.sonars[static_cast<std::size_t>(index_)]),
      high_(options.high.empty() ? -1 : sonar_named(scenario_, options.high, "--high", product, instrument)),
      simulator_(checked_input([&] {
        const Log log = log_to_user(options.quiet);
        Scene scene = load_scene(scenario_, log);
        scenario_ = flown(std::move(scenario_), scene);
        return Simulator(scenario_, std::move(scene), options.threads, {}, log);
      })),
      requests_(checked_input([&] { return ScenarioRequests(scenario_); })) {
  note_when_asked(IgnoredInterrupt::kEnds);
  simulator_.stop_when(&stop_asked());
}

MessageLevels EmulatedSonar::levels() const {
  return SonarMessages(message_source(scenario_, config())).levels();
}

Channels EmulatedSonar::look(const SonarConfig& fan, int columns, int rows) {
  const WallClock::time_point begin = WallClock::now();
  const PingRequest request = requests_.at(index_, number_++, time_at(begin));
  simulator_.place(index_, request);
  Channels seen = look_along_fan(simulator_.engine(), fan, scenario_.water_at(fan),
                                 simulator_.world_from_housing(index_, request), columns, rows);
  computing_time_ = std::chrono::duration<double>(WallClock::now() - begin).count();
  return seen;
}

const Ping& EmulatedSonar::ping(std::optional<double> head_angle) {
  const WallClock::time_point begin = WallClock::now();
  PingRequest request = requests_.at(index_, number_++, time_at(begin));
  request.head_angle = head_angle;
  simulator_.ping(index_, request, ping_);
  computing_time_ = std::chrono::duration<double>(WallClock::now() - begin).count();
  return ping_;
}

}  // namespace insonify

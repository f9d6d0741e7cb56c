// recordings.cpp -- writes each ping to every recording of its sonar.

#include "run/recordings.h"

namespace insonify {

RecordKinds RecordKinds::parse(const std::string& text) {
  return {.h5 = text != "mcap", .mcap = text != "h5"};
}

std::vector<std::string> RecordKinds::endings() const {
  std::vector<std::string> endings;
  if (h5) {
    endings.emplace_back(".h5");
  }
  if (mcap) {
    endings.emplace_back(".mcap");
  }
  return endings;
}

SonarRecordings::SonarRecordings(const std::filesystem::path& folder, const Simulator& simulator, int sonar,
                                 const RecordOptions& options) {
  const Scenario& scenario = simulator.scenario();
  const SonarConfig& config = simulator.sonar(sonar);
  for (const std::string& ending : options.kinds.endings()) {
    files_.push_back(folder / (config.name + ending));
  }
  if (options.kinds.h5) {
    h5_.emplace(files_.front(), scenario, simulator.scene(), config, options.h5);
  }
  if (options.kinds.mcap) {
    McapOptions mcap = options.mcap;
    mcap.run = run_facts(scenario, simulator.scene());
    mcap_.emplace(files_.back(), std::vector{message_source(scenario, config)}, mcap);
  }
}

void SonarRecordings::add(const Ping& ping) {
  if (h5_) {
    h5_->add(ping);
  }
  if (mcap_) {
    mcap_->add(0, ping);
  }
}

void SonarRecordings::close() {
  if (h5_) {
    h5_->close();
  }
  if (mcap_) {
    mcap_->close();
  }
}

std::vector<std::filesystem::path> SonarRecordings::places() const {
  std::vector<std::filesystem::path> places;
  if (h5_) {
    places.push_back(h5_->place());
  }
  if (mcap_) {
    places.push_back(mcap_->place());
  }
  return places;
}

}  // namespace insonify

// recorded_pings.cpp -- forwards each call to the reader of the file's format.

#include "insonify/recorded_pings.h"

#include "io/recorded/open_recording.h"

namespace insonify {

struct RecordedPings::State {
  std::unique_ptr<PingReader> reader;
};

RecordedPings::RecordedPings(const std::filesystem::path& path, const std::string& sonar)
    : state_(std::make_unique<State>(State{open_pings(path, sonar)})) {}

RecordedPings::~RecordedPings() = default;
RecordedPings::RecordedPings(RecordedPings&&) noexcept = default;
RecordedPings& RecordedPings::operator=(RecordedPings&&) noexcept = default;

std::uint64_t RecordedPings::ping_count() const {
  return state_->reader->ping_count();
}

int RecordedPings::bin_count() const {
  return state_->reader->bin_count();
}

int RecordedPings::beam_count() const {
  return state_->reader->beam_count();
}

const std::string& RecordedPings::sonar() const {
  return state_->reader->sonar();
}

const std::string& RecordedPings::model() const {
  return state_->reader->model();
}

double RecordedPings::full_scale() const {
  return state_->reader->full_scale();
}

std::vector<double> RecordedPings::intensity(std::uint64_t ping) const {
  return state_->reader->intensity(ping);
}

double RecordedPings::greatest_count() const {
  return state_->reader->greatest_count();
}

std::vector<double> RecordedPings::counts(std::uint64_t ping) const {
  return state_->reader->counts(ping);
}

Ping RecordedPings::ping(std::uint64_t ping) const {
  return state_->reader->ping(ping);
}

SonarConfig RecordedPings::sonar_config() const {
  return state_->reader->sonar_config();
}

ReceiverConfig RecordedPings::receiver_config() const {
  return state_->reader->receiver_config();
}

}  // namespace insonify

// ping_source.cpp -- opens a recording by what its first bytes say that it is.

#include "pictures/ping_source.h"

#include <fmt/format.h>

#include "console/outcome.h"
#include "insonify/recording_info.h"

namespace insonify {

PingSource::PingSource(const std::filesystem::path& path, const std::string& sonar) {
  if (is_mcap(path)) {
    mcap_.emplace(path, sonar);
    sonar_ = mcap_->source().sonar;
    receiver_ = mcap_->source().receiver;
    model_ = mcap_->source().model;
    return;
  }
  h5_.emplace(path);
  sonar_ = h5_->sonar_config();
  receiver_ = h5_->receiver_config();
  if (!sonar.empty() && sonar != sonar_.name) {
    throw InputError(fmt::format("{}: has no sonar {}; its sonar is {}", path.string(), sonar, sonar_.name));
  }
  if (h5_->model() != "calibrated" && h5_->model() != "paper") {
    throw InputError(
        fmt::format("{}: its attribute model is \"{}\", must be calibrated or paper", path.string(), h5_->model()));
  }
  model_ = h5_->model() == "paper" ? EchoModel::kPaper : EchoModel::kCalibrated;
}

std::uint64_t PingSource::ping_count() const {
  return h5_ ? h5_->ping_count() : mcap_->ping_count();
}

Ping PingSource::ping(std::uint64_t number) const {
  return h5_ ? h5_->ping(number) : mcap_->ping(number);
}

}  // namespace insonify

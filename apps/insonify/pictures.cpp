// pictures.cpp -- which pictures a run draws of its pings, and the files they go to.

#include "pictures.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>

#include "commands.h"
#include "insonify/files.h"

namespace insonify {

PictureChoice PictureChoice::parse(const std::string& text) {
  if (text == "all") {
    return {std::numeric_limits<std::uint64_t>::max()};
  }
  if (text == "none" || text == "last") {
    return {text == "last" ? 1U : 0U};
  }
  PictureChoice choice;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), choice.most);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) {
    throw InputError(fmt::format("--pictures {} must be all, last, none or a number of pings", text));
  }
  return choice;
}

bool PictureChoice::takes(std::uint64_t ping, std::uint64_t total) const {
  if (most >= total) {
    return true;
  }
  // The pings at which the share that is due so far reaches the next whole number.
  return (ping + 1) * most / total > ping * most / total;
}

PingPictures::PingPictures(std::filesystem::path folder, const SonarConfig& sonar, Display display,
                           PictureChoice choice, std::uint64_t total)
    : folder_(std::move(folder)), sonar_(sonar), display_(display), choice_(choice), total_(total) {
  if (sonar_.type == SonarType::kMechanicallyScanned && choice_.most > 0) {
    scan_ = std::make_unique<ScanView>(sonar_);
  }
}

void PingPictures::add(const Ping& ping) {
  if (scan_ != nullptr) {
    scan_->add(ping);
  } else if (sonar_.type == SonarType::kForwardLooking && choice_.takes(ping.number, total_)) {
    write(fmt::format("polar_{:04}", ping.number), draw_polar(ping, sonar_, display_));
    write(fmt::format("fan_{:04}", ping.number), draw_fan(ping, sonar_, display_));
  }
}

void PingPictures::finish() {
  if (scan_ != nullptr) {
    write("scan", scan_->draw(display_));
    write("polar", scan_->draw_polar(display_));
  }
}

void PingPictures::write(const std::string& name, const Picture& picture) {
  const std::filesystem::path path = folder_ / fmt::format("{}_{}.png", sonar_.name, name);
  write_png(path, picture);
  files_.push_back(path);
}

}  // namespace insonify

// pictures.cpp -- chooses the pings of a run to draw, and writes their pictures.

#include "pictures/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "console/outcome.h"

namespace insonify {
PictureChoice PictureChoice::parse(const std::string& text) {
  if (text == "all") {
    return {.most = std::numeric_limits<std::uint64_t>::max()};
  }
  if (text == "none" || text == "last") {
    return {.most = text == "last" ? 1U : 0U};
  }
  PictureChoice choice;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), choice.most);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) {
    throw InputError(fmt::format("--pictures {} must be all, last, none or a number of pings", text));
  }
  return choice;
}

bool PictureChoice::takes(std::uint64_t ping, std::uint64_t total) const {
  if (!only.empty()) {
    return std::ranges::find(only, ping) != only.end();
  }
  if (most >= total) {
    return true;
  }
  // Pings at which the rounded-down number of pictures due increases.
  return (ping + 1) * most / total > ping * most / total;
}

PingPictures::PingPictures(PictureFolder& folder, const SonarConfig& sonar, const PictureStyle& style,
                           PictureChoice choice, std::uint64_t total)
    : folder_(&folder),
      sonar_(sonar),
      model_(style.model),
      fixed_(style.fixed_levels),
      display_(style.display),
      choice_(std::move(choice)),
      total_(total) {
  if (sonar_.product() == Product::kLine && choice_.most > 0) {
    scan_ = std::make_unique<ScanView>(sonar_);
  }
}

void PingPictures::add(const Ping& ping) {
  if (model_ == EchoModel::kPaper || choice_.most == 0) {
    add_shown(ping);
    return;
  }
  const Ping raised = shown(ping);
  if (!scaled_ && !fixed_ && scan_ == nullptr) {
    display_.full_scale = fitting_full_scale(intensities_to_fit(raised, sonar_));
    scaled_ = true;
  }
  add_shown(raised);
}

// The ping with what is drawn as its intensities, in the calibrated model.
Ping PingPictures::shown(const Ping& ping) const {
  return display_.of_counts ? counts_as_intensities(ping) : raised_by_range(ping, sonar_, display_.raised_per_decade);
}

// One ping of a scan is not representative of the others: each picture is scaled to fit all that it shows.
void PingPictures::fit_scan() {
  if (model_ == EchoModel::kCalibrated && !fixed_) {
    display_.full_scale = scan_->fitting_full_scale();
  }
}

void PingPictures::add_shown(const Ping& ping) {
  const bool due = choice_.takes(ping.number, total_);
  if (due || scan_ != nullptr) {
    note_brightest(ping);
  }
  if (scan_ != nullptr) {
    scan_->add(ping);
    if (due && ping.number + 1 < total_) {  // finish() draws the last ping.
      fit_scan();
      write(fmt::format("scan_{:04}", ping.number), scan_->draw(display_));
    }
  } else if (sonar_.product() == Product::kImage) {
    last_drawn_ = due || choice_.most == 0;
    if (due) {
      draw_fan_of(ping);
    }
  }
}

void PingPictures::finish(const Ping& last) {
  if (scan_ != nullptr) {
    fit_scan();
    write("scan", scan_->draw(display_));
    write("polar", scan_->draw_polar(display_));
  } else if (!last_drawn_) {
    const Ping drawn = model_ == EchoModel::kPaper ? last : shown(last);
    note_brightest(drawn);
    draw_fan_of(drawn);
  }
}

void PingPictures::note_brightest(const Ping& ping) {
  for (const float intensity : ping.intensity) {
    brightest_ = std::max(brightest_, static_cast<double>(intensity));
    darkest_ = std::min(darkest_, static_cast<double>(intensity));
  }
}

std::string PingPictures::darkness_text() const {
  if (display_.of_counts && !files_.empty() && darkest_ == display_.full_scale) {
    return fmt::format("the pictures of {} are white: all counts are {:.0f}; full scale is too low", sonar_.name,
                       darkest_);
  }
  const double darkest = display_.of_counts ? 0 : display_.full_scale * std::pow(10, display_.floor_db / 10);
  if (!fixed_ || files_.empty() || brightest_ > darkest) {
    return "";
  }
  if (display_.of_counts) {
    return fmt::format("the pictures of {} are black: all counts are 0", sonar_.name);
  }
  return fmt::format("the pictures of {} are black: {}, and --levels begins at {:.4g} dB", sonar_.name,
                     brightest_ > 0 ? fmt::format("their brightest point has {:.4g} dB", 10 * std::log10(brightest_))
                                    : "nothing was received",
                     10 * std::log10(darkest));
}

void PingPictures::draw_fan_of(const Ping& ping) {
  write(fmt::format("polar_{:04}", ping.number), draw_polar(ping, sonar_, display_));
  write(fmt::format("fan_{:04}", ping.number), draw_fan(ping, sonar_, display_));
}

void PingPictures::write(const std::string& name, const Picture& picture) {
  files_.push_back(folder_->write(fmt::format("{}_{}.png", sonar_.name, name), picture));
}

}  // namespace insonify

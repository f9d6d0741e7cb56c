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
      mask_bits_(style.mask_bits),
      fixed_(style.fixed_levels),
      display_(style.display),
      choice_(std::move(choice)),
      total_(total) {
  if (sonar_.product() == Product::kLine && choice_.most > 0) {
    scan_ = std::make_unique<ScanView>(sonar_);
  } else if (sonar_.product() == Product::kWaterfall || (style.waterfall && sonar_.beam_count == 1)) {
    waterfall_ = std::make_unique<Waterfall>(sonar_, style.waterfall_options);
  }
}

void PingPictures::add(std::size_t /*sonar*/, const Ping& ping) {
  if (choice_.most == 0 && choice_.only.empty()) {
    return;
  }
  last_ = shown(ping);
  if (model_ == EchoModel::kCalibrated && !scaled_ && !fixed_ && scan_ == nullptr && waterfall_ == nullptr) {
    display_.full_scale = fitting_full_scale(intensities_to_fit(last_, sonar_));
    scaled_ = true;
  }
  const bool due = choice_.takes(ping.number, total_);
  last_drawn_ = due || scan_ != nullptr || waterfall_ != nullptr;
  if (waterfall_ != nullptr) {
    note_brightest();
    waterfall_->add(last_);
    return;
  }
  if (scan_ != nullptr) {
    note_brightest();
    scan_->add(last_);
    if (mask_bits_ > 0) {
      instances_.push_back(last_.instance);
      materials_.push_back(last_.material);
    }
    if (due && ping.number + 1 < total_) {  // close() draws the last ping.
      draw_scan(fmt::format("scan_{:04}", ping.number), false);
    }
  } else if (due && sonar_.product() == Product::kImage) {
    draw_fan_of_last();
  }
}

// The ping with what is drawn as its intensities.
Ping PingPictures::shown(const Ping& ping) const {
  return model_ == EchoModel::kPaper ? ping
         : display_.of_counts        ? counts_as_intensities(ping)
                                     : raised_by_range(ping, sonar_, display_.raised_per_decade);
}

void PingPictures::close() {
  if (scan_ != nullptr && !last_.intensity.empty()) {
    draw_scan("scan", true);
  } else if (waterfall_ != nullptr && !last_.intensity.empty()) {
    if (!fixed_) {
      display_.full_scale = waterfall_->fitting_full_scale();
    }
    write("waterfall", waterfall_->draw(display_));
  } else if (!last_drawn_) {
    draw_fan_of_last();
    last_drawn_ = true;
  }
}

void PingPictures::note_brightest() {
  for (const float intensity : last_.intensity) {
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

void PingPictures::draw_fan_of_last() {
  note_brightest();
  const std::string polar = fmt::format("polar_{:04}", last_.number), fan = fmt::format("fan_{:04}", last_.number);
  write(polar, draw_polar(last_, sonar_, display_));
  write(fan, draw_fan(last_, sonar_, display_));
  if (mask_bits_ > 0) {
    for (const auto& [layer, labels] : {std::pair("instance", &last_.instance), {"material", &last_.material}}) {
      write_mask(layer, polar, draw_polar_numbers(*labels, sonar_, display_));
      write_mask(layer, fan, draw_fan_numbers(*labels, sonar_, display_));
    }
  }
}

// One ping of a scan is not representative of the others: each picture is scaled to fit all that it shows.
void PingPictures::draw_scan(const std::string& name, bool polar) {
  if (model_ == EchoModel::kCalibrated && !fixed_) {
    display_.full_scale = scan_->fitting_full_scale();
  }
  write(name, scan_->draw(display_));
  if (polar) {
    write("polar", scan_->draw_polar(display_));
  }
  if (mask_bits_ > 0) {
    for (const auto& [layer, labels] : {std::pair("instance", &instances_), {"material", &materials_}}) {
      write_mask(layer, name, scan_->draw_numbers(*labels, display_));
      if (polar) {
        write_mask(layer, "polar", scan_->draw_polar_numbers(*labels, display_));
      }
    }
  }
}

void PingPictures::write_mask(const char* layer, const std::string& name, const NumberPicture& picture) {
  files_.push_back(folder_->write(fmt::format("{}_{}_{}.png", sonar_.name, layer, name), picture, mask_bits_));
}

void PingPictures::write(const std::string& name, const Picture& picture) {
  files_.push_back(folder_->write(fmt::format("{}_{}.png", sonar_.name, name), picture));
}

}  // namespace insonify

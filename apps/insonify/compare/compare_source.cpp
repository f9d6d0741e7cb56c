// compare_source.cpp -- finds the requested recording or picture, and converts it to levels.

#include "compare/compare_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "insonify/error.h"
#include "insonify/recording_formats.h"

namespace insonify {
namespace {

// The requested recording in a folder; of a sonar recorded in several formats the first one, which is exact.
std::filesystem::path find_recording(const std::filesystem::path& folder, const std::string& sonar) {
  std::map<std::string, std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const RecordingFormat* const format = recording_format(entry.path());
    std::filesystem::path& best = found[entry.path().stem().string()];
    if (format != nullptr && format->readable && (best.empty() || format < recording_format(best))) {
      best = entry.path();
    }
  }
  std::erase_if(found, [](const auto& file) { return file.second.empty(); });
  std::vector<std::string> names;
  names.reserve(found.size());
  for (const auto& [name, path] : found) {
    names.push_back(name);
  }
  if (names.empty()) {
    throw Error(
        fmt::format("{}: there is not a recording ({}) in this folder", folder.string(), readable_recordings()));
  }
  const std::string wanted = sonar.empty() && names.size() == 1 ? names.front() : sonar;
  if (wanted.empty()) {
    throw Error(fmt::format("{}: there are recordings of {}; choose one with --sonar", folder.string(),
                            fmt::join(names, ", ")));
  }
  if (!found.contains(wanted)) {
    throw Error(
        fmt::format("{}: there is not a recording of {}, only of {}", folder.string(), wanted, fmt::join(names, ", ")));
  }
  return found.at(wanted);
}

// 255 or 65535 if all numbers are whole and at most that, as counts in floating-point numbers; else 0.
double greatest_of_counts(const std::vector<double>& values) {
  const bool whole = std::ranges::all_of(values, [](double value) { return value >= 0 && value == std::floor(value); });
  const double most = std::ranges::max(values);
  return !whole || most > 65535 ? 0 : most > 255 ? 65535 : 255;
}

std::string ping_name(const std::string& file, std::uint64_t ping) {
  return fmt::format("{} ping {}", file, ping);
}

}  // namespace

CompareSource::CompareSource(std::filesystem::path path, const std::string& sonar)
    : path_(std::filesystem::is_directory(path) ? find_recording(path, sonar) : std::move(path)) {
  if (!std::filesystem::exists(path_)) {
    throw Error(fmt::format("{}: no such file or folder", name()));
  }
  if (is_picture(path_)) {
    picture_ = load_grey_picture(path_);
  } else if (insonify::is_recording(path_) || is_foreign_recording(path_)) {
    recording_.emplace(path_, sonar);
  } else {
    throw Error(fmt::format("{}: is neither a recording ({}, {}) nor a picture ({})", name(), readable_recordings(),
                            foreign_recordings(), kPictureEndings));
  }
}

void CompareSource::set_levels(const Display& levels) {
  levels_ = levels;
  if (recording_) {
    levels_.full_scale *= full_scale();
  }
}

void CompareSource::use_counts() {
  counts_ = recording_ && recording_->greatest_count() > 0;
  if (recording_ && !counts_ && recording_->full_scale() == 1) {
    throw Error(fmt::format("{}: has no counts (receiver.counts); --counts compares those of recordings", name()));
  }
}

double CompareSource::full_scale() const {
  return counts_ ? recording_->greatest_count() : recording_->full_scale();
}

std::optional<SonarConfig> CompareSource::sonar_config() const {
  try {
    return recording_ && recording_->assumed().empty() ? std::optional(recording_->sonar_config()) : std::nullopt;
  } catch (const Error&) {
    return {};  // A recording of another program.
  }
}

std::vector<std::string> CompareSource::notes() const {
  std::vector<std::string> notes;
  if (recording_) {
    for (const std::string& note : recording_->notes()) {
      notes.push_back(fmt::format("{}: {}", name(), note));
    }
  }
  return notes;
}

double CompareSource::loudest(const std::vector<std::uint64_t>& pings) const {
  double loudest = 0;
  for (const std::uint64_t ping : pings) {
    loudest = std::max(loudest, std::ranges::max(recording_->intensity(ping)));
  }
  return loudest;
}

GreyPicture CompareSource::picture(std::uint64_t ping) const {
  if (!recording_) {
    return picture_;
  }
  return {ping_name(name(), ping), recording_->beam_count(), recording_->bin_count(), levels(ping)};
}

GreyPicture CompareSource::scan(const std::vector<std::uint64_t>& pings) const {
  if (!recording_ || !is_scan()) {
    return picture(pings.front());
  }
  const auto beams = static_cast<std::size_t>(recording_->beam_count());
  const std::size_t columns = beams * pings.size();
  GreyPicture picture{name(), static_cast<int>(columns), recording_->bin_count(), {}};
  picture.values.resize(columns * static_cast<std::size_t>(picture.rows));
  for (std::size_t ping = 0; ping < pings.size(); ++ping) {
    const std::vector<double> values = levels(pings[ping]);
    for (std::size_t i = 0; i < values.size(); ++i) {
      picture.values[i / beams * columns + i % beams * pings.size() + ping] = values[i];
    }
  }
  return picture;
}

std::vector<double> CompareSource::levels(std::uint64_t ping) const {
  std::vector<double> values = counts_ ? recording_->counts(ping) : recording_->intensity(ping);
  for (const double value : values) {
    if (!(value >= 0 && value <= levels_.full_scale)) {
      const double whole = full_scale() == 1 ? greatest_of_counts(values) : 0;
      throw Error(fmt::format("{}: an intensity is {:.6g}; it must be from 0 to full scale, {:.6g} (--full-scale{})",
                              ping_name(name(), ping), value, levels_.full_scale,
                              whole == 0 ? "" : fmt::format(" {:.0f}: all are whole, as counts are", whole)));
    }
  }
  std::ranges::transform(values, values.begin(), [&](double value) { return shown_level(levels_, value); });
  return values;
}

}  // namespace insonify

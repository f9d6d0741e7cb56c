// npz_file.cpp -- chooses an array of a NumPy archive, and what else it says of the pings.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/foreign/foreign_formats.h"
#include "io/foreign/numpy_pings.h"
#include "io/foreign/zip_archive.h"

namespace insonify {
namespace {

// An archive and the arrays in it.
class NumpyArchive {
 public:
  explicit NumpyArchive(const std::filesystem::path& path) : path_(path), zip_(path) {
    constexpr std::string_view kEnding = ".npy";
    for (const std::string& entry : zip_.names()) {
      if (entry.ends_with(kEnding)) {
        const std::string name = entry.substr(0, entry.size() - kEnding.size());
        headers_[name] = numpy_header_of(zip_.head(entry, kLongestNumpyHeader), title(name));
      }
    }
  }

  [[nodiscard]] std::string title(const std::string& name) const { return path_.string() + ": " + printable(name); }
  [[nodiscard]] const std::map<std::string, NumpyHeader>& headers() const { return headers_; }
  [[nodiscard]] bool has(const std::string& name) const { return headers_.contains(name); }

  [[nodiscard]] std::vector<std::byte> bytes(const std::string& name) const {
    const NumpyHeader& header = headers_.at(name);
    return zip_.read(name + ".npy", header.begin, header.bytes());
  }
  [[nodiscard]] NumpyArray array(const std::string& name) const {
    return numpy_array(headers_.at(name), bytes(name), title(name));
  }

  // Numbers of an array of any shape; none where it is not there, or is long.
  [[nodiscard]] std::vector<double> numbers(const std::string& name) const {
    constexpr std::uint64_t kMost = 1'000'000;
    const auto found = headers_.find(name);
    return found == headers_.end() || found->second.count == 0 || found->second.count > kMost ? std::vector<double>()
                                                                                              : array(name).numbers();
  }

 private:
  std::filesystem::path path_;
  ZipArchive zip_;
  std::map<std::string, NumpyHeader> headers_;
};

bool is_picture(const NumpyHeader& header) {
  return (header.shape.size() == 2 || header.shape.size() == 3) && header.count > 0 && header.type[1] != 'U' &&
         header.type[1] != 'S';
}

// The array that a name means: itself, or the intensities of the sonar of that name; without one the usual names, or
// the only array of two or three axes.
std::string chosen_array(const NumpyArchive& archive, const std::string& sonar, const std::filesystem::path& path) {
  std::vector<std::string> names, choices;
  if (sonar.empty()) {
    names = {"intensity", "polar"};
  } else {
    names = {sonar + "/intensity", sonar};
  }
  for (const std::string& name : names) {
    if (archive.has(name) && is_picture(archive.headers().at(name))) {
      return name;
    }
  }
  for (const auto& [name, header] : archive.headers()) {
    if (is_picture(header)) {
      choices.push_back(name);
    }
  }
  if (sonar.empty() && choices.size() == 1) {
    return choices.front();
  }
  const std::string list = printable(fmt::format("{}", fmt::join(choices, ", ")), kLongestName);
  if (choices.empty()) {
    throw Error(fmt::format("{}: has no array of two or three axes in {}", path.string(),
                            counted(archive.headers().size(), "array")));
  }
  throw Error(sonar.empty() ? fmt::format("{}: has the arrays {}; choose one with --sonar", path.string(), list)
                            : fmt::format("{}: has no array {}; it has {}", path.string(), printable(sonar), list));
}

ArrayScales scales_in(const NumpyArchive& archive, const std::string& prefix) {
  const auto first_of = [&](std::initializer_list<const char*> names) {
    std::vector<double> numbers;
    for (const char* name : names) {
      numbers = numbers.empty() ? archive.numbers(prefix + name) : numbers;
    }
    return numbers;
  };
  ArrayScales scales{first_of({"azimuth"}), first_of({"range", "range_m"})};
  if (scales.azimuths.empty()) {
    for (const double azimuth : first_of({"azimuth_deg"})) {
      scales.azimuths.push_back(radians_from_degrees(azimuth));
    }
  }
  if (scales.azimuths.empty()) {
    for (const double bearing : first_of({"bearing_deg"})) {  // To starboard, as of a compass.
      scales.azimuths.push_back(-radians_from_degrees(bearing));
    }
  }
  const std::vector<double> most = first_of({"slant_range_m"});
  scales.most_range = most.size() == 1 ? most.front() : 0;
  return scales;
}

AxisOrder order_of(const std::vector<std::uint64_t>& shape, const ArrayScales& scales, const std::string& name) {
  if (shape.size() == 2 && (name.ends_with("port") || name.ends_with("starboard"))) {
    return AxisOrder::kPingBin;
  }
  const std::uint64_t last = shape.back(), before = shape[shape.size() - 2];
  const bool turned = last != before && last == scales.ranges.size() && before == scales.azimuths.size();
  return turned ? AxisOrder::kBeamBin : AxisOrder::kBinBeam;
}

// What `insonify export` writes beside the intensities.
void add_recorded(ForeignTables& tables, const NumpyArchive& archive, const std::string& prefix,
                  const ArrayAxes& axes) {
  const std::vector<std::uint64_t> pings = {axes.length[0]}, poses = {axes.length[0], 7},
                                   counts = {axes.length[0], axes.length[1], axes.length[2]};
  const auto is = [&](const std::string& name, const std::vector<std::uint64_t>& shape, const char* type) {
    const auto found = archive.headers().find(prefix + name);
    return found != archive.headers().end() && found->second.shape == shape && found->second.type == type &&
           !found->second.fortran_order;
  };
  for (const char* name : {"time", "head_angle"}) {
    if (is(name, pings, "<f8")) {
      tables.add_numbers(name, "", 1, archive.numbers(prefix + name));
    }
  }
  if (is("world_from_sonar", poses, "<f8")) {
    tables.add_numbers("world_from_sonar", "", 7, archive.numbers(prefix + "world_from_sonar"));
  }
  if (is("counts", counts, "<u2")) {
    const auto shared = std::make_shared<NumpyArray>(archive.array(prefix + "counts"));
    tables.add("counts", "<u2", {axes.length[1], axes.length[2]}, true, "1",
               [shared, axes](std::uint64_t ping) { return ping_in(*shared, axes, ping); });
  }
}

// The settings of a recording that was exported, an object; null without.
nlohmann::json facts_in(const NumpyArchive& archive, const std::string& prefix) {
  constexpr std::uint64_t kMostFacts = std::uint64_t{1} << 26;
  constexpr int kDeepest = 16;
  const auto found = archive.headers().find(prefix + "attributes");
  if (found == archive.headers().end() || found->second.bytes() > kMostFacts) {
    return {};
  }
  const auto text = numpy_text(found->second, archive.bytes(prefix + "attributes"));
  if (!text) {
    return {};
  }
  constexpr bool kThrows = false;
  const nlohmann::json facts = nlohmann::json::parse(
      *text, [](int depth, auto, const auto&) { return depth <= kDeepest; }, kThrows);
  return facts.is_object() && facts.contains("settings") ? facts : nlohmann::json();
}

}  // namespace

std::unique_ptr<ForeignTables> open_npz(const std::filesystem::path& path, const std::string& sonar) {
  const NumpyArchive archive(path);
  const std::string name = chosen_array(archive, sonar, path);
  const std::string prefix = name.substr(0, name.find('/') == std::string::npos ? 0 : name.find('/') + 1);
  const ArrayScales scales = scales_in(archive, prefix);
  NumpyArray array = archive.array(name);
  const ArrayAxes axes = axes_of(array.shape, order_of(array.shape, scales, name), archive.title(name));
  auto tables = tables_of(path, std::move(array), axes);
  add_recorded(*tables, archive, prefix, axes);
  if (const nlohmann::json facts = facts_in(archive, prefix); !facts.is_null()) {
    for (const auto& [key, value] : facts.items()) {
      if (key != "settings" && key != "format" && key != "notes" && key != "assumed") {
        tables->set_attribute(key, value);
      }
    }
    tables->set_settings(facts.at("settings"));
  } else {
    describe_array(*tables, axes, scales);
  }
  return tables;
}

}  // namespace insonify

// numpy_pings.cpp -- takes an array of NumPy as pings, and reads .npy files.

#include "io/foreign/numpy_pings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>

#include "insonify/error.h"
#include "io/foreign/file_bytes.h"
#include "io/foreign/foreign_formats.h"

namespace insonify {

ArrayAxes axes_of(const std::vector<std::uint64_t>& shape, AxisOrder order, const std::string& name) {
  if (shape.size() > 3) {
    throw Error(fmt::format("{}: its array has {} axes ({}); must have [bin, beam] or [ping, bin, beam]", name,
                            shape.size(), fmt::join(shape, " x ")));
  }
  static constexpr std::array<int, 2> kLast[] = {{1, 2}, {2, 1}, {0, 1}};  // Places of the last two in ArrayAxes.
  const std::array<int, 2>& last = kLast[static_cast<int>(order)];
  std::vector<int> places = shape.size() == 1 ? std::vector{1} : std::vector{last[0], last[1]};
  if (shape.size() == 3) {
    places.insert(places.begin(), 0);
  }
  ArrayAxes axes;
  std::uint64_t stride = 1;
  for (std::size_t axis = shape.size(); axis-- > 0;) {
    const auto place = static_cast<std::size_t>(places[axis]);
    axes.length[place] = shape[axis];
    axes.stride[place] = stride;
    stride *= shape[axis];
  }
  return axes;
}

std::vector<std::byte> ping_in(const NumpyArray& array, const ArrayAxes& axes, std::uint64_t ping) {
  const std::size_t size = array.value_bytes();
  std::vector<std::byte> bytes(axes.length[1] * axes.length[2] * size);
  std::byte* into = bytes.data();
  for (std::uint64_t bin = 0; bin < axes.length[1]; ++bin) {
    for (std::uint64_t beam = 0; beam < axes.length[2]; ++beam, into += size) {
      const std::uint64_t from = ping * axes.stride[0] + bin * axes.stride[1] + beam * axes.stride[2];
      std::memcpy(into, &array.bytes[from * size], size);
    }
  }
  return bytes;
}

std::unique_ptr<ForeignTables> tables_of(const std::filesystem::path& path, NumpyArray array, const ArrayAxes& axes) {
  auto tables = std::make_unique<ForeignTables>(path, "NumPy", axes.length[0]);
  if (!array.note.empty()) {
    tables->note(array.note);
  }
  const auto shared = std::make_shared<NumpyArray>(std::move(array));
  tables->add("intensity", shared->type, {axes.length[1], axes.length[2]}, true, "1",
              [shared, axes](std::uint64_t ping) { return ping_in(*shared, axes, ping); });
  return tables;
}

void describe_array(ForeignTables& tables, const ArrayAxes& axes, const ArrayScales& scales) {
  constexpr std::uint64_t kMost = 1'000'000;  // Wrong numbers of bins and beams are refused by what reads `intensity`.
  SonarConfig sonar = foreign_sonar("array", "");
  sonar.bin_count = static_cast<int>(std::min(axes.length[1], kMost));
  sonar.beam_count = static_cast<int>(std::min(axes.length[2], kMost));
  sonar.max_range = kAssumedBin * sonar.bin_count;
  std::vector<std::string> missing;
  if (scales.ranges.size() > 1 && scales.ranges.size() == axes.length[1]) {
    const double half = (scales.ranges.back() - scales.ranges.front()) / static_cast<double>(axes.length[1] - 1) / 2;
    sonar.min_range = std::max(0.0, scales.ranges.front() - half);
    sonar.max_range = scales.ranges.back() + half;
  } else if (scales.most_range > 0) {
    sonar.max_range = scales.most_range;
  } else {
    missing.push_back(fmt::format("no ranges in it, bins of {} m are assumed", kAssumedBin));
  }
  if (!scales.azimuths.empty() && scales.azimuths.size() == axes.length[2]) {
    set_centres(sonar, scales.azimuths, tables);
  } else if (axes.length[2] > 1) {
    missing.push_back(
        fmt::format("no bearings in it, a fan of {:.0f} deg is assumed", degrees_from_radians(kAssumedAperture)));
  }
  if (sonar.max_range <= sonar.min_range) {
    missing.push_back("its ranges do not rise");
    sonar.max_range = sonar.min_range + kAssumedBin * sonar.bin_count;
  }
  missing.push_back(fmt::format("no frequency in it, {:.0f} kHz is assumed", sonar.frequency / 1000));
  if (missing.size() > 1 || scales.azimuths.empty()) {
    tables.assume(fmt::format("{}", fmt::join(missing, "; ")));
  }
  tables.describe(sonar);
}

std::unique_ptr<ForeignTables> open_npy(const std::filesystem::path& path, const std::string& sonar) {
  const FileBytes file(path);
  const NumpyHeader header = numpy_header_of(file.head(0, kLongestNumpyHeader), path.string());
  if (!file.has(header.begin, header.bytes())) {
    file.fail(header.begin, fmt::format("{} numbers of type {} need {} bytes; the file has {} more", header.count,
                                        header.type, header.bytes(), file.size() - header.begin));
  }
  const std::string head = file.head(header.begin, header.bytes());
  const auto bytes = std::as_bytes(std::span(head));
  NumpyArray array = numpy_array(header, {bytes.begin(), bytes.end()}, path.string());
  const ArrayAxes axes = axes_of(array.shape, AxisOrder::kBinBeam, path.string());
  auto tables = tables_of(path, std::move(array), axes);
  check_foreign_sonar(path, sonar, "array");
  describe_array(*tables, axes, {});
  return tables;
}

}  // namespace insonify

// hdf5_pings.cpp -- reads the intensities of an HDF5 recording, one ping at a time.

#include "io/recording/hdf5_pings.h"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <cmath>

#include "insonify/printable.h"
#include "io/file/hdf5_heap.h"
#include "io/file/hdf5_type.h"
#include "io/file/input_file.h"
#include "io/recording/recorded_settings.h"

namespace insonify {
namespace {

constexpr const char* kDataset = "intensity";
constexpr const char* kCounts = "counts";

H5Handle open_file(const std::filesystem::path& path) {
  check_input_file(path);
  return h5_open_recording(path);
}

H5Handle open_dataset(hid_t file, const std::filesystem::path& path) {
  if (H5Lexists(file, kDataset, H5P_DEFAULT) <= 0) {
    throw Error(fmt::format("{}: is not a recording: it has no dataset intensity", path.string()));
  }
  check_object(file, kDataset, path);
  return h5_own(H5Dopen2(file, kDataset, H5P_DEFAULT), H5Dclose, path, "open intensity");
}

std::array<hsize_t, 3> shape_of(hid_t dataset, const std::filesystem::path& path, const char* name = kDataset) {
  constexpr hsize_t kMost = 1'000'000;  // Bins or beams: more would be some other table.
  const H5Handle space = h5_own(H5Dget_space(dataset), H5Sclose, path, fmt::format("size {}", name));
  std::array<hsize_t, 3> shape{};
  const int axes = H5Sget_simple_extent_ndims(space.get());
  if (axes != 3) {
    throw Error(fmt::format("{}: {} has {}; a recording has three: ping, bin, beam", path.string(), name,
                            axes == 1 ? "1 axis" : fmt::format("{} axes", axes)));
  }
  h5_check(H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr), path, fmt::format("size {}", name));
  if (shape[1] < 1 || shape[2] < 1 || shape[1] > kMost || shape[2] > kMost) {
    throw Error(fmt::format("{}: {} has {} bins and {} beams; a recording has from 1 to {} of each", path.string(),
                            name, shape[1], shape[2], kMost));
  }
  return shape;
}

double full_scale_of(hid_t dataset, const std::filesystem::path& path) {
  const H5Handle type = h5_own(H5Dget_type(dataset), H5Tclose, path, "read the type of intensity");
  const H5T_class_t kind = H5Tget_class(type.get());
  if (kind == H5T_FLOAT) {
    return 1;
  }
  if (kind != H5T_INTEGER) {
    throw Error(fmt::format("{}: intensity must hold numbers", path.string()));
  }
  const int sign = H5Tget_sign(type.get()) == H5T_SGN_NONE ? 0 : 1;
  return std::ldexp(1, static_cast<int>(H5Tget_precision(type.get())) - sign) - 1;
}

// Text of variable or fixed length; "" if there is none.
std::string text_attribute(hid_t file, const char* name, const std::filesystem::path& path) {
  if (H5Aexists(file, name) <= 0) {
    return "";
  }
  const H5Handle attribute = h5_own(H5Aopen(file, name, H5P_DEFAULT), H5Aclose, path, "open an attribute");
  const H5Handle type = h5_own(H5Aget_type(attribute.get()), H5Tclose, path, "read an attribute");
  const H5Handle space = h5_own(H5Aget_space(attribute.get()), H5Sclose, path, "read an attribute");
  if (H5Tget_class(type.get()) != H5T_STRING || H5Sget_simple_extent_npoints(space.get()) != 1) {
    return "";
  }
  if (H5Tis_variable_str(type.get()) > 0) {
    char* pointer = nullptr;
    h5_check(H5Aread(attribute.get(), type.get(), &pointer), path, "read an attribute");
    std::string text = pointer != nullptr ? pointer : "";
    H5free_memory(pointer);
    return text;
  }
  std::string text(H5Tget_size(type.get()), '\0');
  h5_check(H5Aread(attribute.get(), type.get(), text.data()), path, "read an attribute");
  return text.substr(0, text.find('\0'));
}

// One row of a table of numbers [ping] or [ping, width].
std::vector<double> read_row(const H5Handle& file, const std::filesystem::path& path, const char* name,
                             std::uint64_t ping, hsize_t width) {
  const std::string doing = fmt::format("read {}", name);
  check_object(file.get(), name, path);
  const H5Handle dataset = h5_own(H5Dopen2(file.get(), name, H5P_DEFAULT), H5Dclose, path, doing);
  const H5Handle from = h5_own(H5Dget_space(dataset.get()), H5Sclose, path, doing);
  std::array<hsize_t, 2> shape = {0, 1};
  const int axes = H5Sget_simple_extent_ndims(from.get());
  if ((axes != 1 && axes != 2) || H5Sget_simple_extent_dims(from.get(), shape.data(), nullptr) < 0 ||
      shape[0] <= ping || shape[1] != width) {
    throw Error(fmt::format("{}: {} must have {} for each ping", path.string(), name,
                            width == 1 ? "a number" : fmt::format("{} numbers", width)));
  }
  const std::array<hsize_t, 2> start = {ping, 0}, length = {1, width};
  h5_check(H5Sselect_hyperslab(from.get(), H5S_SELECT_SET, start.data(), nullptr, length.data(), nullptr), path, doing);
  const H5Handle to = h5_own(H5Screate_simple(1, &width, nullptr), H5Sclose, path, doing);
  std::vector<double> values(width);
  h5_check(H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, to.get(), from.get(), H5P_DEFAULT, values.data()), path, doing);
  return values;
}

}  // namespace

Hdf5Pings::Hdf5Pings(const std::filesystem::path& path) : path_(path) {
  const H5Quiet quiet;
  file_ = open_file(path);
  dataset_ = open_dataset(file_.get(), path);
  shape_ = shape_of(dataset_.get(), path);
  full_scale_ = full_scale_of(dataset_.get(), path);
  static_cast<void>(checked_attributes(file_.get(), path, "the file"));
  sonar_ = text_attribute(file_.get(), "sonar", path);
  model_ = text_attribute(file_.get(), "model", path);
}

std::vector<double> Hdf5Pings::values(const H5Handle& dataset, const char* name, std::uint64_t ping) const {
  assert(ping < ping_count());
  const std::string doing = fmt::format("read {}", name);
  const std::array<hsize_t, 3> start = {ping, 0, 0};
  const std::array<hsize_t, 3> length = {1, shape_[1], shape_[2]};
  const H5Handle from = h5_own(H5Dget_space(dataset.get()), H5Sclose, path_, doing);
  h5_check(H5Sselect_hyperslab(from.get(), H5S_SELECT_SET, start.data(), nullptr, length.data(), nullptr), path_,
           doing);
  const H5Handle to =
      h5_own(H5Screate_simple(static_cast<int>(length.size()), length.data(), nullptr), H5Sclose, path_, doing);
  std::vector<double> values(length[1] * length[2]);
  h5_check(H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, to.get(), from.get(), H5P_DEFAULT, values.data()), path_, doing);
  return values;
}

std::vector<double> Hdf5Pings::intensity(std::uint64_t ping) const {
  const H5Quiet quiet;
  return values(dataset_, kDataset, ping);
}

double Hdf5Pings::greatest_count() const {
  const H5Quiet quiet;
  return H5Lexists(file_.get(), kCounts, H5P_DEFAULT) > 0 ? std::ldexp(1, sonar_config().bits) - 1 : 0;
}

std::vector<double> Hdf5Pings::counts(std::uint64_t ping) const {
  const H5Quiet quiet;
  check_object(file_.get(), kCounts, path_);
  const H5Handle dataset = h5_own(H5Dopen2(file_.get(), kCounts, H5P_DEFAULT), H5Dclose, path_, "open counts");
  if (shape_of(dataset.get(), path_, kCounts) != shape_) {
    throw Error(fmt::format("{}: counts and intensity have different sizes", path_.string()));
  }
  return values(dataset, kCounts, ping);
}

SonarConfig Hdf5Pings::sonar_config() const {
  const H5Quiet quiet;
  SonarConfig sonar = read_settings<SonarConfig>({file_.get(), path_}, "settings/sonar");
  try {
    sonar.validate();
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", path_.string(), error.what()));
  }
  if (sonar.bin_count != bin_count() || sonar.beam_count != beam_count()) {
    throw Error(fmt::format("{}: intensity has {} x {}, settings/sonar {} x {}", path_.string(),
                            counted(bin_count(), "bin"), counted(beam_count(), "beam"), sonar.bin_count,
                            sonar.beam_count));
  }
  return sonar;
}

ReceiverConfig Hdf5Pings::receiver_config() const {
  const H5Quiet quiet;
  return read_settings<ReceiverConfig>({file_.get(), path_}, "settings/receiver");
}

Ping Hdf5Pings::ping(std::uint64_t number) const {
  const std::vector<double> values = intensity(number);
  const H5Quiet quiet;
  const auto row = [&](const char* name, hsize_t width) { return read_row(file_, path_, name, number, width); };
  Ping ping;
  ping.number = number;
  ping.bin_count = bin_count();
  ping.beam_count = beam_count();
  ping.intensity.assign(values.begin(), values.end());
  for (const float value : ping.intensity) {
    if (!(value >= 0) || !std::isfinite(value)) {
      throw Error(fmt::format("{} ping {}: an intensity is {:.6g}, must be at least 0 and finite", path_.string(),
                              number, value));
    }
  }
  ping.time = row("time", 1).at(0);
  const std::vector<double> pose = row("world_from_sonar", 7);
  ping.world_from_sonar = {Vec3(pose[0], pose[1], pose[2]), Eigen::Quaterniond(pose[3], pose[4], pose[5], pose[6])};
  if (H5Lexists(file_.get(), "head_angle", H5P_DEFAULT) > 0) {
    ping.head_angle = row("head_angle", 1).at(0);
  }
  return ping;
}

}  // namespace insonify

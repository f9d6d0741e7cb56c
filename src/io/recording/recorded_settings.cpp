// recorded_settings.cpp -- the HDF5 calls behind H5Settings.

#include "io/recording/recorded_settings.h"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

#include "io/file/hdf5_heap.h"
#include "io/file/hdf5_type.h"

namespace insonify {

H5Settings::H5Settings(hid_t file, std::filesystem::path path) : file_(file), path_(std::move(path)) {}

// HDF5 reports an error for a path through a group that is missing, so each part is looked up.
bool H5Settings::has(const std::string& name) const {
  const auto exists = [&](const std::string& part) {
    return h5_check(H5Lexists(file_, part.c_str(), H5P_DEFAULT), path_, "find " + part) > 0;
  };
  for (std::size_t slash = name.find('/'); slash != std::string::npos; slash = name.find('/', slash + 1)) {
    if (!exists(name.substr(0, slash))) {
      return false;
    }
  }
  return exists(name);
}

void H5Settings::fail(const std::string& name, const std::string& what) const {
  throw Error(fmt::format("{}: {} {}", path_.string(), name, what));
}

std::optional<std::string> H5Settings::text(const std::string& name) const {
  if (!has(name)) {
    return {};
  }
  const std::string doing = "read " + name;
  check_object(file_, name, path_);
  const H5Handle dataset = h5_own(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, path_, doing);
  const H5Handle type = h5_own(H5Dget_type(dataset.get()), H5Tclose, path_, doing);
  const H5Handle space = h5_own(H5Dget_space(dataset.get()), H5Sclose, path_, doing);
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) <= 0 ||
      H5Sget_simple_extent_npoints(space.get()) != 1) {
    fail(name, "must hold one text");
  }
  check_heap_texts(file_, dataset.get(), path_, name);
  char* pointer = nullptr;
  h5_check(H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &pointer), path_, doing);
  std::string text = pointer != nullptr ? pointer : "";
  H5free_memory(pointer);
  return text;
}

std::optional<std::vector<double>> H5Settings::numbers(const std::string& name) const {
  if (!has(name)) {
    return {};
  }
  constexpr hssize_t kMost = 65536;  // Beams of a fan; more would be some other table.
  const std::string doing = "read " + name;
  check_object(file_, name, path_);
  const H5Handle dataset = h5_own(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, path_, doing);
  const H5Handle type = h5_own(H5Dget_type(dataset.get()), H5Tclose, path_, doing);
  const H5Handle space = h5_own(H5Dget_space(dataset.get()), H5Sclose, path_, doing);
  const hssize_t count = h5_check(H5Sget_simple_extent_npoints(space.get()), path_, doing);
  const H5T_class_t kind = H5Tget_class(type.get());
  if ((kind != H5T_FLOAT && kind != H5T_INTEGER && kind != H5T_ENUM) || count > kMost) {
    fail(name, "must hold numbers");
  }
  if (kind == H5T_ENUM) {  // Truth values, as H5Writer puts them: 8-bit integers with names.
    if (H5Tget_size(type.get()) != 1 || H5Tget_nmembers(type.get()) != 2 || count != 1) {
      fail(name, "must hold a truth value");
    }
    std::int8_t value = 0;
    h5_check(H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &value), path_, doing);
    return std::vector<double>{static_cast<double>(value)};
  }
  std::vector<double> values(static_cast<std::size_t>(count));
  h5_check(H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path_, doing);
  return values;
}

}  // namespace insonify

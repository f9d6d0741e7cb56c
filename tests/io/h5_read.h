// h5_read.h -- reads HDF5 files in tests, through HDF5 itself.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/file/hdf5.h"

namespace insonify {

class H5Reader {
 public:
  explicit H5Reader(const std::filesystem::path& path) : path_(path), file_(h5_open_to_read(path)) {}

  [[nodiscard]] hid_t id() const { return file_.get(); }

  [[nodiscard]] bool has(const std::string& name) const {
    return H5Lexists(file_.get(), name.c_str(), H5P_DEFAULT) > 0;
  }

  [[nodiscard]] std::vector<hsize_t> shape(const std::string& name) const {
    const H5Handle space = own(H5Dget_space(dataset(name).get()), H5Sclose);
    std::vector<hsize_t> lengths(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space.get())));
    H5Sget_simple_extent_dims(space.get(), lengths.data(), nullptr);
    return lengths;
  }

  /// Stored size of a dataset [bytes].
  [[nodiscard]] hsize_t storage(const std::string& name) const { return H5Dget_storage_size(dataset(name).get()); }

  template <typename Value>
  [[nodiscard]] std::vector<Value> values(const std::string& name) const {
    const H5Handle data = dataset(name);
    const H5Handle space = own(H5Dget_space(data.get()), H5Sclose);
    std::vector<Value> result(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())));
    check(H5Dread(data.get(), native<Value>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, result.data()));
    return result;
  }

  /// Rows [first, first + 1) of a dataset, flat.
  template <typename Value>
  [[nodiscard]] std::vector<Value> row(const std::string& name, hsize_t first) const {
    const H5Handle data = dataset(name);
    std::vector<hsize_t> start(shape(name).size(), 0);
    std::vector<hsize_t> length = shape(name);
    start[0] = first;
    length[0] = 1;
    const H5Handle from = own(H5Dget_space(data.get()), H5Sclose);
    check(H5Sselect_hyperslab(from.get(), H5S_SELECT_SET, start.data(), nullptr, length.data(), nullptr));
    const H5Handle to = own(H5Screate_simple(static_cast<int>(length.size()), length.data(), nullptr), H5Sclose);
    std::vector<Value> result(static_cast<std::size_t>(H5Sget_simple_extent_npoints(to.get())));
    check(H5Dread(data.get(), native<Value>(), to.get(), from.get(), H5P_DEFAULT, result.data()));
    return result;
  }

  [[nodiscard]] std::vector<std::string> texts(const std::string& name) const {
    const H5Handle data = dataset(name);
    const H5Handle type = own(H5Dget_type(data.get()), H5Tclose);
    const H5Handle space = own(H5Dget_space(data.get()), H5Sclose);
    std::vector<char*> pointers(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())));
    check(H5Dread(data.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()));
    std::vector<std::string> result(pointers.begin(), pointers.end());
    H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, pointers.data());
    return result;
  }

  template <typename Value>
  [[nodiscard]] Value attribute(const std::string& object, const std::string& name) const {
    const H5Handle attribute = open_attribute(object, name);
    if constexpr (std::is_same_v<Value, std::string>) {
      const H5Handle type = own(H5Aget_type(attribute.get()), H5Tclose);
      char* pointer = nullptr;
      check(H5Aread(attribute.get(), type.get(), &pointer));
      std::string text = pointer;
      H5free_memory(pointer);
      return text;
    } else {
      Value value{};
      check(H5Aread(attribute.get(), native<Value>(), &value));
      return value;
    }
  }

 private:
  template <typename Value>
  static hid_t native() {
    if constexpr (std::is_same_v<Value, float>) {
      return H5T_NATIVE_FLOAT;
    } else if constexpr (std::is_same_v<Value, double>) {
      return H5T_NATIVE_DOUBLE;
    } else if constexpr (std::is_same_v<Value, std::uint8_t>) {
      return H5T_NATIVE_UINT8;
    } else if constexpr (std::is_same_v<Value, std::uint16_t>) {
      return H5T_NATIVE_UINT16;
    } else if constexpr (std::is_same_v<Value, std::uint32_t>) {
      return H5T_NATIVE_UINT32;
    } else if constexpr (std::is_same_v<Value, std::int64_t>) {
      return H5T_NATIVE_INT64;
    } else {
      static_assert(std::is_same_v<Value, std::uint64_t>);
      return H5T_NATIVE_UINT64;
    }
  }

  [[nodiscard]] H5Handle own(hid_t id, H5Handle::Close close) const { return h5_own(id, close, path_, "read"); }
  void check(herr_t result) const { h5_check(result, path_, "read"); }
  [[nodiscard]] H5Handle dataset(const std::string& name) const {
    return own(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
  }
  [[nodiscard]] H5Handle open_attribute(const std::string& object, const std::string& name) const {
    return own(H5Aopen_by_name(file_.get(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  }

  std::filesystem::path path_;
  H5Handle file_;
};

}  // namespace insonify

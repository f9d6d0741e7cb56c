// hdf5_writer.cpp -- the HDF5 calls behind H5Writer.

#include "io/recording/hdf5_writer.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "base/utf8.h"

namespace insonify {
namespace {

// As h5py and PyTables keep truth values: an enumeration of two 8-bit integers.
H5Handle bool_type(const std::filesystem::path& path) {
  H5Handle type = h5_own(H5Tenum_create(H5T_STD_I8LE), H5Tclose, path, "write");
  for (const std::int8_t value : {std::int8_t{0}, std::int8_t{1}}) {
    h5_check(H5Tenum_insert(type.get(), value != 0 ? "TRUE" : "FALSE", &value), path, "write");
  }
  return type;
}

H5Handle text_type(const std::filesystem::path& path) {
  H5Handle type = h5_own(H5Tcopy(H5T_C_S1), H5Tclose, path, "write");
  h5_check(H5Tset_size(type.get(), H5T_VARIABLE), path, "write");
  h5_check(H5Tset_cset(type.get(), H5T_CSET_UTF8), path, "write");
  return type;
}

}  // namespace

H5Writer::H5Writer(hid_t file, std::filesystem::path path) : file_(file), path_(std::move(path)) {}

H5Handle H5Writer::own(hid_t id, H5Handle::Close close, const std::string& name) const {
  return h5_own(id, close, path_, "write " + name);
}

void H5Writer::put_values(const std::string& name, hid_t stored, hid_t given, hid_t space, const void* values,
                          const H5Note& note) const {
  const H5Handle links = own(H5Pcreate(H5P_LINK_CREATE), H5Pclose, name);
  h5_check(H5Pset_create_intermediate_group(links.get(), 1), path_, "write " + name);
  // Without times the same recording is the same bytes.
  const H5Handle creation = own(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name);
  h5_check(H5Pset_obj_track_times(creation.get(), false), path_, "write " + name);
  add_checksum(creation.get(), stored, space, name);
  const H5Handle dataset =
      own(H5Dcreate2(file_, name.c_str(), stored, space, links.get(), creation.get(), H5P_DEFAULT), H5Dclose, name);
  h5_check(H5Dwrite(dataset.get(), given, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), path_, "write " + name);
  annotate(name, note);
}

// For tables: in small ones the index of a chunk would take more than the values.
void H5Writer::add_checksum(hid_t creation, hid_t stored, hid_t space, const std::string& name) const {
  constexpr hssize_t kLeast = 64;  // Values.
  std::array<hsize_t, 2> shape{};
  if (H5Tget_class(stored) != H5T_STRING && H5Sget_simple_extent_npoints(space) >= kLeast) {
    const int rank = H5Sget_simple_extent_dims(space, shape.data(), nullptr);
    h5_check(H5Pset_chunk(creation, rank, shape.data()), path_, "write " + name);
    h5_check(H5Pset_fletcher32(creation), path_, "write " + name);
  }
}

void H5Writer::put(const std::string& name, double value, const H5Note& note) const {
  const H5Handle space = own(H5Screate(H5S_SCALAR), H5Sclose, name);
  put_values(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space.get(), &value, note);
}

void H5Writer::put(const std::string& name, bool value, const H5Note& note) const {
  const H5Handle space = own(H5Screate(H5S_SCALAR), H5Sclose, name);
  const H5Handle type = bool_type(path_);
  const auto stored = static_cast<std::int8_t>(value);
  put_values(name, type.get(), type.get(), space.get(), &stored, note);
}

void H5Writer::put(const std::string& name, std::int64_t value, const H5Note& note) const {
  const H5Handle space = own(H5Screate(H5S_SCALAR), H5Sclose, name);
  put_values(name, H5T_STD_I64LE, H5T_NATIVE_INT64, space.get(), &value, note);
}

void H5Writer::put(const std::string& name, std::uint64_t value, const H5Note& note) const {
  const H5Handle space = own(H5Screate(H5S_SCALAR), H5Sclose, name);
  put_values(name, H5T_STD_U64LE, H5T_NATIVE_UINT64, space.get(), &value, note);
}

void H5Writer::put(const std::string& name, const std::string& value, const H5Note& note) const {
  const H5Handle space = own(H5Screate(H5S_SCALAR), H5Sclose, name);
  const H5Handle type = text_type(path_);
  const std::string valid = as_utf8(value);
  const char* text = valid.c_str();
  put_values(name, type.get(), type.get(), space.get(), &text, note);
}

void H5Writer::put(const std::string& name, std::span<const double> values, const H5Note& note) const {
  const hsize_t length = values.size();
  const H5Handle space = own(H5Screate_simple(1, &length, nullptr), H5Sclose, name);
  put_values(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space.get(), values.data(), note);
}

void H5Writer::put(const std::string& name, std::span<const std::uint64_t> values, const H5Note& note) const {
  const hsize_t length = values.size();
  const H5Handle space = own(H5Screate_simple(1, &length, nullptr), H5Sclose, name);
  put_values(name, H5T_STD_U64LE, H5T_NATIVE_UINT64, space.get(), values.data(), note);
}

void H5Writer::put_rows(const std::string& name, std::span<const double> values, std::uint64_t columns,
                        const H5Note& note) const {
  const std::array<hsize_t, 2> shape{values.size() / columns, columns};
  const H5Handle space = own(H5Screate_simple(2, shape.data(), nullptr), H5Sclose, name);
  put_values(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space.get(), values.data(), note);
}

void H5Writer::put(const std::string& name, std::span<const std::string> values, const H5Note& note) const {
  const hsize_t length = values.size();
  const H5Handle space = own(H5Screate_simple(1, &length, nullptr), H5Sclose, name);
  const H5Handle type = text_type(path_);
  std::vector<std::string> valid(values.size());
  std::ranges::transform(values, valid.begin(), [](const std::string& value) { return as_utf8(value); });
  std::vector<const char*> texts;
  for (const std::string& value : valid) {
    texts.push_back(value.c_str());
  }
  put_values(name, type.get(), type.get(), space.get(), texts.data(), note);
}

void H5Writer::put_attribute(const std::string& object, const std::string& name, hid_t type, const void* value) const {
  const H5Handle space = own(H5Screate(H5S_SCALAR), H5Sclose, name);
  const H5Handle attribute = own(
      H5Acreate_by_name(file_, object.c_str(), name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose, name);
  h5_check(H5Awrite(attribute.get(), type, value), path_, "write " + name);
}

void H5Writer::attribute(const std::string& object, const std::string& name, std::string_view text) const {
  const H5Handle type = text_type(path_);
  const std::string copy = as_utf8(text);
  const char* pointer = copy.c_str();
  put_attribute(object, name, type.get(), &pointer);
}

void H5Writer::attribute(const std::string& object, const std::string& name, double value) const {
  put_attribute(object, name, H5T_IEEE_F64LE, &value);
}

void H5Writer::attribute(const std::string& object, const std::string& name, std::uint64_t value) const {
  put_attribute(object, name, H5T_STD_U64LE, &value);
}

void H5Writer::annotate(const std::string& object, const H5Note& note) const {
  if (!note.units.empty()) {
    attribute(object, "units", note.units);
  }
  attribute(object, "description", note.description);
}

}  // namespace insonify

// hdf5_tables.cpp -- lists what is at the root of the file, and reads it row by row or in blocks.

#include "io/recording/hdf5_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "insonify/printable.h"
#include "io/file/input_file.h"
#include "io/recording/hdf5_json.h"

namespace insonify {
namespace {

H5Handle native_type(const H5Handle& stored, const std::filesystem::path& path, const std::string& name) {
  return h5_own(H5Tget_native_type(stored.get(), H5T_DIR_ASCEND), H5Tclose, path, "read the type of " + name);
}

// As NumPy spells a type of numbers; "" for anything else.
std::string numpy_type(hid_t type) {
  const std::size_t size = H5Tget_size(type);
  if (size > sizeof(double)) {
    return "";
  }
  const char* order = size == 1 ? "|" : "<";
  switch (H5Tget_class(type)) {
    case H5T_FLOAT:
      return fmt::format("{}f{}", order, size);
    case H5T_INTEGER:
      return fmt::format("{}{}{}", order, H5Tget_sign(type) == H5T_SGN_NONE ? "u" : "i", size);
    default:
      return "";
  }
}

hid_t memory_type(NumberType type) {
  switch (type) {
    case NumberType::kFloat32:
      return H5T_NATIVE_FLOAT;
    case NumberType::kFloat64:
      return H5T_NATIVE_DOUBLE;
    case NumberType::kUint8:
      return H5T_NATIVE_UINT8;
    case NumberType::kUint16:
      return H5T_NATIVE_UINT16;
    case NumberType::kInt64:
      return H5T_NATIVE_INT64;
  }
  return H5T_NATIVE_DOUBLE;
}

bool has_checksums(hid_t dataset) {
  const H5Handle made(H5Dget_create_plist(dataset), H5Pclose);
  unsigned flags = 0;
  return H5Pget_filter_by_id2(made.get(), H5Z_FILTER_FLETCHER32, &flags, nullptr, nullptr, 0, nullptr, nullptr) >= 0;
}

// Callbacks of iterations only collect names: no exception may pass through HDF5.
herr_t add_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

}  // namespace

Hdf5Tables::Hdf5Tables(const std::filesystem::path& path) : RecordedTables(path) {
  check_input_file(path);
  file_ = h5_open_recording(path);
  if (h5_check(H5Lexists(file_.get(), "intensity", H5P_DEFAULT), path, "find intensity") == 0) {
    throw Error(fmt::format("{}: is not a recording: it has no dataset intensity", path.string()));
  }
  attributes_ = hdf5_attributes_json(file_.get(), path, "the file");
  if (const auto state = attributes_.find(kStateAttribute); state != attributes_.end()) {
    if (state->is_number_unsigned()) {
      state_ = state->get<std::uint64_t>();
    }
    attributes_.erase(state);
  }
  std::vector<std::string> names;
  h5_check(H5Literate(file_.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add_name, &names), path, "list its datasets");
  ping_count_ = std::numeric_limits<std::uint64_t>::max();
  for (const std::string& name : names) {
    add_table(name);
  }
}

// The attributes of a dataset, and the names of its axes among them.
void Hdf5Tables::read_axes(hid_t dataset, RecordedTable& table) const {
  table.notes = hdf5_attributes_json(dataset, path_, table.name);
  if (table.notes.contains("axes") && !table.notes["axes"].is_string()) {
    throw Error(fmt::format("{}: the attribute axes of {} cannot be read", path_.string(), table.name));
  }
  std::istringstream words(table.notes.value("axes", ""));
  for (std::string axis; words >> axis;) {
    table.axes.push_back(axis);
  }
  table.notes.erase("axes");
}

void Hdf5Tables::add_table(const std::string& name) {
  if (name == "." || name == "..") {
    throw Error(fmt::format("{}: is not a recording: it has a dataset called {}", path_.string(), name));
  }
  const H5Handle dataset = h5_open_object(file_.get(), name, path_);
  if (H5Iget_type(dataset.get()) != H5I_DATASET) {
    return;
  }
  const std::string doing = "read " + name;
  const H5Handle stored = h5_own(H5Dget_type(dataset.get()), H5Tclose, path_, doing);
  const H5Handle space = h5_own(H5Dget_space(dataset.get()), H5Sclose, path_, doing);
  std::vector<hsize_t> shape = hdf5_shape(space.get());
  if (H5Tget_class(stored.get()) == H5T_STRING) {
    const nlohmann::json texts = hdf5_dataset_json(dataset.get(), path_, name);
    if (texts.is_array()) {
      names_.push_back({name, texts.get<std::vector<std::string>>()});
    }
    return;
  }
  RecordedTable table;
  table.name = name;
  table.type = numpy_type(stored.get());
  if (table.type.empty()) {
    return;
  }
  table.value_bytes = H5Tget_size(stored.get());
  constexpr hsize_t kMostBytes = hsize_t{1} << 34;  // A ping of the most beams and bins, with its ranks, has 3 GB.
  if (std::vector<hsize_t> row = shape; !row.empty()) {
    row.front() = 1;
    if (!product_is_at_most(row, kMostBytes / table.value_bytes) || (shape.size() == 1 && shape.front() > kMostBytes)) {
      throw Error(fmt::format("{}: is not a recording: a row of {} is too large", path_.string(), name));
    }
  }
  read_axes(dataset.get(), table);
  table.checked = has_checksums(dataset.get());
  table.by_ping = !shape.empty() &&
                  (name == "intensity" || name == "counts" || (!table.axes.empty() && table.axes.front() == "ping"));
  if (table.by_ping) {
    ping_count_ = std::min<std::uint64_t>(ping_count_, shape.front());
    shape.erase(shape.begin());
  }
  if (!table.axes.empty() && table.axes.back() == "part" && table.type == "<f4" && !shape.empty() &&
      shape.back() == 2) {
    table.type = "<c8";  // Real and imaginary part.
    table.value_bytes *= 2;
    table.axes.pop_back();
    shape.pop_back();
  }
  table.row.assign(shape.begin(), shape.end());
  tables_.push_back(std::move(table));
}

nlohmann::json Hdf5Tables::settings() const {
  nlohmann::json found = nlohmann::json::object();
  if (h5_check(H5Lexists(file_.get(), "settings", H5P_DEFAULT), path_, "find settings") == 0) {
    return found;
  }
  const H5Handle group = h5_open_object(file_.get(), "settings", path_);
  std::vector<std::string> names;
  h5_check(H5Lvisit(group.get(), H5_INDEX_NAME, H5_ITER_INC, add_name, &names), path_, "list settings");
  for (const std::string& name : names) {
    const H5Handle object = h5_open_object(group.get(), name, path_);
    if (H5Iget_type(object.get()) == H5I_DATASET) {
      found[nlohmann::json::json_pointer("/" + name)] = hdf5_dataset_json(object.get(), path_, "settings/" + name);
    }
  }
  return found;
}

std::vector<std::byte> Hdf5Tables::row(const RecordedTable& table, std::uint64_t ping) const {
  const std::string doing = "read " + table.name;
  const H5Handle dataset = h5_open_object(file_.get(), table.name, path_);
  const H5Handle stored = h5_own(H5Dget_type(dataset.get()), H5Tclose, path_, doing);
  const H5Handle native = native_type(stored, path_, table.name);
  const H5Handle from = h5_own(H5Dget_space(dataset.get()), H5Sclose, path_, doing);
  std::vector<hsize_t> length = hdf5_shape(from.get());
  if (table.by_ping && !length.empty()) {
    std::vector<hsize_t> start(length.size(), 0);
    start.front() = ping;
    length.front() = 1;
    h5_check(H5Sselect_hyperslab(from.get(), H5S_SELECT_SET, start.data(), nullptr, length.data(), nullptr), path_,
             doing);
  }
  const H5Handle to = length.empty() ? h5_own(H5Screate(H5S_SCALAR), H5Sclose, path_, doing)
                                     : h5_own(H5Screate_simple(static_cast<int>(length.size()), length.data(), nullptr),
                                              H5Sclose, path_, doing);
  std::vector<std::byte> bytes(table.row_bytes());
  h5_check(H5Dread(dataset.get(), native.get(), to.get(), from.get(), H5P_DEFAULT, bytes.data()), path_, doing);
  return bytes;
}

void Hdf5Tables::read(const RecordedTable& table, NumberType type, std::span<const TableSlice> slices,
                      std::span<std::byte> bytes) const {
  const std::string doing = "read " + table.name;
  std::vector<hsize_t> start, count, step;
  for (const TableSlice& slice : slices) {
    start.push_back(slice.start);
    count.push_back(slice.count);
    step.push_back(slice.step);
  }
  const H5Handle dataset = h5_open_object(file_.get(), table.name, path_);
  const H5Handle from = h5_own(H5Dget_space(dataset.get()), H5Sclose, path_, doing);
  h5_check(H5Sselect_hyperslab(from.get(), H5S_SELECT_SET, start.data(), step.data(), count.data(), nullptr), path_,
           doing);
  const H5Handle to =
      h5_own(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose, path_, doing);
  h5_check(H5Dread(dataset.get(), memory_type(type), to.get(), from.get(), H5P_DEFAULT, bytes.data()), path_, doing);
}

}  // namespace insonify

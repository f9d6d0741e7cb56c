// hdf5_tables.cpp -- lists what is at the root of the file, and reads it row by row or in blocks.

#include "io/recording/hdf5_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <sstream>

#include "insonify/printable.h"
#include "io/file/hdf5_heap.h"
#include "io/file/hdf5_type.h"
#include "io/file/input_file.h"

namespace insonify {
namespace {

constexpr hsize_t kMostValues = 1'000'000;  // Of a list that is read as a whole.

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

std::vector<hsize_t> shape_of(hid_t space) {
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return shape;
}

// Whether lengths multiply to at most `most`; they may be anything in a file of strangers.
bool is_at_most(const std::vector<hsize_t>& shape, hsize_t most) {
  hsize_t product = 1;
  for (const hsize_t length : shape) {
    if (length > most || (length > 0 && product > most / length)) {
      return false;
    }
    product *= length;
  }
  return true;
}

// Texts of variable length, read by `read(type, buffer)`.
std::vector<std::string> read_texts(hid_t type, const H5Handle& space, hsize_t count,
                                    const std::function<void(hid_t, void*)>& read) {
  std::vector<char*> pointers(count, nullptr);
  read(type, pointers.data());
  std::vector<std::string> texts;
  for (const char* const pointer : pointers) {
    texts.emplace_back(pointer != nullptr ? pointer : "");
  }
  H5Dvlen_reclaim(type, space.get(), H5P_DEFAULT, pointers.data());
  return texts;
}

// A JSON number cannot be infinite or NaN.
nlohmann::json number_of(double value) {
  if (std::isnan(value)) {
    return "nan";
  }
  return std::isinf(value) ? nlohmann::json(value > 0 ? "inf" : "-inf") : nlohmann::json(value);
}

// Whatever small thing has a type and a space, as JSON: a text, a number, a truth value or lists of those.
nlohmann::json json_of(hid_t type_id, const H5Handle& space, const std::function<void(hid_t, void*)>& read) {
  const std::vector<hsize_t> shape = shape_of(space.get());
  if (!is_at_most(shape, kMostValues)) {
    return nullptr;
  }
  const hsize_t count = std::accumulate(shape.begin(), shape.end(), hsize_t{1}, std::multiplies<>());
  std::vector<nlohmann::json> values;
  const H5T_class_t kind = H5Tget_class(type_id);
  if (kind == H5T_STRING && H5Tis_variable_str(type_id) > 0) {
    for (std::string& text : read_texts(type_id, space, count, read)) {
      values.emplace_back(std::move(text));
    }
  } else if (kind == H5T_ENUM) {
    std::vector<std::int8_t> bits(count);
    if (H5Tget_size(type_id) != 1 || H5Tget_nmembers(type_id) != 2) {  // Truth values; HDF5 is slow with thousands.
      return nullptr;
    }
    read(type_id, bits.data());
    for (const std::int8_t bit : bits) {
      values.emplace_back(bit != 0);
    }
  } else if (kind == H5T_INTEGER && H5Tget_sign(type_id) == H5T_SGN_NONE) {
    std::vector<std::uint64_t> numbers(count);
    read(H5T_NATIVE_UINT64, numbers.data());
    values.assign(numbers.begin(), numbers.end());
  } else if (kind == H5T_INTEGER) {
    std::vector<std::int64_t> numbers(count);
    read(H5T_NATIVE_INT64, numbers.data());
    values.assign(numbers.begin(), numbers.end());
  } else if (kind == H5T_FLOAT) {
    std::vector<double> numbers(count);
    read(H5T_NATIVE_DOUBLE, numbers.data());
    std::ranges::transform(numbers, std::back_inserter(values), number_of);
  } else {
    return nullptr;
  }
  if (shape.empty()) {
    return values.empty() ? nlohmann::json() : values.front();
  }
  if (shape.size() == 1) {
    return values;
  }
  nlohmann::json rows = nlohmann::json::array();
  const std::size_t width = values.size() / std::max<hsize_t>(1, shape[0]);
  for (std::size_t i = 0; width > 0 && i < values.size(); i += width) {
    rows.push_back(nlohmann::json(std::vector(values.begin() + static_cast<std::ptrdiff_t>(i),
                                              values.begin() + static_cast<std::ptrdiff_t>(i + width))));
  }
  return rows;
}

// Callbacks of iterations only collect names: no exception may pass through HDF5.
herr_t add_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

nlohmann::json attributes_of(hid_t object, const std::filesystem::path& path, const std::string& owner) {
  const std::string doing = "read the attributes of " + owner;
  nlohmann::json found = nlohmann::json::object();
  for (const std::string& name : checked_attributes(object, path, owner)) {
    const H5Handle attribute = h5_own(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, path, doing);
    const H5Handle type = h5_own(H5Aget_type(attribute.get()), H5Tclose, path, doing);
    const H5Handle space = h5_own(H5Aget_space(attribute.get()), H5Sclose, path, doing);
    found[name] = json_of(type.get(), space, [&](hid_t memory, void* buffer) {
      h5_check(H5Aread(attribute.get(), memory, buffer), path, doing);
    });
  }
  return found;
}

nlohmann::json dataset_json(hid_t file, hid_t dataset, const std::filesystem::path& path, const std::string& name) {
  const H5Handle type = h5_own(H5Dget_type(dataset), H5Tclose, path, "read " + name);
  if (H5Tget_class(type.get()) == H5T_STRING && H5Tis_variable_str(type.get()) > 0) {
    check_heap_texts(file, dataset, path, name);
  }
  const H5Handle space = h5_own(H5Dget_space(dataset), H5Sclose, path, "read " + name);
  return json_of(type.get(), space, [&](hid_t memory, void* buffer) {
    h5_check(H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer), path, "read " + name);
  });
}

}  // namespace

Hdf5Tables::Hdf5Tables(const std::filesystem::path& path) : RecordedTables(path) {
  const H5Quiet quiet;
  check_input_file(path);
  file_ = h5_open_recording(path);
  if (h5_check(H5Lexists(file_.get(), "intensity", H5P_DEFAULT), path, "find intensity") == 0) {
    throw Error(fmt::format("{}: is no recording: it has no dataset intensity", path.string()));
  }
  attributes_ = attributes_of(file_.get(), path, "the file");
  if (const auto state = attributes_.find(kStateAttribute); state != attributes_.end()) {
    if (state->is_number_unsigned()) {
      state_ = static_cast<GrowingState>(state->get<std::uint64_t>());
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

void Hdf5Tables::add_table(const std::string& name) {
  if (name == "." || name == "..") {
    throw Error(fmt::format("{}: is no recording: it has a dataset called {}", path_.string(), name));
  }
  check_object(file_.get(), name, path_);
  const H5Handle object =
      h5_own(H5Oopen(file_.get(), name.c_str(), H5P_DEFAULT), H5Oclose, path_, "open " + printable(name));
  if (H5Iget_type(object.get()) != H5I_DATASET) {
    return;
  }
  const std::string doing = "read " + name;
  const H5Handle dataset = h5_own(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT), H5Dclose, path_, doing);
  const H5Handle stored = h5_own(H5Dget_type(dataset.get()), H5Tclose, path_, doing);
  const H5Handle space = h5_own(H5Dget_space(dataset.get()), H5Sclose, path_, doing);
  std::vector<hsize_t> shape = shape_of(space.get());
  if (H5Tget_class(stored.get()) == H5T_STRING) {
    const nlohmann::json texts = dataset_json(file_.get(), dataset.get(), path_, name);
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
    if (!is_at_most(row, kMostBytes / table.value_bytes) || (shape.size() == 1 && shape.front() > kMostBytes)) {
      throw Error(fmt::format("{}: is no recording: a row of {} is too large", path_.string(), name));
    }
  }
  table.notes = attributes_of(dataset.get(), path_, name);
  if (table.notes.contains("axes") && !table.notes["axes"].is_string()) {
    throw Error(fmt::format("{}: the attribute axes of {} cannot be read", path_.string(), name));
  }
  std::istringstream words(table.notes.value("axes", ""));
  for (std::string axis; words >> axis;) {
    table.axes.push_back(axis);
  }
  table.notes.erase("axes");
  table.by_ping = !shape.empty() && (name == "intensity" || (!table.axes.empty() && table.axes.front() == "ping"));
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
  const H5Quiet quiet;
  nlohmann::json found = nlohmann::json::object();
  if (h5_check(H5Lexists(file_.get(), "settings", H5P_DEFAULT), path_, "find settings") == 0) {
    return found;
  }
  const H5Handle group = h5_own(H5Gopen2(file_.get(), "settings", H5P_DEFAULT), H5Gclose, path_, "read settings");
  std::vector<std::string> names;
  h5_check(H5Lvisit(group.get(), H5_INDEX_NAME, H5_ITER_INC, add_name, &names), path_, "list settings");
  for (const std::string& name : names) {
    check_object(file_.get(), "settings/" + name, path_);
    const H5Handle object =
        h5_own(H5Oopen(group.get(), name.c_str(), H5P_DEFAULT), H5Oclose, path_, "open " + printable(name));
    if (H5Iget_type(object.get()) == H5I_DATASET) {
      found[nlohmann::json::json_pointer("/" + name)] =
          dataset_json(file_.get(), object.get(), path_, "settings/" + name);
    }
  }
  return found;
}

std::vector<std::byte> Hdf5Tables::row(const RecordedTable& table, std::uint64_t ping) const {
  const H5Quiet quiet;
  const std::string doing = "read " + table.name;
  const H5Handle dataset = h5_own(H5Dopen2(file_.get(), table.name.c_str(), H5P_DEFAULT), H5Dclose, path_, doing);
  const H5Handle stored = h5_own(H5Dget_type(dataset.get()), H5Tclose, path_, doing);
  const H5Handle native = native_type(stored, path_, table.name);
  const H5Handle from = h5_own(H5Dget_space(dataset.get()), H5Sclose, path_, doing);
  std::vector<hsize_t> length = shape_of(from.get());
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
  const H5Quiet quiet;
  const std::string doing = "read " + table.name;
  std::vector<hsize_t> start, count, step;
  for (const TableSlice& slice : slices) {
    start.push_back(slice.start);
    count.push_back(slice.count);
    step.push_back(slice.step);
  }
  const H5Handle dataset = h5_own(H5Dopen2(file_.get(), table.name.c_str(), H5P_DEFAULT), H5Dclose, path_, doing);
  const H5Handle from = h5_own(H5Dget_space(dataset.get()), H5Sclose, path_, doing);
  h5_check(H5Sselect_hyperslab(from.get(), H5S_SELECT_SET, start.data(), step.data(), count.data(), nullptr), path_,
           doing);
  const H5Handle to =
      h5_own(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose, path_, doing);
  h5_check(H5Dread(dataset.get(), memory_type(type), to.get(), from.get(), H5P_DEFAULT, bytes.data()), path_, doing);
}

}  // namespace insonify

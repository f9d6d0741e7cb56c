// stored_tables.cpp -- lists the tables of an HDF5 file and reads blocks of them.

#include "insonify/stored_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "io/file/hdf5.h"
#include "io/file/hdf5_heap.h"
#include "io/file/input_file.h"

namespace insonify {

struct StoredTables::State {
  std::filesystem::path path;
  H5Handle file;
  std::vector<StoredTable> tables;
};

namespace {

hid_t native_type(NumberType type) {
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

// None for what holds no numbers.
std::optional<NumberType> number_type(hid_t dataset, const std::filesystem::path& path) {
  const H5Handle type = h5_own(H5Dget_type(dataset), H5Tclose, path, "read a type");
  const std::size_t size = H5Tget_size(type.get());
  switch (H5Tget_class(type.get())) {
    case H5T_FLOAT:
      return size <= sizeof(float) ? NumberType::kFloat32 : NumberType::kFloat64;
    case H5T_INTEGER:
      if (H5Tget_sign(type.get()) == H5T_SGN_NONE && size <= sizeof(std::uint16_t)) {
        return size == 1 ? NumberType::kUint8 : NumberType::kUint16;
      }
      return NumberType::kInt64;
    default:
      return {};
  }
}

// A text attribute of variable length; "" where there is none.
std::string text_attribute(hid_t dataset, const char* name, const std::filesystem::path& path) {
  if (H5Aexists(dataset, name) <= 0) {
    return "";
  }
  const H5Handle attribute = h5_own(H5Aopen(dataset, name, H5P_DEFAULT), H5Aclose, path, "open an attribute");
  const H5Handle type = h5_own(H5Aget_type(attribute.get()), H5Tclose, path, "read an attribute");
  const H5Handle space = h5_own(H5Aget_space(attribute.get()), H5Sclose, path, "read an attribute");
  if (H5Tis_variable_str(type.get()) <= 0 || H5Sget_simple_extent_npoints(space.get()) != 1) {
    return "";
  }
  char* pointer = nullptr;
  h5_check(H5Aread(attribute.get(), type.get(), static_cast<void*>(&pointer)), path, "read an attribute");
  std::string text = pointer != nullptr ? pointer : "";
  H5free_memory(pointer);
  return text;
}

std::vector<std::uint64_t> shape_of(hid_t dataset, const std::filesystem::path& path) {
  const H5Handle space = h5_own(H5Dget_space(dataset), H5Sclose, path, "size a table");
  const int axes = std::max(0, H5Sget_simple_extent_ndims(space.get()));
  std::vector<hsize_t> shape(axes);
  h5_check(H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr), path, "size a table");
  return {shape.begin(), shape.end()};
}

std::vector<std::string> dataset_names(hid_t file, const std::filesystem::path& path) {
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  h5_check(H5Literate(file, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names), path, "list its datasets");
  std::erase_if(names, [&](const std::string& name) {
    const H5Handle object(H5Oopen(file, name.c_str(), H5P_DEFAULT), H5Oclose);
    return !object || H5Iget_type(object.get()) != H5I_DATASET;
  });
  return names;
}

// A recording that grows may have one ping more in one table than in another.
void cut_to_common_pings(std::vector<StoredTable>& tables) {
  std::uint64_t pings = std::numeric_limits<std::uint64_t>::max();
  for (const StoredTable& table : tables) {
    pings = table.by_ping ? std::min(pings, table.shape.front()) : pings;
  }
  for (StoredTable& table : tables) {
    if (table.by_ping) {
      table.shape.front() = pings;
    }
  }
}

}  // namespace

std::size_t size_of(NumberType type) {
  switch (type) {
    case NumberType::kFloat32:
      return sizeof(float);
    case NumberType::kFloat64:
      return sizeof(double);
    case NumberType::kUint8:
      return sizeof(std::uint8_t);
    case NumberType::kUint16:
      return sizeof(std::uint16_t);
    case NumberType::kInt64:
      return sizeof(std::int64_t);
  }
  return 0;
}

StoredTables::StoredTables(const std::filesystem::path& path) : state_(std::make_unique<State>()) {
  const H5Quiet quiet;
  check_input_file(path);
  state_->path = path;
  state_->file = h5_open_to_read(path);
  for (const std::string& name : dataset_names(state_->file.get(), path)) {
    const H5Handle dataset =
        h5_own(H5Dopen2(state_->file.get(), name.c_str(), H5P_DEFAULT), H5Dclose, path, "open " + name);
    static_cast<void>(checked_attributes(dataset.get(), path, name));
    const std::optional<NumberType> type = number_type(dataset.get(), path);
    std::vector<std::uint64_t> shape = shape_of(dataset.get(), path);
    if (type && !shape.empty()) {
      const bool by_ping = text_attribute(dataset.get(), "axes", path).starts_with("ping") || name == "intensity";
      state_->tables.push_back({name, *type, std::move(shape), by_ping, text_attribute(dataset.get(), "units", path),
                                text_attribute(dataset.get(), "description", path)});
    }
  }
  cut_to_common_pings(state_->tables);
}

StoredTables::~StoredTables() = default;
StoredTables::StoredTables(StoredTables&&) noexcept = default;
StoredTables& StoredTables::operator=(StoredTables&&) noexcept = default;

const std::vector<StoredTable>& StoredTables::tables() const {
  return state_->tables;
}

const StoredTable* StoredTables::find(const std::string& name) const {
  const auto found = std::ranges::find(state_->tables, name, &StoredTable::name);
  return found == state_->tables.end() ? nullptr : &*found;
}

void StoredTables::read(const StoredTable& table, std::span<const TableSlice> slices,
                        std::span<std::byte> bytes) const {
  const H5Quiet quiet;
  const std::string doing = "read " + table.name;
  bool inside = slices.size() == table.shape.size();
  std::vector<hsize_t> start, count, step;
  std::size_t numbers = 1;
  for (std::size_t axis = 0; inside && axis < slices.size(); ++axis) {
    const TableSlice& slice = slices[axis];
    const std::uint64_t length = table.shape[axis];
    inside = slice.step >= 1 && slice.count <= length &&
             (slice.count == 0 || (slice.start < length && slice.count - 1 <= (length - 1 - slice.start) / slice.step));
    start.push_back(slice.start);
    count.push_back(slice.count);
    step.push_back(slice.step);
    numbers *= slice.count;
  }
  if (!inside || bytes.size() != numbers * size_of(table.type)) {
    throw Error(fmt::format("{}: {} does not have that block", state_->path.string(), table.name));
  }
  if (numbers == 0) {
    return;
  }
  const H5Handle dataset =
      h5_own(H5Dopen2(state_->file.get(), table.name.c_str(), H5P_DEFAULT), H5Dclose, state_->path, doing);
  const H5Handle from = h5_own(H5Dget_space(dataset.get()), H5Sclose, state_->path, doing);
  h5_check(H5Sselect_hyperslab(from.get(), H5S_SELECT_SET, start.data(), step.data(), count.data(), nullptr),
           state_->path, doing);
  const H5Handle to =
      h5_own(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose, state_->path, doing);
  h5_check(H5Dread(dataset.get(), native_type(table.type), to.get(), from.get(), H5P_DEFAULT, bytes.data()),
           state_->path, doing);
}

std::vector<std::string> StoredTables::texts(const std::string& name) const {
  const H5Quiet quiet;
  const std::string doing = "read " + name;
  const std::filesystem::path& path = state_->path;
  if (H5Lexists(state_->file.get(), name.c_str(), H5P_DEFAULT) <= 0) {
    return {};
  }
  const H5Handle dataset = h5_own(H5Dopen2(state_->file.get(), name.c_str(), H5P_DEFAULT), H5Dclose, path, doing);
  const H5Handle type = h5_own(H5Dget_type(dataset.get()), H5Tclose, path, doing);
  const H5Handle space = h5_own(H5Dget_space(dataset.get()), H5Sclose, path, doing);
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  if (H5Tis_variable_str(type.get()) <= 0 || count < 0) {
    throw Error(fmt::format("{}: {} must hold texts", path.string(), name));
  }
  check_heap_texts(state_->file.get(), dataset.get(), path, name);
  std::vector<char*> pointers(count);
  h5_check(H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, static_cast<void*>(pointers.data())), path,
           doing);
  std::vector<std::string> texts;
  for (const char* text : pointers) {
    texts.emplace_back(text != nullptr ? text : "");
  }
  if (count > 0) {
    H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, static_cast<void*>(pointers.data()));
  }
  return texts;
}

}  // namespace insonify

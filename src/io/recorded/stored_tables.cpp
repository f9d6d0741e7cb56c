// stored_tables.cpp -- lists the tables of a recording and reads blocks of them.

#include "insonify/stored_tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "insonify/error.h"
#include "io/recorded/open_recording.h"

namespace insonify {

struct StoredTables::State {
  std::unique_ptr<RecordedTables> recorded;
  std::vector<StoredTable> tables;
  std::vector<const RecordedTable*> sources;  // Source of each.
};

namespace {

NumberType number_type(const RecordedTable& table) {
  const char kind = table.type[1];
  if (kind == 'c' || kind == 'f') {
    return kind == 'c' || table.value_bytes <= sizeof(float) ? NumberType::kFloat32 : NumberType::kFloat64;
  }
  if (kind == 'u' && table.value_bytes <= sizeof(std::uint16_t)) {
    return table.value_bytes == 1 ? NumberType::kUint8 : NumberType::kUint16;
  }
  return NumberType::kInt64;
}

// A recording that grows has the pings that all tables have.
StoredTable stored_table(const RecordedTable& table, std::uint64_t pings) {
  const auto note = [&](const char* name) {
    const auto found = table.notes.find(name);
    return found != table.notes.end() && found->is_string() ? found->get<std::string>() : "";
  };
  StoredTable stored{table.name, number_type(table), table.row, table.by_ping, note("units"), note("description")};
  if (table.by_ping) {
    stored.shape.insert(stored.shape.begin(), pings);
  }
  if (table.type[1] == 'c') {
    stored.shape.push_back(2);  // Real and imaginary part.
  }
  return stored;
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

StoredTables::StoredTables(const std::filesystem::path& path, const std::string& sonar)
    : state_(std::make_unique<State>(State{open_tables(path, sonar), {}, {}})) {
  for (const RecordedTable& table : state_->recorded->tables()) {
    StoredTable stored = stored_table(table, state_->recorded->ping_count());
    if (!stored.shape.empty()) {
      state_->tables.push_back(std::move(stored));
      state_->sources.push_back(&table);
    }
  }
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
  const auto there = std::ranges::find(state_->tables, table.name, &StoredTable::name);
  bool inside = there != state_->tables.end() && slices.size() == there->shape.size();
  std::size_t numbers = 1;
  for (std::size_t axis = 0; inside && axis < slices.size(); ++axis) {
    const TableSlice& slice = slices[axis];
    const std::uint64_t length = there->shape[axis];
    inside = slice.step >= 1 && slice.count <= length &&
             (slice.count == 0 || (slice.start < length && slice.count - 1 <= (length - 1 - slice.start) / slice.step));
    numbers *= slice.count;
  }
  if (!inside || bytes.size() != numbers * size_of(there->type)) {
    throw Error(fmt::format("{}: {} does not have that block", state_->recorded->path().string(), table.name));
  }
  if (numbers > 0) {
    state_->recorded->read(*state_->sources[static_cast<std::size_t>(there - state_->tables.begin())], there->type,
                           slices, bytes);
  }
}

std::vector<std::string> StoredTables::texts(const std::string& name) const {
  const auto found = std::ranges::find(state_->recorded->names(), name, &RecordedNames::name);
  if (find(name) != nullptr) {
    throw Error(fmt::format("{}: {} must hold texts", state_->recorded->path().string(), name));
  }
  return found == state_->recorded->names().end() ? std::vector<std::string>() : found->texts;
}

}  // namespace insonify

// export_zarr.cpp -- a Zarr group (version 2) of a recording's tables, one chunk per ping.

#include <fmt/format.h>
#include <zlib.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <map>
#include <random>
#include <system_error>

#include "insonify/error.h"
#include "io/export/export_format.h"

namespace insonify {
namespace {

constexpr int kZlibLevel = 1;  // Compression level of zlib, 1..9.

// A new folder beside the final one, removed unless it is renamed.
class UnfinishedFolder {
 public:
  explicit UnfinishedFolder(std::filesystem::path path) : path_(std::move(path)) {
    std::random_device random;
    unfinished_ = fmt::format("{}.{:08x}.new", path_.string(), random());
    std::error_code error;
    if (!std::filesystem::create_directory(unfinished_, error)) {
      fail(error ? error.message() : "a folder of this name is there");
    }
  }
  ~UnfinishedFolder() {
    if (!unfinished_.empty()) {
      std::error_code ignored;
      std::filesystem::remove_all(unfinished_, ignored);
    }
  }
  UnfinishedFolder(const UnfinishedFolder&) = delete;
  UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& place() const { return unfinished_; }

  // An existing folder is renamed first, so that a complete one is missing only for a moment.
  void put_in_place() {
    const std::filesystem::path aside = unfinished_.string() + ".earlier";
    std::error_code error;
    const bool replaces = std::filesystem::exists(path_, error);
    if (replaces) {
      std::filesystem::rename(path_, aside, error);
    }
    if (!error) {
      std::filesystem::rename(unfinished_, path_, error);
    }
    if (error) {
      fail(error.message());
    }
    unfinished_.clear();
    std::filesystem::remove_all(aside, error);
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw Error(fmt::format("{}: cannot write: {}", path_.string(), reason));
  }

  void write(const std::filesystem::path& name, std::span<const std::byte> bytes) const {
    errno = 0;
    std::ofstream out(unfinished_ / name, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) {
      fail(std::generic_category().message(errno != 0 ? errno : EIO));
    }
  }
  void write_json(const std::filesystem::path& name, const nlohmann::json& json) const {
    constexpr bool kAscii = true;  // Which zarr asks for.
    const std::string text = json.dump(1, ' ', kAscii, nlohmann::json::error_handler_t::replace) + "\n";
    write(name, std::as_bytes(std::span(text)));
  }
  void make(const std::filesystem::path& name) const {
    std::error_code error;
    std::filesystem::create_directories(unfinished_ / name, error);
    if (error) {
      fail(error.message());
    }
  }

 private:
  std::filesystem::path path_, unfinished_;
};

std::vector<std::byte> compressed(std::span<const std::byte> bytes) {
  uLongf size = compressBound(bytes.size());
  std::vector<std::byte> packed(size);
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                bytes.size(), kZlibLevel) != Z_OK) {
    throw std::bad_alloc();
  }
  packed.resize(size);
  return packed;
}

// An array's own folder with its description, and the names of its axes, which xarray reads.
void begin_array(const UnfinishedFolder& out, const std::filesystem::path& folder, const std::string& type,
                 const std::vector<std::uint64_t>& shape, const std::vector<std::uint64_t>& chunk,
                 const std::vector<std::string>& axes, nlohmann::json notes) {
  out.make(folder);
  out.write_json(folder / ".zarray", nlohmann::json{{"zarr_format", 2},
                                                    {"shape", shape},
                                                    {"chunks", chunk},
                                                    {"dtype", type},
                                                    {"order", "C"},
                                                    {"fill_value", nullptr},
                                                    {"filters", nullptr},
                                                    {"compressor", {{"id", "zlib"}, {"level", kZlibLevel}}}});
  notes["_ARRAY_DIMENSIONS"] = axes;
  out.write_json(folder / ".zattrs", notes);
}

// The chunk at the start of all axes but the first.
std::string chunk_name(std::uint64_t first, std::size_t axes) {
  std::string name = std::to_string(first);
  for (std::size_t i = 1; i < axes; ++i) {
    name += ".0";
  }
  return name;
}

// Axes of tables whose axes recordings do not name.
std::vector<std::string> axes_of(const RecordedTable& table) {
  static const std::map<std::string, std::string> kKnown = {
      {"azimuth", "beam"}, {"azimuth_edges", "beam_edge"}, {"range", "bin"}};
  if (!table.axes.empty() && table.axes.size() == table.row.size() + (table.by_ping ? 1 : 0)) {
    return table.axes;
  }
  if (const auto known = kKnown.find(table.name); known != kKnown.end() && table.row.size() == 1) {
    return {known->second};
  }
  std::vector<std::string> axes;
  for (std::size_t i = 0; i < table.row.size(); ++i) {
    axes.push_back(fmt::format("{}_{}", table.name, i));
  }
  if (table.by_ping) {
    axes.insert(axes.begin(), "ping");
  }
  return axes;
}

void write_table(const UnfinishedFolder& out, const std::filesystem::path& folder, const RecordedTables& recording,
                 const RecordedTable& table, const ExportOptions& options) {
  std::vector<std::uint64_t> shape = table.row;
  std::vector<std::uint64_t> chunk = table.row;
  const std::uint64_t rows = table.by_ping ? recording.ping_count() : 1;
  // A chunk of a few bytes a ping would be a file of a few bytes.
  const bool small = table.by_ping && table.row_bytes() < 4096;
  if (table.by_ping) {
    shape.insert(shape.begin(), rows);
    chunk.insert(chunk.begin(), small ? rows : 1);
  }
  begin_array(out, folder, table.type, shape, chunk, axes_of(table), table.notes);
  std::vector<std::byte> together;
  for (std::uint64_t row = 0; row < rows; ++row) {
    check_stop(options);
    const std::vector<std::byte> bytes = recording.row(table, row);
    if (small) {
      together.insert(together.end(), bytes.begin(), bytes.end());
    } else {
      out.write(folder / chunk_name(row, shape.size()), compressed(bytes));
    }
  }
  if (small) {
    out.write(folder / chunk_name(0, shape.size()), compressed(together));
  }
}

}  // namespace

void export_zarr(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options) {
  UnfinishedFolder out(file);
  const nlohmann::json group = {{"zarr_format", 2}};
  out.write_json(".zgroup", group);
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const RecordedTables& recording = *recordings[i];
    const std::filesystem::path folder = prefix_of(recordings, i);
    out.make(folder);
    out.write_json(folder / ".zgroup", group);
    out.write_json(folder / ".zattrs", facts_of(recording));
    for (const RecordedTable& table : recording.tables()) {
      write_table(out, folder / table.name, recording, table, options);
    }
    for (const RecordedNames& names : recording.names()) {
      const UnicodeTable texts = unicode_table(names.texts);
      const std::vector<std::uint64_t> shape = {names.texts.size()};
      const std::string axis = names.name.substr(0, names.name.find('_'));
      begin_array(out, folder / names.name, texts.type, shape, {std::max<std::uint64_t>(1, shape[0])}, {axis},
                  nlohmann::json::object());
      if (!names.texts.empty()) {
        out.write(folder / names.name / "0", compressed(texts.bytes));
      }
    }
  }
  out.put_in_place();
}

}  // namespace insonify

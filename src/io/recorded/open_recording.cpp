// open_recording.cpp -- opens a recording in whichever format it is.

#include "io/recorded/open_recording.h"

#include <fmt/format.h>

#include <fstream>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "insonify/recorded_pings.h"
#include "insonify/recording_info.h"
#include "io/file/input_file.h"
#include "io/file/reader_process.h"
#include "io/foreign/foreign_formats.h"
#include "io/mcap/mcap_bytes.h"
#include "io/mcap/mcap_tables.h"
#include "io/recording/hdf5_tables.h"

namespace insonify {
namespace {

// The tables of a stranger's file in a process of its own, which lives as long as this.
class ApartTables : public RecordedTables {
 public:
  ApartTables(const std::filesystem::path& path, const std::string& format, std::string sonar);

  [[nodiscard]] nlohmann::json settings() const override;
  [[nodiscard]] std::vector<std::byte> row(const RecordedTable& table, std::uint64_t ping) const override;
  void read(const RecordedTable& table, NumberType type, std::span<const TableSlice> slices,
            std::span<std::byte> bytes) const override;

 private:
  void put_file(SharedBytes& to) const {
    put(to, path_.string());
    put(to, sonar_);
  }
  void ask(ReaderTask task, const std::function<void(const nlohmann::json&)>& take) const;

  StrangersFile file_;
  std::string sonar_;
  mutable ReaderProcess reader_;
};

ApartTables::ApartTables(const std::filesystem::path& path, const std::string& format, std::string sonar)
    : RecordedTables(path), file_{path, format}, sonar_(std::move(sonar)) {
  ask(ReaderTask::kRecording, [&](const nlohmann::json& summary) {
    summary.at("tables").get_to(tables_);
    summary.at("names").get_to(names_);
    summary.at("ping_count").get_to(ping_count_);
    summary.at("attributes").get_to(attributes_);
    if (summary.at("state").is_number_unsigned()) {
      state_ = summary.at("state").get<std::uint64_t>();
    }
    for (const RecordedTable& table : tables_) {  // "<f4" with 4 bytes a value ...
      require_whole(table.type.size() == 3 && table.value_bytes >= 1 && table.value_bytes <= sizeof(double) &&
                    table.value_bytes == static_cast<std::size_t>(table.type[2] - '0'));
    }
  });
}

void ApartTables::ask(ReaderTask task, const std::function<void(const nlohmann::json&)>& take) const {
  constexpr int kDeepest = 16;  // What is deeper is left out: to copy it would overflow the stack.
  reader_.ask(
      file_, task, [&](SharedBytes& to) { put_file(to); },
      [&](SharedBytes& from) {
        std::string text;
        get(from, text);
        try {
          take(nlohmann::json::parse(text, [](int depth, auto, const auto&) { return depth <= kDeepest; }));
        } catch (const nlohmann::json::exception&) {
          throw BrokenAnswer();
        }
      });
}

nlohmann::json ApartTables::settings() const {
  nlohmann::json settings;
  ask(ReaderTask::kSettings, [&](const nlohmann::json& answer) { settings = answer; });
  return settings;
}

std::vector<std::byte> ApartTables::row(const RecordedTable& table, std::uint64_t ping) const {
  std::vector<std::byte> bytes;
  reader_.ask(
      file_, ReaderTask::kRow,
      [&](SharedBytes& to) {
        put_file(to);
        put(to, table.name);
        put(to, ping);
      },
      [&](SharedBytes& from) {
        get(from, bytes);
        require_whole(bytes.size() == table.row_bytes());
      });
  return bytes;
}

void ApartTables::read(const RecordedTable& table, NumberType type, std::span<const TableSlice> slices,
                       std::span<std::byte> bytes) const {
  reader_.ask(
      file_, ReaderTask::kBlock,
      [&](SharedBytes& to) {
        put_file(to);
        put(to, table.name);
        put(to, type);
        put(to, slices);
        put(to, std::uint64_t{bytes.size()});
      },
      [&](SharedBytes& from) {
        std::uint64_t count = 0;
        get(from, count);
        require_whole(count == bytes.size());
        from.get_bytes(bytes.data(), count);
      });
}

// A grey picture as one ping: rows are bins, the first the nearest.
std::unique_ptr<RecordedTables> picture_tables(const std::filesystem::path& path, const std::string& sonar) {
  check_foreign_sonar(path, sonar, "picture");
  const GreyPicture picture = load_grey_picture(path);
  auto tables = std::make_unique<ForeignTables>(path, "picture", 1);
  SonarConfig config = foreign_sonar("picture", "");
  config.beam_count = picture.columns;
  config.bin_count = picture.rows;
  config.max_range = kAssumedBin * picture.rows;
  const std::vector<float> levels(picture.values.begin(), picture.values.end());
  const auto bytes = std::as_bytes(std::span(levels));
  tables->add("intensity", "<f4",
              {static_cast<std::uint64_t>(picture.rows), static_cast<std::uint64_t>(picture.columns)}, true, "1",
              [stored = std::vector<std::byte>(bytes.begin(), bytes.end())](std::uint64_t) { return stored; });
  tables->describe(config);
  tables->assume(
      fmt::format("its rows are taken as bins of {} m, the first as the nearest, its columns as a fan of "
                  "{:.0f} deg",
                  kAssumedBin, degrees_from_radians(kAssumedAperture)));
  return tables;
}

// An HDF5 recording holds one sonar.
void check_sonar(const std::filesystem::path& path, const std::string& wanted, const std::string& found) {
  if (!wanted.empty() && wanted != found) {
    throw Error(fmt::format("{}: has no sonar {}; {}", path.string(), printable(wanted),
                            found.empty() ? "it does not name its sonar" : "its sonar is " + printable(found)));
  }
}

}  // namespace

bool is_mcap(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_fifo(path, ignored)) {
    return false;  // Opening it would wait for a writer.
  }
  std::ifstream file(path, std::ios::binary);
  std::string start(kMcapMagic.size(), '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  return start == kMcapMagic;
}

bool is_foreign_recording(const std::filesystem::path& path) {
  return foreign_format(path) != nullptr;
}

std::unique_ptr<RecordedTables> open_strangers(const std::filesystem::path& path, const std::string& sonar) {
  check_input_file(path);
  if (is_picture(path)) {
    return picture_tables(path, sonar);
  }
  const ForeignFormat* const format = foreign_format(path);
  if (!reads_here()) {
    auto tables = std::make_unique<ApartTables>(path, std::string(format != nullptr ? format->title : "HDF5"), sonar);
    if (format == nullptr) {
      check_sonar(path, sonar, tables->text("sonar"));
    }
    return tables;
  }
  if (format != nullptr) {
    return format->open(path, sonar);
  }
  auto tables = std::make_unique<Hdf5Tables>(path);
  check_sonar(path, sonar, tables->text("sonar"));
  return tables;
}

std::unique_ptr<RecordedTables> open_tables(const std::filesystem::path& path, const std::string& sonar) {
  check_input_file(path);
  if (is_mcap(path)) {
    return std::make_unique<McapTables>(path, sonar);
  }
  return open_strangers(path, sonar);
}

std::vector<std::unique_ptr<RecordedTables>> open_all_tables(const std::filesystem::path& path,
                                                             const std::string& sonar) {
  check_input_file(path);
  std::vector<std::unique_ptr<RecordedTables>> all;
  if (!sonar.empty() || !is_mcap(path)) {
    all.push_back(open_tables(path, sonar));
    return all;
  }
  for (const std::string& name : mcap_sonars(McapReader(path), path)) {
    all.push_back(std::make_unique<McapTables>(path, name));
  }
  return all;
}

}  // namespace insonify

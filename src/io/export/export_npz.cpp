// export_npz.cpp -- each table of a recording as an array of a NumPy archive.

#include <fmt/format.h>

#include "io/export/export_format.h"
#include "io/export/zip_writer.h"

namespace insonify {
namespace {

// The header of an .npy array, version 1.0: magic, length, and a Python dictionary of type and shape, filled up to a
// multiple of 64 bytes.
// @param type  NumPy's name: "<f4".
std::string numpy_header(const std::string& type, const std::vector<std::uint64_t>& shape) {
  std::string lengths;
  for (const std::uint64_t length : shape) {
    lengths += fmt::format("{}, ", length);
  }
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, lengths);
  constexpr std::size_t kStart = 10;
  constexpr std::size_t kAlignment = 64;
  text.resize((kStart + text.size() + kAlignment) / kAlignment * kAlignment - kStart, ' ');
  text.back() = '\n';
  std::string header = "\x93NUMPY";
  header += '\1';
  header += '\0';
  header += static_cast<char>(text.size() % 256);
  header += static_cast<char>(text.size() / 256);
  return header + text;
}

void add_array(ZipWriter& zip, const std::string& name, const std::string& type,
               const std::vector<std::uint64_t>& shape) {
  zip.begin(name + ".npy");
  const std::string header = numpy_header(type, shape);
  zip.add(std::as_bytes(std::span(header)));
}

void add_texts(ZipWriter& zip, const std::string& name, const std::vector<std::string>& texts, bool single) {
  const UnicodeTable table = unicode_table(texts);
  add_array(zip, name, table.type, single ? std::vector<std::uint64_t>() : std::vector<std::uint64_t>{texts.size()});
  zip.add(table.bytes);
  zip.end();
}

}  // namespace

void export_npz(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options) {
  UnfinishedFile out(file, "cannot write");
  ZipWriter zip(out, options.compress);
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const RecordedTables& recording = *recordings[i];
    const std::string prefix = prefix_of(recordings, i);
    for (const RecordedTable& table : recording.tables()) {
      std::vector<std::uint64_t> shape = table.row;
      const std::uint64_t rows = table.by_ping ? recording.ping_count() : 1;
      if (table.by_ping) {
        shape.insert(shape.begin(), rows);
      }
      add_array(zip, prefix + table.name, table.type, shape);
      for (std::uint64_t row = 0; row < rows; ++row) {
        check_stop(options);
        zip.add(recording.row(table, row));
      }
      zip.end();
    }
    for (const RecordedNames& names : recording.names()) {
      add_texts(zip, prefix + names.name, names.texts, false);
    }
    add_texts(zip, prefix + "attributes",
              {facts_of(recording).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)}, true);
  }
  zip.finish();
  out.put_in_place();
}

}  // namespace insonify

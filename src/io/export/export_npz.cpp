// export_npz.cpp -- each table of a recording as an array of a NumPy archive.

#include <string>
#include <vector>

#include "io/export/export_format.h"
#include "io/export/npz_writer.h"
#include "io/file/unfinished_file.h"

namespace insonify {

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

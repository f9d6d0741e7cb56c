// export_format.h -- the formats that recordings are exported to.

#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "insonify/export.h"
#include "insonify/interrupted.h"
#include "insonify/messages.h"
#include "insonify/ping_sink.h"
#include "insonify/recorded_pings.h"
#include "io/file/recorded_tables.h"

namespace insonify {

/// The sonars of an export, from any number of files.
using RecordedSonars = std::span<const std::unique_ptr<RecordedTables>>;

/// Each writes to `place`, a file or a folder that is renamed to `file` afterwards; messages name `file`.
void export_mcap(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options);
void export_bag(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options);
void export_npz(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options);
void export_zarr(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options);
void export_xtf(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options);
void export_jsf(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options);
void export_xyz(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options);
void export_gsf(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options);
void export_kmall(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options);
void export_video(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options);

/// @throws Interrupted when the caller has asked to stop.
inline void check_stop(const ExportOptions& options) {
  if (options.stop != nullptr && options.stop->load(std::memory_order_relaxed)) {
    throw Interrupted();
  }
}

/// The pings that the tables are of.
[[nodiscard]] RecordedPings pings_of(const RecordedTables& recording);

/// @throws Error with the path for a recording without model or settings.
[[nodiscard]] EchoModel model_of(const RecordedTables& recording);
[[nodiscard]] MessageSource message_source(const RecordedTables& recording);
[[nodiscard]] std::vector<MessageSource> message_sources(RecordedSonars recordings);

/// The options, with the recordings' start unless they have their own.
[[nodiscard]] MessageOptions with_start(MessageOptions options, RecordedSonars recordings);

/// Gives all pings to a sink, in the order of their times, and closes it.
void write_pings(RecordedSonars recordings, PingSink& sink, const ExportOptions& options);

/// Prefix of names in the export of several recordings: "fls/"; "" for a single one.
[[nodiscard]] std::string prefix_of(RecordedSonars recordings, std::size_t index);

/// Attributes and settings of a recording, as a JSON object.
[[nodiscard]] nlohmann::json facts_of(const RecordedTables& recording);

/// A list of texts in NumPy's layout: 32-bit characters, each text padded to the longest.
struct UnicodeTable {
  std::string type;  ///< "<U12"
  std::vector<std::byte> bytes;
};
[[nodiscard]] UnicodeTable unicode_table(const std::vector<std::string>& texts);

}  // namespace insonify

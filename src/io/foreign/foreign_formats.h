// foreign_formats.h -- which files of instruments and other programs are read as recordings, and by what.

#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "io/foreign/foreign_tables.h"

namespace insonify {

struct ForeignFormat {
  std::string_view title;    ///< "Oculus", as in "the reader of Oculus files crashed".
  std::string_view endings;  ///< ".raw .oculus"

  /// Whether a file begins so. `head` has its first kForeignHead bytes, or all.
  bool (*starts)(std::string_view head);

  /// @param sonar  "" for the only one, or for the first.
  /// @throws Error with the path, and where a byte is wrong with its place.
  std::unique_ptr<ForeignTables> (*open)(const std::filesystem::path& path, const std::string& sonar);
};

/// The format of a file by its first bytes; where no format begins so, by its ending; null for none of these, and for
/// HDF5, whatever its ending.
[[nodiscard]] const ForeignFormat* foreign_format(const std::filesystem::path& path);

// The readers, each in a file of its own.

/// Simple ping results of a Blueprint Oculus, as they come over TCP, with anything between them: fans of counts.
[[nodiscard]] std::unique_ptr<ForeignTables> open_oculus(const std::filesystem::path& path, const std::string& sonar);
/// Logs of Ping Viewer, and frames of the ping protocol: counts of a Ping360's single beam.
[[nodiscard]] std::unique_ptr<ForeignTables> open_ping360(const std::filesystem::path& path, const std::string& sonar);
/// Side-scan pings of an XTF file: counts of one channel, `port` or `starboard`.
[[nodiscard]] std::unique_ptr<ForeignTables> open_xtf(const std::filesystem::path& path, const std::string& sonar);
/// An array of NumPy: [bin], [bin, beam] or [ping, bin, beam].
[[nodiscard]] std::unique_ptr<ForeignTables> open_npy(const std::filesystem::path& path, const std::string& sonar);
/// Arrays of NumPy in a ZIP archive, also those that `insonify export` writes.
[[nodiscard]] std::unique_ptr<ForeignTables> open_npz(const std::filesystem::path& path, const std::string& sonar);

/// @throws Error "PATH: has no sonar X; its sonar is Y" unless `wanted` is "" or `found`.
void check_foreign_sonar(const std::filesystem::path& path, const std::string& wanted, const std::string& found);

}  // namespace insonify

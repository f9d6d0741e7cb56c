// foreign_fuzzer.cpp -- reads any bytes as a file of an instrument, an array or a picture; the first byte says which.
// In this process, where a crash ends the fuzzer.

#include <iterator>

#include "fuzz/fuzzer.h"
#include "io/foreign/foreign_formats.h"
#include "io/picture/grey_picture.h"
#include "io/picture/png_reader.h"

namespace insonify::foreign_fuzzer {
namespace {

void read_tables(const std::filesystem::path& path) {
  const ForeignFormat* const format = foreign_format(path);
  if (format == nullptr) {
    return;
  }
  const auto tables = format->open(path, "");
  for (const RecordedTable& table : tables->tables()) {
    fuzz::expect(tables->row(table, 0).size() == table.row_bytes());
    fuzz::expect(tables->row(table, table.by_ping ? tables->ping_count() - 1 : 0).size() == table.row_bytes());
  }
}

void take(fuzz::Bytes bytes) {
  static const fuzz::InputFile file;
  constexpr const char* kNames[] = {"a.raw", "a.bin", "a.xtf", "a.npy", "a.npz", "a.jpg", "a.pgm", "a.png"};
  constexpr std::size_t kFirstPicture = 5;
  if (bytes.empty()) {
    return;
  }
  const std::size_t format = bytes[0] % std::size(kNames);
  const std::string_view text = fuzz::text_of(bytes.subspan(1));
  fuzz::expect_error_or_nothing(
      [&] {
        if (format < kFirstPicture) {
          read_tables(file.write(kNames[format], text));
        } else if (format + 1 < std::size(kNames)) {
          fuzz::expect(fits(decode_grey(kNames[format], text)));
        } else {
          fuzz::expect(fits(decode_png(kNames[format], text)));
        }
      },
      format < kFirstPicture ? (file.folder() / kNames[format]).string() : kNames[format]);
}

const fuzz::Listed kListed("foreign", take);

}  // namespace
}  // namespace insonify::foreign_fuzzer

// grid_fuzzer.cpp -- reads any bytes as a grid of heights; the first byte chooses the format.

#include <iterator>

#include "fuzz/fuzzer.h"
#include "insonify/files.h"

namespace insonify::grid_fuzzer {
namespace {

void take(fuzz::Bytes bytes) {
  static const fuzz::InputFile file;
  constexpr const char* kNames[] = {"g.asc", "g.bag", "g.tif", "g.png"};
  if (bytes.empty()) {
    return;
  }
  const auto path = file.write(kNames[bytes[0] % std::size(kNames)], fuzz::text_of(bytes.subspan(1)));
  fuzz::expect_error_or_nothing(
      [&] {
        const HeightGrid grid = load_height_grid(path);
        fuzz::expect(grid.heights.size() ==
                     static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
      },
      path);
}

const fuzz::Listed kListed("grid", take);

}  // namespace
}  // namespace insonify::grid_fuzzer

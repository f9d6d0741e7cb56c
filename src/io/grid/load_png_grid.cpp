// load_png_grid.cpp -- grey pictures as heights from 0 to 1.

#include <fmt/format.h>

#include "insonify/error.h"
#include "io/grid/height_grid_file.h"
#include "io/picture/png_reader.h"

namespace insonify {

HeightGrid load_png_grid(const std::filesystem::path& path) {
  const PngReader png(path);
  if (png.width() < 2 || png.height() < 2) {
    throw Error(
        fmt::format("{}: {} x {} pixels; heights need at least 2 x 2", path.string(), png.width(), png.height()));
  }

  HeightGrid grid;
  grid.columns = static_cast<int>(png.width());
  grid.rows = static_cast<int>(png.height());
  grid.heights.reserve(png.width() * png.height());
  const float scale = 1 / static_cast<float>(png.full_scale());
  for (std::size_t row = 0; row < png.height(); ++row) {
    for (std::size_t column = 0; column < png.width(); ++column) {
      grid.heights.push_back(scale * static_cast<float>(png.grey(column, row, "heights need")));
    }
  }
  return grid;
}

}  // namespace insonify

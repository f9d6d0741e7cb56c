// load_grey_picture.cpp -- grey PNG files as levels from 0 to 1.

#include "insonify/recorded_pings.h"
#include "io/picture/png_reader.h"

namespace insonify {

GreyPicture load_grey_picture(const std::filesystem::path& path) {
  const PngReader png(path);
  GreyPicture picture{path.string(), static_cast<int>(png.width()), static_cast<int>(png.height()), {}};
  picture.values.reserve(png.width() * png.height());
  for (std::size_t row = 0; row < png.height(); ++row) {
    for (std::size_t column = 0; column < png.width(); ++column) {
      picture.values.push_back(static_cast<double>(png.grey(column, row, "a comparison needs")) / png.full_scale());
    }
  }
  return picture;
}

}  // namespace insonify

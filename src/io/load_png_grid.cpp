// load_png_grid.cpp -- grey pictures as heights from 0 to 1.

#include <fmt/format.h>
#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <memory>

#include "insonify/error.h"
#include "io/height_grid_file.h"
#include "io/input_file.h"

namespace insonify {
namespace {

// libpng reports errors by a long jump, over whatever C++ would have tidied up: all that lives across its calls is kept
// here, and outside of the function that it jumps in.
class PngReader {
 public:
  explicit PngReader(const std::filesystem::path& path)
      : path_(path), file_(std::fopen(path.c_str(), "rb"), &std::fclose) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore);
    info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  void read() {
    if (file_ == nullptr || info_ == nullptr || !read_header()) {
      throw_failure();
    }
    row_bytes_ = png_get_rowbytes(png_, info_);
    pixels_.resize(row_bytes_ * height());
    rows_.clear();
    for (std::size_t row = 0; row < height(); ++row) {
      rows_.push_back(pixels_.data() + row * row_bytes_);
    }
    if (!read_pixels()) {
      throw_failure();
    }
  }

  [[nodiscard]] std::size_t width() const { return png_get_image_width(png_, info_); }
  [[nodiscard]] std::size_t height() const { return png_get_image_height(png_, info_); }
  [[nodiscard]] int channels() const { return png_get_channels(png_, info_); }
  [[nodiscard]] bool has_alpha() const { return (png_get_color_type(png_, info_) & PNG_COLOR_MASK_ALPHA) != 0; }
  [[nodiscard]] int full_scale() const { return is_deep() ? 65535 : 255; }

  [[nodiscard]] int value(std::size_t column, std::size_t row, int channel) const {
    const std::size_t at = column * static_cast<std::size_t>(channels()) + static_cast<std::size_t>(channel);
    return is_deep() ? 256 * rows_[row][2 * at] + rows_[row][2 * at + 1] : rows_[row][at];
  }

 private:
  [[nodiscard]] bool is_deep() const { return png_get_bit_depth(png_, info_) == 16; }

  [[noreturn]] static void fail(png_structp png, png_const_charp message) {
    static_cast<PngReader*>(png_get_error_ptr(png))->failure_ = message;
    longjmp(png_jmpbuf(png), 1);
  }
  static void ignore(png_structp, png_const_charp) {}  // Warnings: bad colour profiles, odd text.

  [[noreturn]] void throw_failure() const {
    throw Error(fmt::format("{}: cannot be read: {}", path_.string(), one_line(failure_)));
  }

  // No objects with destructors in these two.
  bool read_header() {
    if (setjmp(png_jmpbuf(png_)) != 0) {
      return false;
    }
    png_init_io(png_, file_.get());
    png_read_info(png_, info_);
    png_set_expand(png_);  // Fewer than 8 bits, palettes and transparent colours.
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }
  bool read_pixels() {
    if (setjmp(png_jmpbuf(png_)) != 0) {
      return false;
    }
    png_read_image(png_, rows_.data());
    png_read_end(png_, nullptr);
    return true;
  }

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::string failure_ = "libpng cannot start";
  std::size_t row_bytes_ = 0;
  std::vector<png_byte> pixels_;
  std::vector<png_bytep> rows_;
};

// Many a grey picture is stored as a coloured one; a really coloured one is no height map.
void check_grey(const PngReader& png, std::size_t column, std::size_t row, const std::filesystem::path& path) {
  const int colors = png.channels() - (png.has_alpha() ? 1 : 0);
  for (int channel = 1; channel < colors; ++channel) {
    if (png.value(column, row, channel) != png.value(column, row, 0)) {
      throw Error(fmt::format("{}: the pixel in column {}, row {} is coloured; heights need a grey picture",
                              path.string(), column, row));
    }
  }
  if (png.has_alpha() && png.value(column, row, colors) != png.full_scale()) {
    throw Error(fmt::format("{}: the pixel in column {}, row {} is transparent; heights need an opaque picture",
                            path.string(), column, row));
  }
}

}  // namespace

HeightGrid load_png_grid(const std::filesystem::path& path) {
  PngReader png(path);
  png.read();
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
      check_grey(png, column, row, path);
      grid.heights.push_back(scale * static_cast<float>(png.value(column, row, 0)));
    }
  }
  return grid;
}

}  // namespace insonify

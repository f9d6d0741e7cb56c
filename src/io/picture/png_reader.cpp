// png_reader.cpp -- libpng, with its failures as Errors.
//
// libpng reports errors by a long jump, over whatever C++ would have tidied up: all that lives across its calls is kept
// in the reader, and outside of the function that it jumps in.

#include "io/picture/png_reader.h"

#include <fmt/format.h>

#include <csetjmp>

#include "insonify/error.h"
#include "io/file/input_file.h"

namespace insonify {

PngReader::PngReader(std::filesystem::path path) : path_(std::move(path)), file_(nullptr, &std::fclose) {
  check_input_file(path_);
  file_.reset(std::fopen(path_.c_str(), "rb"));
  open();
}

PngReader::PngReader(std::string name, std::span<const char> bytes)
    : path_(std::move(name)), file_(nullptr, &std::fclose) {
  file_.reset(fmemopen(const_cast<char*>(bytes.data()), bytes.size(), "rb"));  // Only read.
  open();
}

void PngReader::open() {
  png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore);
  info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
  try {
    read();
  } catch (...) {
    png_destroy_read_struct(&png_, &info_, nullptr);
    throw;
  }
}

PngReader::~PngReader() {
  png_destroy_read_struct(&png_, &info_, nullptr);
}

int PngReader::grey(std::size_t column, std::size_t row, std::string_view purpose) const {
  const int level = value(column, row, 0);
  const int colors = channels() - (has_alpha() ? 1 : 0);
  for (int channel = 1; channel < colors; ++channel) {
    if (value(column, row, channel) != level) {
      throw Error(fmt::format("{}: the pixel in column {}, row {} is coloured; {} a grey picture", path_.string(),
                              column, row, purpose));
    }
  }
  if (has_alpha() && value(column, row, colors) != full_scale()) {
    throw Error(fmt::format("{}: the pixel in column {}, row {} is transparent; {} an opaque picture", path_.string(),
                            column, row, purpose));
  }
  return level;
}

int PngReader::value(std::size_t column, std::size_t row, int channel) const {
  const std::size_t at = column * static_cast<std::size_t>(channels()) + static_cast<std::size_t>(channel);
  return is_deep() ? 256 * rows_[row][2 * at] + rows_[row][2 * at + 1] : rows_[row][at];
}

void PngReader::read() {
  if (file_ == nullptr || info_ == nullptr || !read_header()) {
    throw_failure();
  }
  row_bytes_ = png_get_rowbytes(png_, info_);
  pixels_.resize(row_bytes_ * height());
  for (std::size_t row = 0; row < height(); ++row) {
    rows_.push_back(pixels_.data() + row * row_bytes_);
  }
  if (!read_pixels()) {
    throw_failure();
  }
}

void PngReader::fail(png_structp png, png_const_charp message) {
  static_cast<PngReader*>(png_get_error_ptr(png))->failure_ = message;
  longjmp(png_jmpbuf(png), 1);
}

// Warnings: bad colour profiles, odd text.
void PngReader::ignore(png_structp, png_const_charp) {}

void PngReader::throw_failure() const {
  throw Error(fmt::format("{}: cannot be read: {}", path_.string(), foreign_reason(failure_)));
}

// No objects with destructors in these two.
bool PngReader::read_header() {
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

bool PngReader::read_pixels() {
  if (setjmp(png_jmpbuf(png_)) != 0) {
    return false;
  }
  png_read_image(png_, rows_.data());
  png_read_end(png_, nullptr);
  return true;
}

}  // namespace insonify

// png_reader.h -- the pixels of a PNG file, as they are stored. The only reader of PNG.

#pragma once

#include <png.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace insonify {

/// A whole PNG file in memory: 8 or 16 bits a channel, palettes and fewer bits widened to 8. What the file says of
/// gamma and colour profiles does not matter.
class PngReader {
 public:
  /// @throws Error with the path for a file that is not there or no whole PNG.
  explicit PngReader(std::filesystem::path path);
  /// One that lies in memory.
  /// @param name  In messages.
  PngReader(std::string name, std::span<const char> bytes);
  ~PngReader();
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  /// For messages.
  [[nodiscard]] std::string name() const { return path_.string(); }
  [[nodiscard]] std::size_t width() const { return png_get_image_width(png_, info_); }
  [[nodiscard]] std::size_t height() const { return png_get_image_height(png_, info_); }
  /// Whether the file keeps red, green and blue; they may be equal all the same.
  [[nodiscard]] bool has_colours() const { return channels() - (has_alpha() ? 1 : 0) == 3; }
  [[nodiscard]] int full_scale() const { return is_deep() ? 65535 : 255; }

  /// Grey level of a pixel, 0 to full_scale(). Many a grey picture is stored as a coloured one.
  /// @param purpose  Who asks, for the message: "heights need".
  /// @throws Error for a pixel that is really coloured, or transparent.
  [[nodiscard]] int grey(std::size_t column, std::size_t row, std::string_view purpose) const;

  /// One colour of a pixel, 0 to full_scale(): 0 red, 1 green, 2 blue; needs has_colours().
  [[nodiscard]] int colour(std::size_t column, std::size_t row, int channel) const {
    return value(column, row, channel);
  }

 private:
  [[nodiscard]] int channels() const { return png_get_channels(png_, info_); }
  [[nodiscard]] bool has_alpha() const { return (png_get_color_type(png_, info_) & PNG_COLOR_MASK_ALPHA) != 0; }
  [[nodiscard]] bool is_deep() const { return png_get_bit_depth(png_, info_) == 16; }
  [[nodiscard]] int value(std::size_t column, std::size_t row, int channel) const;

  [[noreturn]] static void fail(png_structp png, png_const_charp message);
  static void ignore(png_structp png, png_const_charp message);
  [[noreturn]] void throw_failure() const;
  void open();
  void read();
  bool read_header();
  bool read_pixels();

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::string failure_ = "libpng cannot start";
  std::size_t row_bytes_ = 0;
  std::vector<png_byte> pixels_;
  std::vector<png_bytep> rows_;
};

}  // namespace insonify

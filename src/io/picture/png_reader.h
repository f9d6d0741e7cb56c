// png_reader.h -- the pixels of a PNG file, as stored. The only PNG reader.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

namespace insonify {

/// The pixels of a PNG file: 8 or 16 bits per channel, palettes and fewer bits widened to 8. Gamma values and colour
/// profiles in the file are ignored.
struct DecodedPng {
  std::uint64_t width = 0, height = 0;
  int channels = 0;  ///< 1 (grey) or 3 (red, green, blue), plus 1 for alpha.
  bool has_alpha = false, is_deep = false;
  std::vector<std::uint16_t> pixels;  ///< Rows x columns x channels; holds bytes instead if not is_deep.
};
template <typename Png>
requires(std::is_same_v<std::remove_const_t<Png>, DecodedPng>) [[nodiscard]] auto members(Png& png) {
  return std::tie(png.width, png.height, png.channels, png.has_alpha, png.is_deep, png.pixels);
}
[[nodiscard]] inline bool fits(const DecodedPng& png) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 30;  // In a row or a column.
  return png.channels >= 1 && png.channels <= 4 && png.width <= kMost && png.height <= kMost &&
         png.width * png.channels * (png.is_deep ? 2 : 1) * png.height <= png.pixels.size() * sizeof(std::uint16_t);
}

/// Decodes a file that is in memory. By libpng.
/// @param name  The file's name in messages.
[[nodiscard]] DecodedPng decode_png(const std::string& name, std::string_view file);

/// A PNG file, decoded by a reader process unless reads_here().
class PngReader {
 public:
  /// @throws Error with the path for a file that does not exist or is not a complete PNG.
  explicit PngReader(const std::filesystem::path& path);
  /// Decodes a file that is already in memory.
  /// @param name  The file's name in messages.
  PngReader(std::string name, std::span<const char> bytes);

  /// The file name in messages.
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::size_t width() const { return png_.width; }
  [[nodiscard]] std::size_t height() const { return png_.height; }
  /// Whether the file stores red, green and blue. They may be equal in every pixel.
  [[nodiscard]] bool has_colours() const { return png_.channels - (png_.has_alpha ? 1 : 0) == 3; }
  [[nodiscard]] int full_scale() const { return png_.is_deep ? 65535 : 255; }

  /// Grey level of a pixel, 0 to full_scale(). The file may store grey as equal red, green and blue.
  /// @param purpose  Subject of the error message: "heights need".
  /// @throws Error for a pixel that is really coloured, or transparent.
  [[nodiscard]] int grey(std::size_t column, std::size_t row, std::string_view purpose) const;

  /// One colour of a pixel, 0 to full_scale(): 0 red, 1 green, 2 blue; needs has_colours().
  [[nodiscard]] int colour(std::size_t column, std::size_t row, int channel) const {
    return value(column, row, channel);
  }

 private:
  [[nodiscard]] int value(std::size_t column, std::size_t row, int channel) const;

  std::string name_;
  DecodedPng png_;
};

}  // namespace insonify

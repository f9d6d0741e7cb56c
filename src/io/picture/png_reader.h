// png_reader.h -- the pixels of a PNG file, as stored. The only PNG reader.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace insonify {

/// A decoded PNG file in memory: 8 or 16 bits per channel, palettes and fewer bits widened to 8. Gamma values and
/// colour profiles in the file are ignored.
class PngReader {
 public:
  /// @throws Error with the path for a file that does not exist or is not a complete PNG.
  explicit PngReader(const std::filesystem::path& path);
  /// Decodes a file that is already in memory.
  /// @param name  The file's name in messages.
  PngReader(std::string name, std::span<const char> bytes);

  /// The file name in messages.
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] std::size_t height() const { return height_; }
  /// Whether the file stores red, green and blue. They may be equal in every pixel.
  [[nodiscard]] bool has_colours() const { return channels_ - (has_alpha_ ? 1 : 0) == 3; }
  [[nodiscard]] int full_scale() const { return is_deep_ ? 65535 : 255; }

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
  void read(std::string_view file);

  std::string name_;
  std::size_t width_ = 0, height_ = 0;
  int channels_ = 0;  // 1 (grey) or 3 (red, green, blue), plus 1 for alpha.
  bool has_alpha_ = false, is_deep_ = false;
  std::vector<std::uint16_t> pixels_;  // Rows x columns x channels; holds bytes instead if not is_deep_.
};

}  // namespace insonify

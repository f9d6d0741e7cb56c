// lettering.h -- draws text on pictures, in the font that is embedded in the library.

#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "image/canvas.h"

namespace insonify {

/// Which point of a text is placed at the given position.
enum class Anchor { kStart, kMiddle, kEnd };

/// DejaVu Sans in one size: Latin, Greek, Cyrillic, Arabic, Hebrew and others. A character that the font does not have,
/// such as a Chinese one, is shown by its number, as `\u6df1`.
class Lettering {
 public:
  /// @param size  Size of the em square [pixels], >= 1.
  explicit Lettering(int size);
  ~Lettering();
  Lettering(Lettering&&) noexcept;
  Lettering& operator=(Lettering&&) noexcept;

  [[nodiscard]] int size() const { return size_; }

  /// Width of `text` (UTF-8) along its line [pixels].
  [[nodiscard]] double width(std::string_view text) const;

  /// Height of capitals and digits [pixels]; letters extend at most half of that below the base line.
  [[nodiscard]] double height() const;

  /// Draws `text` so that its anchor, at half the height of its capitals, is at `place`.
  void draw(Picture& picture, Point place, std::string_view text, const Ink& ink,
            Anchor anchor = Anchor::kMiddle) const;

  /// As draw(), rotated to read upwards.
  void draw_upwards(Picture& picture, Point place, std::string_view text, const Ink& ink,
                    Anchor anchor = Anchor::kMiddle) const;

  /// As draw(), over a soft dark rim that keeps the text readable on bright echoes.
  void draw_rimmed(Picture& picture, Point place, std::string_view text, const Ink& ink,
                   Anchor anchor = Anchor::kMiddle) const;

  /// `text` if it is at most `limit` [pixels] wide, else as much of it as fits, with an ellipsis.
  [[nodiscard]] std::string shortened(std::string_view text, double limit) const;

 private:
  struct Face;
  int size_;
  std::unique_ptr<Face> face_;
};

}  // namespace insonify

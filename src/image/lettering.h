// lettering.h -- text on pictures, in the one font that is built into the library.

#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "image/canvas.h"

namespace insonify {

/// Which point of a text is put where one says.
enum class Anchor { kStart, kMiddle, kEnd };

/// DejaVu Sans in one size. A letter that it lacks, as it does those of Chinese, is shown as a question mark.
class Lettering {
 public:
  /// @param size  Of the em square [pixels], >= 1.
  explicit Lettering(int size);
  ~Lettering();
  Lettering(Lettering&&) noexcept;
  Lettering& operator=(Lettering&&) noexcept;

  [[nodiscard]] int size() const { return size_; }

  /// What `text` (UTF-8) takes along its line [pixels].
  [[nodiscard]] double width(std::string_view text) const;

  /// Of capitals and digits [pixels]; letters reach at most half of that below.
  [[nodiscard]] double height() const;

  /// Draws `text` so that its anchor, at half the height of its capitals, is at `place`.
  void draw(Picture& picture, Point place, std::string_view text, const Ink& ink,
            Anchor anchor = Anchor::kMiddle) const;

  /// The same, reading upwards.
  void draw_upwards(Picture& picture, Point place, std::string_view text, const Ink& ink,
                    Anchor anchor = Anchor::kMiddle) const;

  /// The same as draw(), over a soft dark rim that keeps it readable on bright echoes.
  void draw_rimmed(Picture& picture, Point place, std::string_view text, const Ink& ink,
                   Anchor anchor = Anchor::kMiddle) const;

  /// `text` if it is at most `limit` wide, else as much of it as fits with an ellipsis.
  [[nodiscard]] std::string shortened(std::string_view text, double limit) const;

 private:
  struct Face;
  int size_;
  std::unique_ptr<Face> face_;
};

}  // namespace insonify

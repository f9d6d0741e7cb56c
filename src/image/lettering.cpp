// lettering.cpp -- lays out and rasterises text by FreeType, with sub-pixel positions along the line.
//
// FreeType draws glyphs; placing them along a line is ours. Cairo would do that too, see docs/design/libraries.md for
// why it does not.

#include "image/lettering.h"

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <cmath>
#include <map>
#include <stdexcept>

#include "base/utf8.h"

// The font file, which cmake/Font.cmake embeds in the library.
extern "C" const unsigned char insonify_font_begin[];  // NOLINT(readability-identifier-naming)
extern "C" const unsigned char insonify_font_end[];    // NOLINT(readability-identifier-naming)

namespace insonify {
namespace {

constexpr double kFixedPoint = 64;  // FreeType's unit is 1/64 pixel.

// As C++ and Python write such characters.
std::string escaped(char32_t point) {
  constexpr char32_t kLongestShort = 0xffff;
  const auto number = static_cast<std::uint32_t>(point);
  return point <= kLongestShort ? fmt::format("\\u{:04x}", number) : fmt::format("\\U{:08x}", number);
}

}  // namespace

struct Lettering::Face {
  struct Glyph {
    FT_UInt index = 0;
    double advance = 0;  // [pixels]
  };

  FT_Library library = nullptr;
  FT_Face face = nullptr;
  double capital_height = 0;
  std::map<char32_t, Glyph> glyphs;

  explicit Face(int size) {
    const auto length = static_cast<FT_Long>(insonify_font_end - insonify_font_begin);
    if (FT_Init_FreeType(&library) != 0 || FT_New_Memory_Face(library, insonify_font_begin, length, 0, &face) != 0 ||
        FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(size)) != 0 || !load(glyph_of('0').index)) {
      throw std::logic_error("the font built into the library cannot be read");
    }
    capital_height = static_cast<double>(face->glyph->metrics.horiBearingY) / kFixedPoint;
  }
  Face(const Face&) = delete;
  Face& operator=(const Face&) = delete;
  ~Face() { FT_Done_FreeType(library); }  // Also releases the faces.

  // Loads a glyph into the face's slot. Light hinting sharpens horizontal strokes without changing widths.
  bool load(FT_UInt index) const { return FT_Load_Glyph(face, index, FT_LOAD_NO_BITMAP | FT_LOAD_TARGET_LIGHT) == 0; }

  // Index and advance of a code point, cached: texts are measured many times while a picture is laid out.
  const Glyph& glyph_of(char32_t point) {
    const auto [place, is_new] = glyphs.try_emplace(point);
    if (is_new) {
      place->second.index = FT_Get_Char_Index(face, point);
      if (place->second.index != 0 && load(place->second.index)) {
        place->second.advance = static_cast<double>(face->glyph->linearHoriAdvance) / 65536;
      }
    }
    return place->second;
  }

  // Calls visit(index, x) for each glyph with its position along the line; returns the length of the line [pixels].
  template <typename Visit>
  double each_glyph(std::string_view text, Visit&& visit) {
    double x = 0;
    FT_UInt before = 0;
    const auto place = [&](const Glyph& glyph) {
      FT_Vector kerning{0, 0};
      if (before != 0 && FT_Get_Kerning(face, before, glyph.index, FT_KERNING_UNFITTED, &kerning) == 0) {
        x += static_cast<double>(kerning.x) / kFixedPoint;
      }
      visit(glyph.index, x);
      x += glyph.advance;
      before = glyph.index;
    };
    while (!text.empty()) {
      const char32_t point = take_code_point(text);
      if (const Glyph& glyph = glyph_of(point); glyph.index != 0) {
        place(glyph);
        continue;
      }
      for (const char letter : escaped(point)) {
        place(glyph_of(static_cast<unsigned char>(letter)));
      }
    }
    return x;
  }

  // Calls plot(right, down, coverage) for every pixel of the text, relative to the start of its base line.
  // @param fraction  Offset of that start from the left border of its pixel, 0..1 [pixels].
  template <typename Plot>
  void rasterise(std::string_view text, double fraction, Plot&& plot) {
    each_glyph(text, [&](FT_UInt index, double x) {
      if (!load(index)) {
        return;
      }
      const double start = std::floor(x + fraction);
      FT_Outline_Translate(&face->glyph->outline, std::lround((x + fraction - start) * kFixedPoint), 0);
      if (FT_Render_Glyph(face->glyph, FT_RENDER_MODE_NORMAL) != 0) {
        return;
      }
      const FT_Bitmap& bitmap = face->glyph->bitmap;
      for (int row = 0; row < static_cast<int>(bitmap.rows); ++row) {
        for (int column = 0; column < static_cast<int>(bitmap.width); ++column) {
          const unsigned char level = bitmap.buffer[row * bitmap.pitch + column];
          if (level > 0) {
            plot(static_cast<int>(start) + face->glyph->bitmap_left + column, row - face->glyph->bitmap_top,
                 level / 255.0);
          }
        }
      }
    });
  }
};

namespace {

double offset_of(Anchor anchor, double width) {
  return anchor == Anchor::kStart ? 0 : anchor == Anchor::kMiddle ? width / 2 : width;
}

}  // namespace

Lettering::Lettering(int size) : size_(size), face_(std::make_unique<Face>(size)) {}
Lettering::~Lettering() = default;
Lettering::Lettering(Lettering&&) noexcept = default;
Lettering& Lettering::operator=(Lettering&&) noexcept = default;

double Lettering::width(std::string_view text) const {
  return face_->each_glyph(text, [](FT_UInt, double) {});
}

double Lettering::height() const {
  return face_->capital_height;
}

void Lettering::draw(Picture& picture, Point place, std::string_view text, const Ink& ink, Anchor anchor) const {
  const double start = place.x - offset_of(anchor, width(text));
  const int left = static_cast<int>(std::floor(start));
  const int base = static_cast<int>(std::lround(place.y + height() / 2));
  face_->rasterise(text, start - left, [&](int right, int down, double coverage) {
    blend(picture, left + right, base + down, ink, coverage);
  });
}

void Lettering::draw_upwards(Picture& picture, Point place, std::string_view text, const Ink& ink,
                             Anchor anchor) const {
  const int bottom = static_cast<int>(std::lround(place.y + offset_of(anchor, width(text))));
  const int base = static_cast<int>(std::lround(place.x + height() / 2));
  face_->rasterise(text, 0, [&](int right, int down, double coverage) {
    blend(picture, base + down, bottom - 1 - right, ink, coverage);
  });
}

void Lettering::draw_rimmed(Picture& picture, Point place, std::string_view text, const Ink& ink, Anchor anchor) const {
  const double reach = std::max(1.0, size_ / 9.0);
  for (int direction = 0; direction < 8; ++direction) {
    const double angle = direction * 0.78539816339744831;
    draw(picture, {place.x + reach * std::cos(angle), place.y + std::round(reach * std::sin(angle))}, text,
         {{8, 10, 13}, 0.45}, anchor);
  }
  draw(picture, place, text, ink, anchor);
}

std::string Lettering::shortened(std::string_view text, double limit) const {
  if (width(text) <= limit) {
    return std::string(text);
  }
  while (!text.empty()) {
    // Remove one whole code point: all its bytes after the first have the upper bits 10.
    bool following = true;
    while (following && !text.empty()) {
      following = (static_cast<unsigned char>(text.back()) & 0xc0U) == 0x80U;
      text.remove_suffix(1);
    }
    if (std::string candidate = std::string(text) + "…"; width(candidate) <= limit) {
      return candidate;
    }
  }
  return "";
}

}  // namespace insonify

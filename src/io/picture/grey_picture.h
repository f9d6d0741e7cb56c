// grey_picture.h -- grey pictures in formats that are not read as heights or textures: JPEG and PGM.

#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

namespace insonify {

/// The most pixels in a row or a column.
inline constexpr std::uint64_t kLongestGrey = std::uint64_t{1} << 30;

/// The levels of a picture, row by row.
struct DecodedGrey {
  std::uint64_t width = 0, height = 0;
  std::uint32_t full_scale = 255;  ///< 1..65535.
  std::vector<std::uint16_t> levels;
};
template <typename Grey>
requires(std::is_same_v<std::remove_const_t<Grey>, DecodedGrey>) [[nodiscard]] auto members(Grey& grey) {
  return std::tie(grey.width, grey.height, grey.full_scale, grey.levels);
}
[[nodiscard]] inline bool fits(const DecodedGrey& grey) {
  return grey.width <= kLongestGrey && grey.height <= kLongestGrey && grey.width * grey.height == grey.levels.size() &&
         grey.full_scale >= 1 && std::ranges::all_of(grey.levels, [&](auto level) { return level <= grey.full_scale; });
}

/// Decodes a JPEG or PGM file (P2, P5) that is in memory.
/// @param name  The file's name in messages.
/// @throws Error for one that is not whole, has more pixels than its budget, or is coloured.
[[nodiscard]] DecodedGrey decode_grey(const std::string& name, std::string_view file);

/// The same of a JPEG file. By libjpeg.
[[nodiscard]] DecodedGrey decode_jpeg(const std::string& name, std::string_view file);

}  // namespace insonify

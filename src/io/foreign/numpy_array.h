// numpy_array.h -- an array in NumPy's .npy format: its header, and its numbers as those of a recording.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace insonify {

/// The header of an .npy file (numpy.lib.format, versions 1 to 3).
struct NumpyHeader {
  std::string type;                  ///< "<f4", as the file spells it.
  std::size_t value_bytes = 0;       ///< [bytes]
  bool fortran_order = false;        ///< The first axis varies fastest; else the last.
  std::vector<std::uint64_t> shape;  ///< Empty for a single number.
  std::uint64_t begin = 0;           ///< Where the numbers begin in the file [bytes].
  std::uint64_t count = 0;           ///< Product of the shape.

  [[nodiscard]] std::uint64_t bytes() const { return count * value_bytes; }
};

/// The longest that a header may be [bytes].
inline constexpr std::size_t kLongestNumpyHeader = std::size_t{1} << 16;

/// @param bytes  The beginning of the file, kLongestNumpyHeader bytes or all.
/// @param name   Of the array, for messages: "PATH" or "PATH: intensity".
/// @throws Error for what is not an array of numbers or texts, and for more than 16 GiB.
[[nodiscard]] NumpyHeader numpy_header_of(std::string_view bytes, const std::string& name);

/// Numbers of a type that recordings have.
struct NumpyArray {
  std::string type;                  ///< "|u1", "<u2", "<f4" or "<f8".
  std::vector<std::uint64_t> shape;  ///< At least one axis.
  std::vector<std::byte> bytes;      ///< The last axis varies fastest.
  std::string note = {};             ///< Where integers of more than 16 bits became counts; else "".

  [[nodiscard]] std::size_t value_bytes() const { return static_cast<std::size_t>(type[2] - '0'); }
  [[nodiscard]] std::vector<double> numbers() const;
};

/// Converts the numbers of a file: bytes swapped where they are big-endian, the first axis slowest. Integers of more
/// than 16 bits, and signed ones, become counts of 8 or 16 bits where all fit into these, else numbers of type "<f8";
/// truth values and numbers of type f2 become "<f4".
/// @throws Error for numbers that are complex, and for objects and texts.
[[nodiscard]] NumpyArray numpy_array(const NumpyHeader& header, std::vector<std::byte> bytes, const std::string& name);

/// The text of a single Unicode string, an array of type "<U12" without axes; none for anything else.
[[nodiscard]] std::optional<std::u32string> numpy_text(const NumpyHeader& header, const std::vector<std::byte>& bytes);

}  // namespace insonify

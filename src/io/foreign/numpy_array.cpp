// numpy_array.cpp -- reads headers of .npy files, which are Python dictionaries, and converts numbers.

#include "io/foreign/numpy_array.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "insonify/error.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

using std::string_view_literals::operator""sv;

constexpr std::string_view kNumpyMark = "\x93NUMPY";

// What follows "'key':" in the dictionary; throws if there is none.
std::string_view value_of(std::string_view dictionary, std::string_view key, const std::string& name) {
  const std::string quoted = fmt::format("'{}'", key);
  std::size_t at = dictionary.find(quoted);
  at = at == std::string_view::npos ? at : dictionary.find_first_not_of(": ", at + quoted.size());
  if (at == std::string_view::npos) {
    throw Error(fmt::format("{}: its header has no {}: {}", name, key, printable(dictionary)));
  }
  return dictionary.substr(at);
}

std::vector<std::uint64_t> shape_in(std::string_view tuple, const std::string& name) {
  const std::size_t end = tuple.find(')');
  std::vector<std::uint64_t> shape;
  if (!tuple.starts_with('(') || end == std::string_view::npos) {
    throw Error(fmt::format("{}: its shape must be a tuple, not {}", name, printable(tuple.substr(0, 40))));
  }
  for (std::string_view rest = tuple.substr(1, end - 1); !rest.empty();) {
    const std::string_view length = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), length.size() + 1));
    const std::size_t digit = length.find_first_not_of(' ');
    if (digit == std::string_view::npos) {
      continue;  // Behind the last comma.
    }
    std::uint64_t number = 0;
    const auto read = std::from_chars(length.data() + digit, length.data() + length.size(), number);
    if (read.ec != std::errc() ||
        std::string_view(read.ptr, length.data() + length.size()).find_first_not_of(" L") != std::string_view::npos) {
      throw Error(fmt::format("{}: its shape has {}, must have whole numbers", name, printable(length)));
    }
    shape.push_back(number);
  }
  return shape;
}

// "<f4" has a byte order, a kind and a size.
void read_type(NumpyHeader& header, std::string_view text, const std::string& name) {
  const std::size_t end = text.find('\'', 1);
  header.type = text.starts_with('\'') && end != std::string_view::npos ? std::string(text.substr(1, end - 1)) : "";
  std::size_t size = 0;
  const char* const last = header.type.data() + header.type.size();
  if (header.type.size() < 3 || "<>|="sv.find(header.type[0]) == std::string_view::npos ||
      std::from_chars(header.type.data() + 2, last, size).ptr != last || size == 0 || size > (1U << 20U) ||
      header.type[1] == 'O') {
    throw Error(fmt::format(
        "{}: holds {}; arrays of numbers are read, no objects and no records", name,
        header.type.empty() ? printable(text.substr(0, text.find(",'"))) : "type " + printable(header.type)));
  }
  header.value_bytes = header.type[1] == 'U' ? 4 * size : size;
}

double half_number(std::uint16_t bits) {
  const int exponent = bits >> 10U & 31U, fraction = bits & 1023U;
  const double size = exponent == 0   ? std::ldexp(fraction, -24)
                      : exponent < 31 ? std::ldexp(fraction + 1024, exponent - 25)
                      : fraction == 0 ? std::numeric_limits<double>::infinity()
                                      : std::numeric_limits<double>::quiet_NaN();
  return (bits & 0x8000U) != 0 ? -size : size;
}

template <typename Number>
std::vector<double> as_doubles(const std::vector<std::byte>& bytes) {
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return {numbers.begin(), numbers.end()};
}

template <typename Number>
std::vector<std::byte> as_bytes_of(const std::vector<double>& numbers) {
  std::vector<std::byte> bytes(numbers.size() * sizeof(Number));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto number = static_cast<Number>(numbers[i]);
    std::memcpy(&bytes[i * sizeof number], &number, sizeof number);
  }
  return bytes;
}

// Numbers of a kind and size, little-endian.
std::vector<double> doubles_of(std::string_view kind, const std::vector<std::byte>& bytes) {
  using Read = std::vector<double> (*)(const std::vector<std::byte>&);
  static constexpr std::pair<std::string_view, Read> kKinds[] = {
      {"u1", as_doubles<std::uint8_t>},  {"u2", as_doubles<std::uint16_t>}, {"u4", as_doubles<std::uint32_t>},
      {"u8", as_doubles<std::uint64_t>}, {"i1", as_doubles<std::int8_t>},   {"i2", as_doubles<std::int16_t>},
      {"i4", as_doubles<std::int32_t>},  {"i8", as_doubles<std::int64_t>},  {"f4", as_doubles<float>},
      {"f8", as_doubles<double>},        {"b1", as_doubles<std::uint8_t>},  {"f2", as_doubles<std::uint16_t>}};
  const auto* const found = std::ranges::find(kKinds, kind, &std::pair<std::string_view, Read>::first);
  if (found == std::end(kKinds)) {
    return {};
  }
  std::vector<double> numbers = found->second(bytes);
  if (kind == "f2") {
    std::ranges::transform(numbers, numbers.begin(),
                           [](double bits) { return half_number(static_cast<std::uint16_t>(bits)); });
  }
  return numbers;
}

// From the first axis fastest to the last axis fastest.
std::vector<std::byte> transposed(const std::vector<std::byte>& bytes, const std::vector<std::uint64_t>& shape,
                                  std::size_t value_bytes) {
  std::vector<std::byte> result(bytes.size());
  std::vector<std::uint64_t> index(shape.size());
  const std::size_t count = bytes.size() / std::max<std::size_t>(value_bytes, 1);
  for (std::size_t to = 0; to < count; ++to) {
    std::size_t from = 0;
    for (std::size_t axis = shape.size(); axis-- > 0;) {
      from = from * shape[axis] + index[axis];
    }
    std::memcpy(&result[to * value_bytes], &bytes[from * value_bytes], value_bytes);
    for (std::size_t axis = shape.size(); axis-- > 0 && ++index[axis] == shape[axis];) {
      index[axis] = 0;
    }
  }
  return result;
}

void make_counts(NumpyArray& array, const std::vector<double>& numbers, const std::string& type) {
  const auto [least, most] = std::ranges::minmax(numbers);
  array.type = least < 0 || most > 65535 ? "<f8" : most > 255 ? "<u2" : "|u1";
  array.bytes = array.type == "<f8"   ? as_bytes_of<double>(numbers)
                : array.type == "<u2" ? as_bytes_of<std::uint16_t>(numbers)
                                      : as_bytes_of<std::uint8_t>(numbers);
  if (array.type != "<f8") {
    array.note = fmt::format("integers of type {} up to {:.0f} are taken as counts of {} bits", type, most,
                             array.type == "<u2" ? 16 : 8);
  }
}

}  // namespace

NumpyHeader numpy_header_of(std::string_view bytes, const std::string& name) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 34;
  if (!bytes.starts_with(kNumpyMark)) {
    throw Error(fmt::format("{}: byte 0: begins with {}; an array of NumPy begins with \"\\x93NUMPY\"", name,
                            printable(fmt::format("\"{}\"", bytes.substr(0, kNumpyMark.size())))));
  }
  const bool is_long = bytes.size() > 6 && bytes[6] > 1;
  const std::size_t head = is_long ? 12 : 10;
  std::uint32_t length = 0;
  if (bytes.size() >= head) {
    std::memcpy(&length, bytes.data() + 8, is_long ? 4 : 2);
  }
  if (bytes.size() < head || length > bytes.size() - head) {
    throw Error(fmt::format("{}: byte 8: its header of {} bytes is cut off or too long, the limit is {}", name, length,
                            kLongestNumpyHeader));
  }
  const std::string_view dictionary = bytes.substr(head, length);
  NumpyHeader header;
  header.begin = head + length;
  header.count = 1;
  read_type(header, value_of(dictionary, "descr", name), name);
  header.fortran_order = value_of(dictionary, "fortran_order", name).starts_with("True");
  header.shape = shape_in(value_of(dictionary, "shape", name), name);
  for (const std::uint64_t axis : header.shape) {
    if (axis > 0 && header.count > kMostBytes / axis) {
      header.count = kMostBytes + 1;
      break;
    }
    header.count *= axis;
  }
  if (header.count > kMostBytes / header.value_bytes) {
    throw Error(fmt::format("{}: an array of {} numbers is too large: at most 16 GiB are read", name,
                            fmt::join(header.shape, " x ")));
  }
  return header;
}

std::vector<double> NumpyArray::numbers() const {
  return doubles_of(std::string_view(type).substr(1), bytes);
}

NumpyArray numpy_array(const NumpyHeader& header, std::vector<std::byte> bytes, const std::string& name) {
  const std::string kind = header.type.substr(1);
  if (header.count == 0) {
    throw Error(fmt::format("{}: its array is empty: {}", name, fmt::join(header.shape, " x ")));
  }
  if (header.type[0] == '>') {
    for (std::size_t at = 0; at < bytes.size(); at += header.value_bytes) {
      std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                   bytes.begin() + static_cast<std::ptrdiff_t>(at + header.value_bytes));
    }
  }
  if (header.fortran_order && header.shape.size() > 1) {
    bytes = transposed(bytes, header.shape, header.value_bytes);
  }
  NumpyArray array{.type = "", .shape = header.shape, .bytes = {}};
  if (array.shape.empty()) {
    array.shape = {1};
  }
  if (kind == "u1" || kind == "u2" || kind == "f4" || kind == "f8") {
    array.type = (kind == "u1" ? "|" : "<") + kind;
    array.bytes = std::move(bytes);
    return array;
  }
  const std::vector<double> numbers = doubles_of(kind, bytes);
  if (numbers.empty()) {
    throw Error(fmt::format("{}: holds values of type {}; real numbers of at most 64 bits are read{}", name,
                            printable(header.type), kind[0] == 'c' ? ", as numpy.abs(x) ** 2 makes" : ""));
  }
  if (kind == "b1" || kind == "f2") {
    array.type = "<f4";
    array.bytes = as_bytes_of<float>(numbers);
  } else {
    make_counts(array, numbers, header.type);
  }
  return array;
}

std::optional<std::u32string> numpy_text(const NumpyHeader& header, const std::vector<std::byte>& bytes) {
  if (!header.type.starts_with("<U") || !header.shape.empty() || bytes.size() != header.value_bytes) {
    return {};
  }
  std::u32string text(bytes.size() / sizeof(char32_t), U'\0');
  std::memcpy(text.data(), bytes.data(), bytes.size());
  return text.substr(0, text.find(U'\0'));  // Shorter texts are filled up.
}

}  // namespace insonify

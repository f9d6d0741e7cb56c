// ply_body.cpp -- PLY elements as lines of a text, or as bytes in either order.

#include "io/mesh/ply_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "insonify/error.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

// Elements of a text file, one in each line.
class PlyText : public PlyBody {
 public:
  PlyText(std::ifstream& file, std::string path, int line) : file_(file), path_(std::move(path)), line_(line) {}

  bool read(const PlyElement& element, std::vector<std::vector<double>>& values) override {
    do {
      if (!std::getline(file_, text_)) {
        return false;
      }
      ++line_;
      rest_ = text_;
      word_ = next_word();
    } while (word_.empty() || word_ == "comment");
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      values[i].clear();
      for (double count = element.properties[i].is_list ? take(element) : 1; count >= 1; --count) {
        values[i].push_back(take(element));
      }
    }
    return true;
  }

 private:
  double take(const PlyElement& element) {
    if (word_.empty()) {
      throw Error(fmt::format("{}:{}: fewer numbers than an element {} has", path_, line_, printable(element.name)));
    }
    std::string_view digits = word_;
    digits.remove_prefix(digits.starts_with('+') ? 1 : 0);
    double number = 0;
    const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (failure == std::errc::invalid_argument || end != digits.data() + digits.size()) {
      throw Error(fmt::format("{}:{}: \"{}\" is not a number", path_, line_, printable(word_)));
    }
    word_ = next_word();
    return number;
  }

  std::string_view next_word() {
    constexpr std::string_view kBlank = " \t\r";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlank), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kBlank));
    rest_.remove_prefix(word.size());
    return word;
  }

  std::ifstream& file_;
  std::string path_, text_;
  std::string_view rest_, word_;
  int line_;
};

// Elements of a binary file.
class PlyBinary : public PlyBody {
 public:
  PlyBinary(std::ifstream& file, bool big_endian) : file_(file), big_endian_(big_endian) {}

  bool read(const PlyElement& element, std::vector<std::vector<double>>& values) override {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      values[i].clear();
      for (double count = property.is_list ? take(property.count_type) : 1; count >= 1 && file_; --count) {
        values[i].push_back(take(property.type));
      }
    }
    return static_cast<bool>(file_);
  }

 private:
  template <typename Number>
  double take() {
    std::array<char, sizeof(Number)> bytes{};
    file_.read(bytes.data(), bytes.size());
    if (big_endian_) {
      std::ranges::reverse(bytes);
    }
    return static_cast<double>(std::bit_cast<Number>(bytes));
  }

  double take(PlyType type) {
    switch (type) {
      case PlyType::kInt8:
        return take<std::int8_t>();
      case PlyType::kUint8:
        return take<std::uint8_t>();
      case PlyType::kInt16:
        return take<std::int16_t>();
      case PlyType::kUint16:
        return take<std::uint16_t>();
      case PlyType::kInt32:
        return take<std::int32_t>();
      case PlyType::kUint32:
        return take<std::uint32_t>();
      case PlyType::kFloat:
        return static_cast<double>(take<float>());
      case PlyType::kDouble:
        break;
    }
    return take<double>();
  }

  std::ifstream& file_;
  bool big_endian_;
};

}  // namespace

std::unique_ptr<PlyBody> make_ply_body(std::ifstream& file, const PlyHeader& header,
                                       const std::filesystem::path& path) {
  if (header.format == "ascii") {
    return std::make_unique<PlyText>(file, path.string(), header.lines);
  }
  if (header.format != "binary_little_endian" && header.format != "binary_big_endian") {
    throw Error(fmt::format("{}: format \"{}\" is not ascii, binary_little_endian or binary_big_endian", path.string(),
                            printable(header.format)));
  }
  file.clear();  // The header may end at the end of the file.
  return std::make_unique<PlyBinary>(file, header.format == "binary_big_endian");
}

}  // namespace insonify

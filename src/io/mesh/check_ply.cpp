// check_ply.cpp -- reads the header and skips through the elements to count them.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <vector>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/input_file.h"
#include "io/mesh/mesh_checks.h"

namespace insonify {
namespace {

// A number, or a list: a count followed by that many numbers.
struct Property {
  std::uint64_t bytes = 1;        // Size of one number.
  std::uint64_t count_bytes = 0;  // Size of the count; 0 if the property is not a list.
};

struct Element {
  std::string name, count_as_written;
  std::uint64_t count = 0;
  int line = 1;
  std::vector<Property> properties;
};

struct PlyHeader {
  std::string format;
  std::vector<Element> elements;
  int lines = 0;
};

constexpr std::pair<std::string_view, std::uint64_t> kTypes[] = {
    {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
    {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
    {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};

std::uint64_t bytes_of_type(const std::string& type) {
  const auto* found = std::ranges::find(kTypes, type, &std::pair<std::string_view, std::uint64_t>::first);
  return found == std::end(kTypes) ? 1 : found->second;  // assimp refuses unknown ones.
}

std::uint64_t read_count(const std::string& word, const std::string& where) {
  std::uint64_t count = 0;
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), count);
  if (failure == std::errc::invalid_argument || end != word.data() + word.size()) {
    throw Error(fmt::format("{}: \"{}\" is not a number of elements", where, printable(word)));
  }
  return failure == std::errc() ? count : std::numeric_limits<std::uint64_t>::max();
}

// The test that assimp uses, with an optional byte order mark before it.
bool starts_as_ply(std::string_view line) {
  line.remove_prefix(line.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
  return line.starts_with("ply") || line.starts_with("PLY");
}

// Leaves the file at the first element. Returns nothing for a file that is not PLY: assimp refuses it.
std::optional<PlyHeader> read_ply_header(std::ifstream& file, const std::filesystem::path& path) {
  PlyHeader header;
  std::string text, key;
  while (key != "end_header") {
    const bool is_line = static_cast<bool>(std::getline(file, text));
    ++header.lines;
    if (header.lines == 1 && !starts_as_ply(text)) {
      return {};
    }
    if (!is_line) {
      throw Error(fmt::format("{}: its header does not end: no line says end_header", path.string()));
    }
    key.clear();
    std::istringstream words(text);
    std::string first, second, third;
    words >> key >> first >> second >> third;
    if (key == "format") {
      header.format = first;
    } else if (key == "element") {
      const std::string where = fmt::format("{}:{}", path.string(), header.lines);
      header.elements.push_back({first, second, read_count(second, where), header.lines, {}});
    } else if (key == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(
          first == "list" ? Property{bytes_of_type(third), bytes_of_type(second)} : Property{bytes_of_type(first), 0});
    }
  }
  return header;
}

// Elements of a text file, one in each line.
class TextBody {
 public:
  TextBody(std::ifstream& file, std::string path, int line) : file_(file), path_(std::move(path)), line_(line) {}

  // Skips one element. Returns false at the end of the file.
  bool take(const Element& element) {
    do {
      if (!std::getline(file_, text_)) {
        return false;
      }
      ++line_;
      rest_ = text_;
      word_ = next_word();
    } while (word_.empty() || word_ == "comment");
    for (const Property& property : element.properties) {
      take(property, element.name);
    }
    return true;
  }

 private:
  void take(const Property& property, const std::string& element) {
    std::uint64_t words = 1;
    if (property.count_bytes > 0) {
      std::uint64_t count = 0;
      std::from_chars(word_.data(), word_.data() + word_.size(), count);
      words += count;
    }
    for (; words > 0; --words) {
      if (word_.empty()) {
        throw Error(fmt::format("{}:{}: fewer numbers than an element {} has", path_, line_, printable(element)));
      }
      word_ = next_word();
    }
  }

  std::string_view next_word() {
    constexpr std::string_view kSpace = " \t\r";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kSpace), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kSpace));
    rest_.remove_prefix(word.size());
    return word;
  }

  std::ifstream& file_;
  std::string path_, text_;
  std::string_view rest_, word_;
  int line_;
};

// Elements of a binary file.
class BinaryBody {
 public:
  BinaryBody(std::ifstream& file, std::uint64_t size, bool big_endian)
      : file_(file), left_(size), big_endian_(big_endian) {}

  // Skips one element. Returns false if the file ends before its end.
  bool take(const Element& element) {
    return std::ranges::all_of(element.properties, [this](const Property& property) {
      return left_ >= property.count_bytes && skip(property.bytes * read_count(property.count_bytes));
    });
  }

 private:
  bool skip(std::uint64_t bytes) {
    const bool is_there = bytes <= left_;
    left_ -= is_there ? bytes : 0;
    file_.ignore(is_there ? static_cast<std::streamsize>(bytes) : 0);
    return is_there;
  }

  // Number of values that follow: the count of a list, or 1.
  std::uint64_t read_count(std::uint64_t bytes) {
    std::uint64_t count = bytes > 0 ? 0 : 1;
    for (std::uint64_t i = 0; i < bytes; ++i) {
      const auto byte = static_cast<std::uint64_t>(std::max(file_.get(), 0));
      count = big_endian_ ? count << 8U | byte : count | byte << 8U * i;
    }
    left_ -= bytes;
    return count;
  }

  std::ifstream& file_;
  std::uint64_t left_;
  bool big_endian_;
};

template <typename Body>
void check_elements(const std::vector<Element>& elements, Body&& body, const std::filesystem::path& path) {
  for (const Element& element : elements) {
    const std::string where = fmt::format("{}:{}: element {} {}", path.string(), element.line, printable(element.name),
                                          printable(element.count_as_written));
    if (element.count > 0 && element.properties.empty()) {
      throw Error(where + " has no properties");
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (!body.take(element)) {
        throw Error(fmt::format("{}: the file ends after {}", where, i));
      }
    }
  }
}

}  // namespace

void check_ply(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::optional<PlyHeader> header = read_ply_header(file, path);
  if (!header) {
    return;
  }
  if (header->format == "ascii") {
    check_elements(header->elements, TextBody(file, path.string(), header->lines), path);
  } else {
    file.clear();  // The header may end at the end of the file.
    const std::uint64_t size = std::filesystem::file_size(path) - static_cast<std::uint64_t>(file.tellg());
    check_elements(header->elements, BinaryBody(file, size, header->format == "binary_big_endian"), path);
  }
}

}  // namespace insonify

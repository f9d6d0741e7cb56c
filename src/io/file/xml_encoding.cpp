// xml_encoding.cpp -- converts XML from the encoding that it declares, by iconv.

#include <iconv.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <memory>

#include "base/utf8.h"
#include "io/file/input_file.h"
#include "io/file/xml_file.h"

namespace insonify {
namespace {

struct CloseConverter {
  using pointer = iconv_t;
  void operator()(iconv_t converter) const { iconv_close(converter); }
};

// Where the name of the encoding is in <?xml version="1.0" encoding="ISO-8859-1"?>; empty if there is none.
std::string_view declared_encoding(std::string_view text) {
  constexpr std::size_t kLongestDeclaration = 200;
  const std::string_view start = text.substr(0, std::min(text.find("?>"), kLongestDeclaration));
  const std::size_t key = start.starts_with("<?xml") ? start.find("encoding") : std::string_view::npos;
  const std::size_t open = key == std::string_view::npos ? key : start.find_first_of("\"'", key);
  const std::size_t close = open == std::string_view::npos ? open : start.find(start[open], open + 1);
  return close == std::string_view::npos ? std::string_view() : start.substr(open + 1, close - open - 1);
}

// UTF-16 by its byte-order mark or its first '<', else what is declared. A declaration that can be read as single bytes
// and says UTF-16 is wrong.
std::string encoding_of(std::string_view text) {
  if (text.starts_with("\xff\xfe") || text.starts_with(std::string_view("<\0", 2))) {
    return "UTF-16LE";
  }
  if (text.starts_with("\xfe\xff") || text.starts_with(std::string_view("\0<", 2))) {
    return "UTF-16BE";
  }
  std::string name(declared_encoding(text));
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const bool is_wide = name.starts_with("UTF-16") || name.starts_with("UTF-32") || name.starts_with("UCS");
  return name.empty() || is_wide || text.starts_with(kByteOrderMark) ? "UTF-8" : name;
}

// Bytes that the converter refuses stay as they are, for as_utf8().
std::string converted(std::string_view text, iconv_t converter) {
  std::string result;
  std::array<char, 4096> part;
  char* from = const_cast<char*>(text.data());  // iconv() does not change it.
  std::size_t left = text.size();
  while (left > 0) {
    char* to = part.data();
    std::size_t room = part.size();
    const bool failed = iconv(converter, &from, &left, &to, &room) == static_cast<std::size_t>(-1);
    result.append(part.data(), part.size() - room);
    if (failed && errno != E2BIG) {
      result += *from++;
      --left;
    }
  }
  return result;
}

}  // namespace

std::string xml_in_utf8(std::string text) {
  const std::string encoding = encoding_of(text);
  if (encoding != "UTF-8") {
    const iconv_t made = iconv_open("UTF-8", encoding.c_str());
    if (made != reinterpret_cast<iconv_t>(-1)) {
      const std::unique_ptr<void, CloseConverter> converter(made);
      text = converted(text, made);
    }
  }
  text.erase(0, text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
  if (const std::string_view declared = declared_encoding(text); !declared.empty()) {
    text.replace(static_cast<std::size_t>(declared.data() - text.data()), declared.size(), "UTF-8");
  }
  return as_utf8(text);
}

}  // namespace insonify

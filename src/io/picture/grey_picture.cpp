// grey_picture.cpp -- reads PGM files, and any picture as levels from 0 to 1.

#include "io/picture/grey_picture.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <fstream>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "insonify/recorded_pings.h"
#include "io/file/budgets.h"
#include "io/file/input_file.h"
#include "io/file/reader_process.h"
#include "io/picture/png_reader.h"

namespace insonify {
namespace {

using std::string_view_literals::operator""sv;

constexpr std::string_view kJpegMark = "\xff\xd8\xff", kPngMark = "\x89PNG\r\n\x1a\n";

bool is_pgm(std::string_view head) {
  return head.size() > 2 && head[0] == 'P' && (head[1] == '2' || head[1] == '5') &&
         " \t\r\n#"sv.find(head[2]) != std::string_view::npos;
}

// Numbers of a PGM file, with blanks and comments before each.
class PgmNumbers {
 public:
  PgmNumbers(const std::string& name, std::string_view file) : name_(name), file_(file) {}

  [[nodiscard]] std::size_t place() const { return at_; }

  std::uint32_t next(const char* what, std::uint32_t least, std::uint64_t most) {
    while (at_ < file_.size() && (" \t\r\n\v\f"sv.find(file_[at_]) != std::string_view::npos || file_[at_] == '#')) {
      at_ = file_[at_] == '#' ? std::min(file_.find('\n', at_), file_.size()) : at_ + 1;
    }
    std::uint32_t number = 0;
    const auto read = std::from_chars(file_.data() + at_, file_.data() + file_.size(), number);
    if (read.ec != std::errc() || number < least || number > most) {
      throw Error(fmt::format("{}: byte {}: {} = {} must be a whole number from {} to {}", name_, at_, what,
                              printable(fmt::format("\"{}\"", file_.substr(at_, 12))), least, most));
    }
    at_ = static_cast<std::size_t>(read.ptr - file_.data());
    return number;
  }

 private:
  const std::string& name_;
  std::string_view file_;
  std::size_t at_ = 2;  // Behind "P5".
};

DecodedGrey decode_pgm(const std::string& name, std::string_view file) {
  PgmNumbers numbers(name, file);
  DecodedGrey grey;
  grey.width = numbers.next("width", 1, kLongestGrey);
  grey.height = numbers.next("height", 1, kLongestGrey);
  check_budget(Budget::kPixels, static_cast<double>(grey.width) * static_cast<double>(grey.height), name);
  grey.full_scale = numbers.next("greatest level", 1, 65535);
  const std::uint64_t pixels = grey.width * grey.height;
  if (file[1] == '2') {
    for (std::uint64_t i = 0; i < pixels; ++i) {
      grey.levels.push_back(static_cast<std::uint16_t>(numbers.next("level", 0, grey.full_scale)));
    }
    return grey;
  }
  const std::size_t begin = numbers.place() + 1, size = grey.full_scale > 255 ? 2 : 1;
  if (begin > file.size() || file.size() - begin < pixels * size) {
    throw Error(fmt::format("{}: byte {}: {} x {} pixels need {} bytes; the file has {} more", name, begin, grey.width,
                            grey.height, pixels * size, file.size() - std::min(begin, file.size())));
  }
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(file[at]); };
  for (std::uint64_t i = 0; i < pixels; ++i) {
    const std::size_t at = begin + i * size;
    const int level = size == 1 ? byte(at) : byte(at) << 8 | byte(at + 1);
    if (level > static_cast<int>(grey.full_scale)) {
      throw Error(
          fmt::format("{}: byte {}: level {} must be at most {}, its greatest", name, at, level, grey.full_scale));
    }
    grey.levels.push_back(static_cast<std::uint16_t>(level));
  }
  return grey;
}

GreyPicture picture_of(const PngReader& png) {
  GreyPicture picture{png.name(), static_cast<int>(png.width()), static_cast<int>(png.height()), {}};
  picture.values.reserve(png.width() * png.height());
  for (std::size_t row = 0; row < png.height(); ++row) {
    for (std::size_t column = 0; column < png.width(); ++column) {
      picture.values.push_back(static_cast<double>(png.grey(column, row, "a comparison needs")) / png.full_scale());
    }
  }
  return picture;
}

}  // namespace

DecodedGrey decode_grey(const std::string& name, std::string_view file) {
  if (file.starts_with(kJpegMark)) {
    return decode_jpeg(name, file);
  }
  if (is_pgm(file)) {
    return decode_pgm(name, file);
  }
  throw Error(
      fmt::format("{}: byte 0: begins with {}; a JPEG file begins with \\xff\\xd8\\xff, a PGM file with P5 or P2", name,
                  printable(fmt::format("\"{}\"", file.substr(0, 4)))));
}

bool is_picture(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  if (ending == ".png" || ending == ".jpg" || ending == ".jpeg" || ending == ".pgm") {
    return true;
  }
  std::error_code ignored;
  std::array<char, 8> head{};
  if (std::filesystem::is_regular_file(path, ignored)) {
    std::ifstream(path, std::ios::binary).read(head.data(), head.size());
  }
  const std::string_view text(head.data(), head.size());
  return text.starts_with(kJpegMark) || text == kPngMark || is_pgm(text);
}

GreyPicture load_grey_picture(const std::filesystem::path& path) {
  const std::string file = read_text(path);
  const std::string ending = ending_of(path), name = path.string();
  const bool jpeg = file.starts_with(kJpegMark);
  if (!jpeg && !is_pgm(file) && ending != ".jpg" && ending != ".jpeg" && ending != ".pgm") {
    return picture_of(PngReader(name, file));
  }
  const DecodedGrey grey = reads_here()
                               ? decode_grey(name, file)
                               : read_apart<DecodedGrey>({name, jpeg ? "JPEG" : "PGM"}, ReaderTask::kGrey, name, file);
  GreyPicture picture{name, static_cast<int>(grey.width), static_cast<int>(grey.height), {}};
  picture.values.reserve(grey.levels.size());
  for (const std::uint16_t level : grey.levels) {
    picture.values.push_back(static_cast<double>(level) / grey.full_scale);
  }
  return picture;
}

}  // namespace insonify

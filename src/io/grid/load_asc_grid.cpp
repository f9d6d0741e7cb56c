// load_asc_grid.cpp -- reads ESRI ASCII grids: "key value" lines, then heights row by row from the north-west.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "base/names.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/budgets.h"
#include "io/file/input_file.h"
#include "io/grid/height_grid_file.h"

namespace insonify {
namespace {

// Splits a text at white space; each word knows its line.
class Words {
 public:
  Words(const std::filesystem::path& path, std::string_view text) : path_(path), text_(text) {
    at_ = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
    next();
  }

  [[nodiscard]] std::string_view word() const { return word_; }  // Empty at the end.
  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] std::string path() const { return path_.string(); }
  [[nodiscard]] std::size_t size() const { return text_.size(); }  // Bytes of the whole text.

  void next() {
    while (at_ < text_.size() && is_space(text_[at_])) {
      line_ += text_[at_] == '\n' ? 1 : 0;
      ++at_;
    }
    const std::size_t start = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) {
      ++at_;
    }
    word_ = text_.substr(start, at_ - start);
  }

  // The word as a number ("nan" is one), or nothing.
  [[nodiscard]] std::optional<double> number() const {
    std::string_view digits = word_;
    digits.remove_prefix(digits.starts_with('+') ? 1 : 0);
    double value = 0;
    const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return failure == std::errc() && end == digits.data() + digits.size() ? std::optional(value) : std::nullopt;
  }

  [[noreturn]] void fail(const std::string& reason) const { fail(line_, reason); }
  [[noreturn]] void fail(int line, const std::string& reason) const {
    throw Error(fmt::format("{}:{}: {}", path_.string(), line, reason));
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v'; }

  std::filesystem::path path_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::string_view word_;
  int line_ = 1;
};

// A number of the header and its line.
struct Entry {
  double number;
  int line;
};

struct Header {
  std::optional<Entry> ncols, nrows;
  std::optional<Entry> xllcorner, xllcenter, yllcorner, yllcenter;
  std::optional<Entry> cellsize, dx, dy;
  std::optional<Entry> nodata_value;
  int last_line = 1;

  std::optional<Entry>* find(const std::string& key) {
    const std::pair<std::string_view, std::optional<Entry>*> fields[]{{"ncols", &ncols},
                                                                      {"nrows", &nrows},
                                                                      {"xllcorner", &xllcorner},
                                                                      {"xllcenter", &xllcenter},
                                                                      {"yllcorner", &yllcorner},
                                                                      {"yllcenter", &yllcenter},
                                                                      {"cellsize", &cellsize},
                                                                      {"dx", &dx},
                                                                      {"dy", &dy},
                                                                      {"nodata_value", &nodata_value},
                                                                      {"nodata", &nodata_value}};
    for (const auto& [name, field] : fields) {
      if (name == key) {
        return field;
      }
    }
    return nullptr;
  }
};

// Reads "key number" pairs up to the first word that is a number: that is the first height.
Header read_header(Words& words) {
  Header header;
  while (!words.word().empty() && !words.number()) {
    const std::string key(words.word());
    std::optional<Entry>* field = header.find(lower_case(key));
    if (field == nullptr) {
      words.fail(
          fmt::format("\"{}\" is neither a number nor a key of an ESRI ASCII grid; keys: ncols, nrows, xllcorner, "
                      "xllcenter, yllcorner, yllcenter, cellsize, dx, dy, nodata_value",
                      printable(key)));
    }
    if (field->has_value()) {
      words.fail(fmt::format("{} is given twice", key));
    }
    header.last_line = words.line();
    words.next();
    const std::optional<double> number = words.number();
    if (!number || words.line() != header.last_line) {
      words.fail(header.last_line, fmt::format("{} needs a number", key));
    }
    *field = {*number, header.last_line};
    words.next();
  }
  return header;
}

int read_count(const Words& words, const Header& header, std::string_view key, const std::optional<Entry>& entry) {
  if (!entry) {
    words.fail(header.last_line, fmt::format("the header has no {}", key));
  }
  constexpr double kMost = 1e6;
  const double count = entry->number;
  if (!(count >= 2 && count <= kMost && count == std::floor(count))) {
    words.fail(entry->line, fmt::format("{} = {} must be a whole number from 2 to 1000000", key, count));
  }
  return static_cast<int>(count);
}

double read_spacing(const Words& words, const Header& header, std::string_view key, const std::optional<Entry>& own) {
  const std::optional<Entry>& entry = own ? own : header.cellsize;
  if (!entry) {
    words.fail(header.last_line, fmt::format("the header has neither cellsize nor {}", key));
  }
  const double spacing = entry->number;
  if (!(spacing > 0 && std::isfinite(spacing))) {
    words.fail(entry->line, fmt::format("{} = {} must be greater than 0", own ? key : "cellsize", spacing));
  }
  return spacing;
}

// Middle of the grid along one axis, from the corner or the middle of the lower left cell; 0 if neither is given.
double middle(const std::optional<Entry>& corner, const std::optional<Entry>& center, int count, double spacing) {
  if (corner) {
    return corner->number + count * spacing / 2;
  }
  return center ? center->number + (count - 1) * spacing / 2 : 0;
}

void read_heights(Words& words, const Header& header, HeightGrid& grid) {
  const std::size_t needed = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
  // The no-data value is often written with a different number of digits than in the header: compared as float.
  const auto hole = header.nodata_value ? static_cast<float>(header.nodata_value->number) : -9999.0F;
  grid.heights.reserve(std::min(needed, words.size() / 2 + 1));  // The header may claim any size.
  int line = words.line();
  for (; !words.word().empty() && grid.heights.size() < needed; words.next()) {
    const std::optional<double> value = words.number();
    if (!value) {
      words.fail(fmt::format("\"{}\" is not a number", printable(words.word())));
    }
    const auto height = static_cast<float>(*value);
    if (std::isinf(height)) {
      words.fail(fmt::format("height {} must be finite", words.word()));
    }
    grid.heights.push_back(height == hole ? std::numeric_limits<float>::quiet_NaN() : height);
    line = words.line();
  }
  const std::string size = fmt::format("ncols x nrows = {} x {}", grid.columns, grid.rows);
  if (grid.heights.size() < needed) {
    words.fail(line, fmt::format("the file ends after {} heights; {} needs {}", grid.heights.size(), size, needed));
  }
  check_budget(Budget::kPixels, static_cast<double>(needed), words.path());
  if (!words.word().empty()) {
    words.fail(fmt::format("more heights than {} = {}", size, needed));
  }
}

// The projection is in a .prj file beside the grid, if there is one.
std::optional<bool> is_geographic_by_prj(std::filesystem::path path) {
  path.replace_extension(".prj");
  if (!std::filesystem::exists(path)) {
    return std::nullopt;
  }
  const std::string text = lower_case(read_text(path));
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  const std::string_view projection = std::string_view(text).substr(std::min(start, text.size()));
  // As well-known text, or as ESRI's older "Projection GEOGRAPHIC".
  return projection.starts_with("geog") || projection.starts_with("geodcrs") ||
         (projection.starts_with("projection") && projection.find("geographic") != std::string_view::npos);
}

}  // namespace

HeightGrid load_asc_grid(const std::filesystem::path& path, const Log& log) {
  const std::string text = read_text(path);
  Words words(path, text);
  const Header header = read_header(words);

  HeightGrid grid;
  grid.columns = read_count(words, header, "ncols", header.ncols);
  grid.rows = read_count(words, header, "nrows", header.nrows);
  grid.spacing_x = read_spacing(words, header, "dx", header.dx);
  grid.spacing_y = read_spacing(words, header, "dy", header.dy);
  grid.origin.x() = middle(header.xllcorner, header.xllcenter, grid.columns, grid.spacing_x);
  grid.origin.y() = middle(header.yllcorner, header.yllcenter, grid.rows, grid.spacing_y);
  read_heights(words, header, grid);

  if (is_geographic_by_prj(path).value_or(looks_geographic(grid))) {
    turn_degrees_into_metres(grid, path, log);
  }
  return grid;
}

}  // namespace insonify

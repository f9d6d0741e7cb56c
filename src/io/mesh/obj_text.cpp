// obj_text.cpp -- checks an OBJ statement by statement, before and after assimp reads it.
//
// Ours, since tinyobjloader 2.0 accepts what must be refused: it reads "v a b c" and "v 1 2" as zeros, keeps faces with
// indices beyond the last vertex (with a warning) or before the first one (without), loses the name of a material whose
// library is missing, and refuses lines continued by a backslash. See docs/design/libraries.md.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <set>
#include <vector>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/mesh/mesh_checks.h"

namespace insonify {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

// Quotes a text in a message.
std::string shown(std::string_view text) {
  return printable(text.substr(0, text.find_last_not_of(kSpace) + 1));
}

// A line, or several where a backslash ends all but the last; and its words up to a comment.
struct Statement {
  std::string_view text;    // With its line break.
  std::size_t comment = 0;  // Where in the text it begins; the text's size where there is none.
  int line = 1;
  std::vector<std::string_view> words;

  [[nodiscard]] std::string_view key() const { return words.empty() ? "" : words[0]; }
  [[nodiscard]] bool is_vertex() const { return key() == "v"; }
  [[nodiscard]] bool is_numbers() const { return is_vertex() || key() == "vn" || key() == "vt"; }
  [[nodiscard]] bool is_indices() const { return key() == "f" || key() == "l" || key() == "p"; }
};

class Statements {
 public:
  Statements(std::string_view text, const std::filesystem::path& path) : text_(text), path_(path) {}

  // Moves to the next one. False at the end.
  bool next() {
    now_.line += static_cast<int>(std::ranges::count(now_.text, '\n'));
    if (at_ == text_.size()) {
      return false;
    }
    std::size_t end = at_;
    do {
      end = std::min(text_.find('\n', end), text_.size() - 1) + 1;
    } while (end < text_.size() && goes_on(text_.substr(at_, end - at_)));
    now_.text = text_.substr(at_, end - at_);
    at_ = end;
    split();
    return true;
  }

  [[nodiscard]] const Statement& now() const { return now_; }

  [[noreturn]] void fail(const std::string& reason) const {
    const std::string_view text = now_.text.substr(now_.text.find_first_not_of(kSpace));
    throw Error(fmt::format("{}:{}: {}: {}", path_.string(), now_.line, shown(text), reason));
  }

 private:
  static bool goes_on(std::string_view line) {
    line.remove_suffix(line.ends_with("\r\n") ? 2 : 1);
    return line.ends_with('\\');
  }

  void split() {
    now_.words.clear();
    now_.comment = now_.text.size();
    for (std::size_t at = now_.text.find_first_not_of(kSpace); at != std::string_view::npos;) {
      if (now_.text[at] == '#') {
        now_.comment = at;
        return;
      }
      const std::size_t end = std::min(now_.text.find_first_of(kSpace, at), now_.text.size());
      std::string_view word = now_.text.substr(at, end - at);
      word.remove_suffix(word.ends_with('\\') ? 1 : 0);
      if (!word.empty()) {
        now_.words.push_back(word);
      }
      at = now_.text.find_first_not_of(kSpace, end);
    }
  }

  std::string_view text_;
  const std::filesystem::path& path_;
  std::size_t at_ = 0;
  Statement now_;
};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// As assimp reads them: with a decimal point or comma; and whatever a program writes for NaN and infinity.
bool is_number(std::string_view word) {
  const auto skip = [&](std::string_view any) {
    const bool found = !word.empty() && any.find(word[0]) != std::string_view::npos;
    word.remove_prefix(found ? 1 : 0);
    return found;
  };
  const auto skip_digits = [&] {
    const auto* end = std::ranges::find_if_not(word, is_digit);
    const auto count = static_cast<std::size_t>(end - word.begin());
    word.remove_prefix(count);
    return count;
  };
  skip("+-");
  if (const std::string_view start = word.substr(0, 3);
      start == "nan" || start == "NaN" || start == "NAN" || start == "inf" || start == "Inf" || start == "INF") {
    return true;
  }
  std::size_t digits = skip_digits();
  if (skip(".,")) {
    digits += skip_digits();
  }
  if (digits > 0 && skip("eE")) {
    skip("+-");
    digits = skip_digits();
  }
  return digits > 0 && word.empty();
}

void check_numbers(const Statements& statements) {
  const auto& words = statements.now().words;
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (!is_number(words[i])) {
      statements.fail(fmt::format("{} is not a number", shown(words[i])));
    }
  }
}

void check_vertex(const Statements& statements) {
  check_numbers(statements);
  const std::size_t count = statements.now().words.size() - 1;
  if (count != 3 && count != 4 && count != 6) {
    statements.fail("a vertex has 3 numbers, 4 with a weight or 6 with a colour");
  }
}

// assimp skips a vertex if one of its numbers begins with its point.
void add_with_leading_zeros(std::string_view numbers, std::string& mended) {
  char before = ' ';
  for (const char c : numbers) {
    if ((c == '.' || c == ',') && (before == ' ' || before == '\t')) {
      mended += '0';
    }
    mended += c;
    before = c;
  }
}

// A vertex, or one of its texture and its normal too: "1", "1/2", "1//3", "1/2/3".
void check_index(const Statements& statements, std::string_view word, long vertices, long vertices_before) {
  long index = 0;
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), index);
  const std::string_view rest(end, static_cast<std::size_t>(word.data() + word.size() - end));
  if (failure == std::errc::invalid_argument || (!rest.empty() && rest[0] != '/') ||
      rest.find_first_not_of("/-0123456789") != std::string_view::npos) {
    statements.fail(fmt::format("{} is not a number of a vertex", shown(word)));
  }
  const std::string_view number = word.substr(0, word.size() - rest.size());
  if (failure == std::errc() && index == 0) {
    statements.fail("there is no vertex 0, they count from 1");
  }
  if (number[0] == '-' && (failure != std::errc() || -index > vertices_before)) {
    statements.fail(fmt::format("there is no vertex {}, {} precede this", shown(number), vertices_before));
  }
  if (number[0] != '-' && (failure != std::errc() || index > vertices)) {
    statements.fail(fmt::format("there is no vertex {}, the file has {}", shown(number), vertices));
  }
}

}  // namespace

void check_material_count(std::size_t names, const std::filesystem::path& path) {
  constexpr std::size_t kMost = std::numeric_limits<std::uint16_t>::max() + 1;
  if (names > kMost) {
    throw Error(fmt::format("{}: more than {} material names", path.string(), kMost));
  }
}

std::string mend_obj(std::string_view text, const std::filesystem::path& path) {
  std::string mended;
  std::set<std::string_view> materials;
  mended.reserve(text.size() + text.size() / 16);
  for (Statements statements(text, path); statements.next();) {
    const Statement& now = statements.now();
    if (now.is_vertex()) {
      check_vertex(statements);
    }
    // assimp takes a minute for 120 000, and four times as long for twice as many.
    if (now.key() == "usemtl" && now.words.size() > 1 && materials.insert(now.words[1]).second) {
      check_material_count(materials.size(), path);
    }
    // assimp takes a comment behind indices for one of them.
    const std::string_view body = now.text.substr(0, now.is_indices() ? now.comment : now.text.size());
    if (now.is_numbers()) {
      add_with_leading_zeros(body, mended);
    } else {
      mended.append(body).append(body.size() < now.text.size() ? "\n" : "");
    }
  }
  return mended;
}

void check_obj_indices(std::string_view text, const std::filesystem::path& path) {
  long vertices = 0;
  for (Statements statements(text, path); statements.next();) {
    vertices += statements.now().is_vertex() ? 1 : 0;
  }
  long vertices_before = 0;
  for (Statements statements(text, path); statements.next();) {
    const Statement& now = statements.now();
    vertices_before += now.is_vertex() ? 1 : 0;
    if (now.key() == "vn") {
      check_numbers(statements);
    }
    for (std::size_t i = 1; now.is_indices() && i < now.words.size(); ++i) {
      check_index(statements, now.words[i], vertices, vertices_before);
    }
  }
}

}  // namespace insonify

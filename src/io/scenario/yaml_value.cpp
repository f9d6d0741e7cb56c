// yaml_value.cpp -- converts yaml-cpp's nodes to YamlValue, and YamlValue to text.

#include "io/scenario/yaml_value.h"

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>

#include "insonify/error.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

using Kind = YamlValue::Kind;
using Entry = YamlValue::Entry;

constexpr int kDeepest = 30;            // Levels of nesting; a scenario needs five.
constexpr int kMostValues = 1'000'000;  // Aliases can unfold a small text into a huge tree.

// Turns nodes into values.
class Converter {
 public:
  // @param base     The file, or the place of all values of a command-line setting.
  // @param is_file  Whether values have lines and columns of their own.
  Converter(Place base, bool is_file) : base_(std::move(base)), is_file_(is_file) {}

  Place place(const YAML::Mark& mark) const {
    return is_file_ ? Place{base_.file, mark.line + 1, mark.column + 1} : base_;
  }

  // `name` is how messages call the value, "" for the whole document.
  YamlValue convert(const YAML::Node& node, const std::string& name, int depth = 0) {
    YamlValue value;
    value.place = place(node.Mark());
    if (depth > kDeepest || ++count_ > kMostValues) {
      throw Error("nested too deeply, or unfolds into too many values").at(value.place);
    }
    if (node.IsScalar()) {
      value.kind = Kind::kScalar;
      value.scalar = node.Scalar();
      value.quoted = node.Tag() == "!";
    } else if (node.IsSequence()) {
      value.kind = Kind::kList;
      for (const YAML::Node& item : node) {
        value.items.push_back(convert(item, fmt::format("{}[{}]", name, value.items.size()), depth + 1));
      }
    } else if (node.IsMap()) {
      value.kind = Kind::kMap;
      convert_entries(node, name, depth, value);
    }
    return value;
  }

 private:
  void convert_entries(const YAML::Node& node, const std::string& name, int depth, YamlValue& map) {
    std::vector<YamlValue> bases;  // Maps that `<<` takes keys from.
    std::set<std::string> keys;
    for (const auto& entry : node) {
      const YAML::Node& key = entry.first;
      const Place key_place = place(key.Mark());
      if (!key.IsScalar()) {
        throw Error("a key must be a word").at(key_place);
      }
      const std::string entry_name = name.empty() ? key.Scalar() : fmt::format("{}.{}", name, key.Scalar());
      const bool merges = key.Scalar() == "<<" && key.Tag() != "!";  // Not in quotes.
      if (merges ? !bases.empty() : !keys.insert(key.Scalar()).second) {
        throw Error("", entry_name, " is given twice").at(key_place);
      }
      if (merges) {
        bases = bases_in(convert(entry.second, name, depth + 1), key_place);
        continue;
      }
      YamlValue value = convert(entry.second, entry_name, depth + 1);
      value.place = key_place;
      map.entries.push_back(Entry{key.Scalar(), std::move(value)});
    }
    for (YamlValue& base : bases) {
      for (Entry& entry : base.entries) {
        if (keys.insert(entry.key).second) {
          map.entries.push_back(std::move(entry));
        }
      }
    }
  }

  static std::vector<YamlValue> bases_in(YamlValue value, const Place& key_place) {
    std::vector<YamlValue> bases = value.kind == Kind::kList ? std::move(value.items) : std::vector{std::move(value)};
    const auto is_map = [](const YamlValue& base) { return base.kind == Kind::kMap; };
    if (bases.empty() || !std::ranges::all_of(bases, is_map)) {
      throw Error("<< must be a map of keys to take over, such as *name, or a list of such maps").at(key_place);
    }
    return bases;
  }

  Place base_;
  bool is_file_;
  int count_ = 0;
};

// Whether there is a tab in the indentation of a line, counted from 0.
bool tab_indents(std::string_view text, int line) {
  for (; line > 0 && !text.empty(); --line) {
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  }
  const std::string_view indentation = text.substr(0, text.find_first_not_of(" \t"));
  return indentation.find('\t') != std::string_view::npos;
}

// Where documents start, of the first three.
class DocumentStarts final : public YAML::EventHandler {
 public:
  std::vector<YAML::Mark> marks;

  void OnDocumentStart(const YAML::Mark& mark) override {
    marks.push_back(mark);
    at_start_ = true;
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { meet(mark); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { meet(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t, const std::string&) override { meet(mark); }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    meet(mark);
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    meet(mark);
  }
  void OnMapEnd() override {}

 private:
  // The first event of a document gives its start, after its dashes.
  void meet(const YAML::Mark& mark) {
    marks.back() = at_start_ ? mark : marks.back();
    at_start_ = false;
  }

  bool at_start_ = false;
};

// yaml-cpp 0.7's LoadAll() never ends where nothing that it knows starts a document, such as a comma: it finds empty
// documents there without end (github.com/jbeder/yaml-cpp/issues/1040).
std::vector<YAML::Mark> document_starts(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  DocumentStarts starts;
  while (starts.marks.size() < 3 && parser.HandleNextDocument(starts)) {
  }
  return starts.marks;
}

YamlValue parse(const std::string& text, const Place& base, bool is_file) {
  Converter converter(base, is_file);
  try {
    const std::vector<YAML::Mark> starts = document_starts(text);
    for (std::size_t next = 1; next < starts.size(); ++next) {
      if (starts[next].pos == starts[next - 1].pos) {
        throw Error("not valid YAML: nothing can start here").at(converter.place(starts[next]));
      }
    }
    if (starts.size() > 1) {
      throw Error("a second document starts here; one file holds one").at(converter.place(starts[1]));
    }
    YamlValue value = starts.empty() ? YamlValue() : converter.convert(YAML::Load(text), "");
    if (value.kind == Kind::kNothing) {
      value.place = converter.place({});  // yaml-cpp has no place for nothing.
    }
    return value;
  } catch (const YAML::Exception& error) {
    const YAML::Mark mark = error.mark.is_null() ? YAML::Mark() : error.mark;
    const bool too_deep = dynamic_cast<const YAML::DeepRecursion*>(&error) != nullptr;
    throw Error(fmt::format("not valid YAML: {}", tab_indents(text, mark.line) ? "indent with spaces, not with tabs"
                                                  : too_deep                   ? "nested too deeply"
                                                                               : error.msg))
        .at(converter.place(mark));
  }
}

void write(const YamlValue& value, YAML::Emitter& out) {
  switch (value.kind) {
    case Kind::kNothing:
      out << YAML::Null;
      return;
    case Kind::kScalar:
      if (value.quoted) {
        out << YAML::DoubleQuoted;
      }
      out << value.scalar;
      return;
    case Kind::kList: {
      const bool plain = std::ranges::all_of(value.items, [](const auto& item) { return item.kind == Kind::kScalar; });
      out << (plain ? YAML::Flow : YAML::Block) << YAML::BeginSeq;
      for (const YamlValue& item : value.items) {
        write(item, out);
      }
      out << YAML::EndSeq;
      return;
    }
    case Kind::kMap:
      out << YAML::BeginMap;
      for (const auto& [key, content] : value.entries) {
        out << YAML::Key;
        if (key.empty() || key == "<<") {
          out << YAML::DoubleQuoted;
        }
        out << key << YAML::Value;
        write(content, out);
      }
      out << YAML::EndMap;
      return;
  }
}

bool is_number(std::string_view text) {
  double ignored = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), ignored);
  return error != std::errc::invalid_argument && end == text.data() + text.size();
}

}  // namespace

const YamlValue* YamlValue::find(std::string_view key) const {
  const auto entry = std::ranges::find(entries, key, &Entry::key);
  return entry == entries.end() ? nullptr : &entry->value;
}

YamlValue* YamlValue::find(std::string_view key) {
  const auto entry = std::ranges::find(entries, key, &Entry::key);
  return entry == entries.end() ? nullptr : &entry->value;
}

std::string YamlValue::shown() const {
  switch (kind) {
    case Kind::kNothing:
      return "nothing";
    case Kind::kScalar:
      return !quoted && is_number(scalar) ? printable(scalar) : quoted_text(scalar);
    case Kind::kMap:
      return "{...}";
    case Kind::kList:
      break;
  }
  std::string text = "[";
  for (const YamlValue& item : items) {
    text += fmt::format("{}{}", text.size() > 1 ? ", " : "", item.shown());
  }
  return printable(text + "]");
}

YamlValue scalar(std::string text, bool quoted) {
  return {.kind = YamlValue::Kind::kScalar, .scalar = std::move(text), .quoted = quoted};
}

YamlValue parse_yaml(const std::string& text, const std::string& path) {
  return parse(text, {path}, true);
}

YamlValue parse_yaml_setting(const std::string& text, const Place& place) {
  return parse(text, place, false);
}

std::string write_yaml(const YamlValue& value) {
  YAML::Emitter out;
  write(value, out);
  return std::string(out.c_str()) + "\n";
}

std::string quoted_text(std::string_view text) {
  return fmt::format("\"{}\"", printable(text));
}

}  // namespace insonify

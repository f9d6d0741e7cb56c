// xml_scan.cpp -- one pass over an XML text, with a stack of open elements.

#include "io/file/xml_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "insonify/error.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

constexpr std::string_view kSpace = " \t\r\n";
constexpr std::string_view kEndOfName = " \t\r\n/>=";

// What is skipped whole, from its opening to its closing mark.
struct Skipped {
  std::string_view open, close, name;
};
constexpr std::array<Skipped, 4> kSkipped = {{{"<!--", "-->", "comment"},
                                              {"<![CDATA[", "]]>", "CDATA section"},
                                              {"<?", "?>", "declaration"},
                                              {"<!", ">", "declaration"}}};

constexpr std::array<std::pair<std::string_view, char>, 5> kEntities = {
    {{"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}}};

constexpr std::size_t kDeepest = 200;  // Elements inside each other; a scene needs a dozen.

std::string place(const std::string& path, int line, int column) {
  return fmt::format("{}:{}:{}: ", path, line, column);
}

class Scanner {
 public:
  Scanner(std::string_view text, const std::string& path) : text_(text), path_(path) {}

  std::vector<XmlTag> run() {
    while (move_to(text_.find('<', at_))) {
      if (skip_non_element()) {
        continue;
      }
      if (text_.substr(at_, 2) == "</") {
        close_element();
      } else {
        open_element();
      }
    }
    if (!open_.empty()) {
      fail(tags_[open_.back()], fmt::format("<{}> is never closed", printable(tags_[open_.back()].name)));
    }
    if (tags_.empty()) {
      fail("there is no XML element in this file");
    }
    return std::move(tags_);
  }

 private:
  [[noreturn]] void fail(const XmlTag& tag, const std::string& what) const { throw Error(tag.where(path_) + what); }
  [[noreturn]] void fail(const std::string& what) const { throw Error(place(path_, line_, column()) + what); }

  [[nodiscard]] int column() const { return static_cast<int>(at_ - line_start_) + 1; }

  // Goes on to an offset, counting lines. False at the end of the text.
  bool move_to(std::size_t offset) {
    const std::size_t target = std::min(offset, text_.size());
    for (; at_ < target; ++at_) {
      if (text_[at_] == '\n') {
        ++line_;
        line_start_ = at_ + 1;
      }
    }
    return offset != std::string_view::npos;
  }

  bool skip_non_element() {
    for (const Skipped& skipped : kSkipped) {
      if (text_.substr(at_, skipped.open.size()) == skipped.open) {
        const std::size_t end = text_.find(skipped.close, at_ + skipped.open.size());
        if (end == std::string_view::npos) {
          fail(fmt::format("this {} is never closed", skipped.name));
        }
        move_to(end + skipped.close.size());
        return true;
      }
    }
    return false;
  }

  void close_element() {
    const std::size_t end = text_.find('>', at_);
    const std::string_view name = text_.substr(at_ + 2, text_.find_first_of(kEndOfName, at_ + 2) - at_ - 2);
    if (end == std::string_view::npos) {
      fail(fmt::format("</{} is never closed", printable(name)));
    }
    if (open_.empty()) {
      fail(fmt::format("</{}> closes nothing", printable(name)));
    }
    XmlTag& tag = tags_[open_.back()];
    if (tag.name != name) {
      fail(fmt::format("</{}> stands where <{}> of line {} should be closed", printable(name), printable(tag.name),
                       tag.line));
    }
    tag.content_end = at_;
    tag.end = end + 1;
    open_.pop_back();
    move_to(tag.end);
  }

  void open_element() {
    XmlTag tag;
    tag.line = line_;
    tag.column = column();
    tag.begin = at_;
    tag.parent = open_.empty() ? -1 : open_.back();
    std::size_t at = std::min(text_.find_first_of(kEndOfName, at_), text_.size());
    tag.name = text_.substr(at_ + 1, at - at_ - 1);
    if (open_.size() >= kDeepest) {
      fail(fmt::format("<{}> is nested too deeply: more than {} elements are open", printable(tag.name), kDeepest));
    }
    if (tag.parent < 0 && !tags_.empty()) {
      fail(fmt::format("<{}> stands behind the end of <{}>", printable(tag.name), printable(tags_[0].name)));
    }
    bool closed = false;
    while (true) {
      at = text_.find_first_not_of(kSpace, at);
      if (at == std::string_view::npos) {
        fail(tag, fmt::format("the tag <{}> is never closed", printable(tag.name)));
      }
      if (text_[at] == '>') {
        break;
      }
      if (text_[at] == '/') {
        closed = true;
        ++at;
        continue;
      }
      at = read_attribute(at, tag);
    }
    move_to(at + 1);
    tag.content_begin = tag.content_end = tag.end = at_;
    tags_.push_back(std::move(tag));
    if (!closed) {
      open_.push_back(static_cast<int>(tags_.size()) - 1);
    }
  }

  // Reads name="value" and gives the offset behind it.
  std::size_t read_attribute(std::size_t at, XmlTag& tag) const {
    const std::size_t name_end = text_.find_first_of(kEndOfName, at);
    const std::size_t equals = text_.find_first_not_of(kSpace, name_end);
    const std::size_t quote = equals == std::string_view::npos || text_[equals] != '='
                                  ? std::string_view::npos
                                  : text_.find_first_not_of(kSpace, equals + 1);
    const bool quoted = quote != std::string_view::npos && (text_[quote] == '"' || text_[quote] == '\'');
    const std::size_t end = quoted ? text_.find(text_[quote], quote + 1) : std::string_view::npos;
    if (end == std::string_view::npos) {
      fail(tag, fmt::format("the tag <{}> has an attribute without a quoted value", printable(tag.name)));
    }
    tag.attributes[std::string(text_.substr(at, name_end - at))] = xml_decode(text_.substr(quote + 1, end - quote - 1));
    return end + 1;
  }

  std::string_view text_;
  const std::string& path_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
  std::vector<XmlTag> tags_;
  std::vector<int> open_;
};

}  // namespace

std::string XmlTag::where(const std::string& path) const {
  return place(path, line, column);
}

std::string XmlTag::attribute(const std::string& key) const {
  const auto found = attributes.find(key);
  return found == attributes.end() ? "" : found->second;
}

std::vector<XmlTag> scan_xml(std::string_view text, const std::string& path) {
  return Scanner(text, path).run();
}

std::string xml_decode(std::string_view content) {
  std::string decoded;
  for (std::size_t at = 0; at < content.size();) {
    const std::string_view rest = content.substr(at);
    if (rest.starts_with("<!--")) {
      at = std::min(content.find("-->", at), content.size() - 3) + 3;
    } else if (rest.starts_with("<![CDATA[")) {
      const std::size_t end = std::min(content.find("]]>", at), content.size());
      decoded += content.substr(at + 9, end - at - 9);
      at = std::min(end + 3, content.size());
    } else {
      const auto* entity = std::find_if(kEntities.begin(), kEntities.end(),
                                        [&](const auto& candidate) { return rest.starts_with(candidate.first); });
      decoded += entity == kEntities.end() ? rest[0] : entity->second;
      at += entity == kEntities.end() ? 1 : entity->first.size();
    }
  }
  const std::size_t first = decoded.find_first_not_of(kSpace);
  return first == std::string::npos ? "" : decoded.substr(first, decoded.find_last_not_of(kSpace) - first + 1);
}

std::string xml_encode(std::string_view text) {
  std::string encoded;
  for (const char c : text) {
    const auto* entity =
        std::find_if(kEntities.begin(), kEntities.end(), [&](const auto& candidate) { return candidate.second == c; });
    encoded += entity == kEntities.end() ? std::string_view(&c, 1) : entity->first;
  }
  return encoded;
}

}  // namespace insonify

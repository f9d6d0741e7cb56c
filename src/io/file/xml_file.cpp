// xml_file.cpp -- turns pugixml's byte offsets into lines and columns; refuses nesting that overflows other readers.

#include "io/file/xml_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/budgets.h"

namespace insonify {
namespace {

// Finds the first element that is nested too deeply.
struct DepthLimit : pugi::xml_tree_walker {
  bool for_each(pugi::xml_node& node) override {
    too_deep = depth() >= kDeepestXml && node.type() == pugi::node_element ? node : pugi::xml_node();
    return !too_deep;
  }
  pugi::xml_node too_deep;
};

// Elements and attributes, each of which takes much more memory than the few bytes that it may have in the file.
double count_nodes(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    const char next = text[i + 1];
    count += (text[i] == '<' && next != '/' && next != '!' && next != '?') ||
                     (text[i] == '=' && (next == '"' || next == '\''))
                 ? 1
                 : 0;
  }
  return static_cast<double>(count);
}

}  // namespace

XmlFile::XmlFile(std::string_view text, std::string shown) : shown_(std::move(shown)), line_starts_{0} {
  nodes_ = count_nodes(text);
  check_budget(Budget::kNodes, nodes_, shown_);
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n', end + 1)) {
    line_starts_.push_back(end + 1);
  }
  const auto refuse = [this](const Place& place, const std::string& reason) { throw Error(reason).at(place); };
  // Bytes are read as UTF-8 regardless of the declaration, so that offsets are those of the file.
  const pugi::xml_parse_result result =
      document_.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  if (result.status == pugi::status_no_document_element) {
    refuse({shown_, 1, 1}, "there is no XML element in this file");
  }
  if (!result) {
    const std::string reason = result.status == pugi::status_end_element_mismatch
                                   ? "an element is not closed, or closed twice"
                                   : result.description();
    refuse(place_of(result.offset), "not valid XML: " + reason);
  }
  for (pugi::xml_node second = root().next_sibling(); second; second = second.next_sibling()) {
    if (second.type() == pugi::node_element) {
      throw Error(fmt::format("{}<{}> follows the end of <{}>", where(second), printable(second.name()),
                              printable(root().name())));
    }
  }
  DepthLimit limit;
  document_.traverse(limit);
  if (limit.too_deep) {
    throw Error(fmt::format("{}<{}> is nested too deeply: more than {} elements are open", where(limit.too_deep),
                            printable(limit.too_deep.name()), kDeepestXml));
  }
}

Place XmlFile::place_of(std::ptrdiff_t offset) const {
  const auto next =
      std::ranges::upper_bound(line_starts_, static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
  return {shown_, static_cast<int>(next - line_starts_.begin()),
          static_cast<int>(offset - static_cast<std::ptrdiff_t>(*std::prev(next))) + 1};
}

Place XmlFile::place(pugi::xml_node element) const {
  const std::ptrdiff_t name = element.offset_debug();
  return name < 0 ? Place{shown_} : place_of(name - 1);  // '<' comes just before the name.
}

int XmlFile::line_of(pugi::xml_node element) const {
  const std::ptrdiff_t name = element.offset_debug();
  return name < 0 ? 0 : place_of(name - 1).line;
}

std::string without_outer_space(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t first = std::min(text.find_first_not_of(kSpace), text.size());
  return std::string(text.substr(first, text.find_last_not_of(kSpace) + 1 - first));
}

std::string xml_text(pugi::xml_node element) {
  std::string text;
  for (const pugi::xml_node part : element) {
    text += part.type() == pugi::node_pcdata || part.type() == pugi::node_cdata ? part.value() : "";
  }
  return without_outer_space(text);
}

}  // namespace insonify

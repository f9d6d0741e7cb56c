// xml_file.h -- an XML file, parsed by pugixml, whose elements know their line and column.

#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/error.h"

namespace insonify {

/// Largest depth of nested elements; a scene needs a dozen. Recursive readers overflow the stack on more.
inline constexpr int kDeepestXml = 200;

class XmlFile {
 public:
  /// @param text   In UTF-8, see xml_in_utf8().
  /// @param shown  The file name in messages.
  /// @throws Error "path:line:column: ..." for a text that is not well-formed, has no element or more than one at its
  /// root, or is nested deeper than kDeepestXml; and for more elements and attributes than Budget::kNodes.
  XmlFile(std::string_view text, std::string shown);

  [[nodiscard]] pugi::xml_node root() const { return document_.document_element(); }

  /// Number of its elements and attributes.
  [[nodiscard]] double nodes() const { return nodes_; }

  /// Place of an element's '<', columns in bytes; without a line for one that was added later.
  [[nodiscard]] Place place(pugi::xml_node element) const;

  /// The same as a prefix of messages: "path:line:column: ".
  [[nodiscard]] std::string where(pugi::xml_node element) const { return place(element).text(); }

  /// Line of an element's '<', from 1; 0 for one that was added later.
  [[nodiscard]] int line_of(pugi::xml_node element) const;

 private:
  [[nodiscard]] Place place_of(std::ptrdiff_t offset) const;

  std::string shown_;
  double nodes_ = 0;
  std::vector<std::size_t> line_starts_;  // Offsets into the text.
  pugi::xml_document document_;
};

/// The text of an XML file in UTF-8: converted from UTF-16 or the encoding that it declares, without its declaration's
/// encoding. Bytes that are not text in that encoding become escapes: "t\xe9".
[[nodiscard]] std::string xml_in_utf8(std::string text);

[[nodiscard]] std::string without_outer_space(std::string_view text);

/// Text directly inside an element, without white space at both ends.
[[nodiscard]] std::string xml_text(pugi::xml_node element);

}  // namespace insonify

// xml_scan.h -- finds the tags of an XML text and where they stand, so that parts can be replaced without moving a
// line.

#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace insonify {

/// One element. Offsets are into the text that was scanned.
struct XmlTag {
  std::string name;
  std::map<std::string, std::string> attributes;
  int line = 1, column = 1;       ///< Of its '<', from 1; columns count bytes.
  int parent = -1;                ///< Index into the list of tags; -1 for the root.
  std::size_t begin = 0;          ///< Of its '<'.
  std::size_t content_begin = 0;  ///< Behind the opening tag.
  std::size_t content_end = 0;    ///< Before the closing tag; content_begin for <a/>.
  std::size_t end = 0;            ///< Behind all of it.

  /// "path:line:column: "
  [[nodiscard]] std::string where(const std::string& path) const;
  /// "" for one that is not there.
  [[nodiscard]] std::string attribute(const std::string& name) const;
};

/// All elements in the order in which they open. Comments, CDATA, declarations and text are skipped.
/// @param path  For messages.
/// @throws Error "path:line:column: ..." where tags do not match, are nested without end or something is not closed.
[[nodiscard]] std::vector<XmlTag> scan_xml(std::string_view text, const std::string& path);

/// What an element's content says: without comments, entities resolved, white space at both ends removed.
[[nodiscard]] std::string xml_decode(std::string_view content);

/// Text as it must be written into XML.
[[nodiscard]] std::string xml_encode(std::string_view text);

}  // namespace insonify

// sdf_check.h -- faults of an SDF file that libsdformat lets pass, or tells without their place.

#pragma once

#include <string>
#include <vector>

#include "io/file/xml_scan.h"

namespace insonify {

/// Checks one element: numbers of shapes and poses, parts of includes, links of a model, and its name beside those of
/// its equals. The children of `tags` come after their parents.
/// @param shown  The file as messages name it.
/// @throws Error "path:line:column: ..."
void check_sdf_tag(const std::vector<XmlTag>& tags, std::size_t tag, const std::string& text, const std::string& shown);

/// What an element contains, as text.
[[nodiscard]] std::string content_of(const XmlTag& tag, const std::string& text);

}  // namespace insonify

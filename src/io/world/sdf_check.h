// sdf_check.h -- faults of an SDF file that libsdformat lets pass, or tells without their place.

#pragma once

#include "io/file/xml_file.h"

namespace insonify {

/// Checks one element: numbers of shapes and poses, parts of includes, links of a model, and its name beside those of
/// its siblings.
/// @throws Error "path:line:column: ..."
void check_sdf_element(const XmlFile& file, pugi::xml_node element);

}  // namespace insonify

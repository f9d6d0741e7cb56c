// sdf_check.h -- finds faults of an SDF file that libsdformat accepts, or reports without their place.

#pragma once

#include "insonify/log.h"
#include "io/file/xml_file.h"

namespace insonify {

/// Checks one element: the numbers of shapes and poses, the parts of an include, that a model has a link, and that no
/// earlier sibling of the same kind has its name.
/// @throws Error "path:line:column: ..."
void check_sdf_element(const XmlFile& file, pugi::xml_node element);

/// @param log  Receives warnings about versions other than 1.4 to 1.9, which are still read.
/// @throws Error for a root element other than <sdf>, and for a version that is missing or not two numbers.
void check_sdf_version(const XmlFile& file, const Log& log);

}  // namespace insonify

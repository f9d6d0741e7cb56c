// sdf_version.h -- checks that a file is SDF of a supported version.

#pragma once

#include "insonify/log.h"
#include "io/file/xml_file.h"

namespace insonify {

/// @param log  Receives warnings about versions other than 1.4 to 1.9, which are still read.
/// @throws Error for a root element other than <sdf>, and for a version that is missing or not two numbers.
void check_sdf_version(const XmlFile& file, const Log& log);

}  // namespace insonify

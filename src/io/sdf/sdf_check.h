// sdf_check.h -- finds faults of an SDF file that libsdformat accepts, or reports without their place.

#pragma once

#include "insonify/error.h"
#include "insonify/log.h"
#include "io/file/xml_file.h"

namespace insonify {

/// A fault of one element, without which the file may be read.
class SdfFault : public Error {
 public:
  /// @param element  The element at fault; none if it is not known.
  SdfFault(const std::string& message, const XmlFile& file, pugi::xml_node element);

  /// "path:line:column: " of what is to be left out: the element, or the visual, link or model whose shape or place it
  /// says; "" if there is none.
  std::string place_to_leave_out;
};

/// Checks one element: the numbers of shapes and poses, the parts of an include, that a model has a link, and that no
/// earlier sibling of the same kind has its name.
/// @throws SdfFault "path:line:column: ..."
void check_sdf_element(const XmlFile& file, pugi::xml_node element);

/// Warns of a pose that turns by more than three times around, which is likely in degrees.
void warn_of_sdf_turn(const XmlFile& file, pugi::xml_node element, const Log& log);

/// Gives a pose with too few numbers those that are missing, and warns of it. Returns whether it did.
[[nodiscard]] bool complete_sdf_pose(const XmlFile& file, pugi::xml_node element, const Log& log);

/// @param log  Receives warnings about versions other than 1.4 to 1.9, which are still read.
/// @throws Error for a root element other than <sdf>, and for a version that is missing or not two numbers.
void check_sdf_version(const XmlFile& file, const Log& log);

}  // namespace insonify

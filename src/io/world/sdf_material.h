// sdf_material.h -- the acoustic material that a visual, a collision, a link or a model of an SDF file is said to be
// of.

#pragma once

#include <sdf/Element.hh>
#include <string>

namespace insonify {

/// Material named by <insonify:material>steel</insonify:material>, or by <material>steel</material> in
/// <plugin name="insonify" filename="...">, directly inside `element`; "" when there is none.
/// @param what  "path:line:column: visual 'a::b'", for messages.
/// @throws Error for two names, an empty one, and for elements of ours that do not exist.
[[nodiscard]] std::string sdf_material(const sdf::ElementPtr& element, const std::string& what);

}  // namespace insonify

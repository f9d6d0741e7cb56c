// sdf_material.h -- reads the acoustic material of a visual, a collision, a link or a model in SDF.

#pragma once

#include <sdf/Element.hh>
#include <string>

namespace insonify {

/// Material named by <insonify:material>steel</insonify:material>, or by <material>steel</material> in
/// <plugin name="insonify" filename="...">, directly inside `element`; "" when there is none.
/// @param what  "path:line:column: visual 'a::b'", for messages.
/// @throws Error for two different names, an empty one, and for unknown elements with insonify's prefix.
[[nodiscard]] std::string sdf_material(const sdf::ElementPtr& element, const std::string& what);

}  // namespace insonify

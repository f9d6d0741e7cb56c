// sdf_material.h -- insonify's own elements in SDF, which libsdformat passes on unchanged; the acoustic material of a
// visual, a collision, a link or a model.

#pragma once

#include <sdf/Element.hh>
#include <string>
#include <vector>

#include "insonify/error.h"

namespace insonify {

/// A fault in insonify's own elements: always an error, as those are the user's.
class InsonifyElementError : public Error {
 public:
  using Error::Error;
};

/// One of insonify's elements.
struct InsonifyElement {
  sdf::ElementPtr element;
  std::string name;  ///< Without the prefix "insonify:".
};

/// Those directly inside `holder`, <insonify:NAME>, and those in its <plugin name="insonify" filename="...">, <NAME>.
[[nodiscard]] std::vector<InsonifyElement> insonify_elements(const sdf::ElementPtr& holder);

/// A name without the prefix "insonify:".
[[nodiscard]] std::string without_sdf_prefix(const std::string& name);

/// The text of an element; "" if there is none.
[[nodiscard]] std::string sdf_text(const sdf::ElementPtr& element);

/// Material named by <insonify:material>steel</insonify:material>, or by <material>steel</material> in the plugin,
/// directly inside `element`; "" when there is none.
/// @param what  "path:line:column: visual 'a::b'", for messages.
/// @throws InsonifyElementError for two different names, an empty one, and for unknown elements of insonify's.
[[nodiscard]] std::string sdf_material(const sdf::ElementPtr& element, const std::string& what);

}  // namespace insonify

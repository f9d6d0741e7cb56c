// sdf_portions.h -- divides the world of a file: libsdformat takes a megabyte for each link, visual and collision.

#pragma once

#include <functional>
#include <pugixml.hpp>
#include <string>
#include <vector>

namespace insonify {

/// A file with some of the models of its world.
struct SdfPortion {
  std::string text;                      ///< "" for the whole file.
  std::vector<pugi::xml_node> elements;  ///< The file's elements in the text, in document order.
};

/// The only world of a file, if nothing in it refers to another model: no joint, no frame, no relative pose. Else null.
[[nodiscard]] pugi::xml_node independent_sdf_world(pugi::xml_node root);

/// Whether an element in a world is a model, in place or included.
[[nodiscard]] bool is_sdf_model(pugi::xml_node node);

/// The whole file.
[[nodiscard]] SdfPortion whole_sdf(pugi::xml_node root);

/// Portions with a hundred or so elements each that take memory, in the order of the file. What is not a model is in
/// the first. Files whose models are not independent are one portion.
/// @param weight  Number of such elements in a model, those in included files too.
[[nodiscard]] std::vector<SdfPortion> sdf_portions(pugi::xml_node root,
                                                   const std::function<std::size_t(pugi::xml_node)>& weight);

}  // namespace insonify

// sdf_twins.h -- models of a world that differ only in name and pose: libsdformat takes milliseconds for each.

#pragma once

#include <pugixml.hpp>
#include <string>
#include <vector>

#include "insonify/geometry.h"

namespace insonify {

/// A model equal to an earlier one but for its name and pose.
struct SdfTwin {
  std::string name;
  Pose pose;           ///< In the world.
  std::size_t first;   ///< Index of the equal model among those that are left.
  std::size_t before;  ///< Number of models that are left before this one.
};

struct SdfTwins {
  std::vector<SdfTwin> twins = {};  ///< In the order of the file.
  std::size_t left = 0;             ///< Number of models and includes that are left in the world.
};

/// Takes twins out of the world of a file, if it is an independent_sdf_world().
[[nodiscard]] SdfTwins take_out_sdf_twins(pugi::xml_node root);

}  // namespace insonify

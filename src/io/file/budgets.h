// budgets.h -- how much a file may ask for: defaults, and the environment variable that changes them.

#pragma once

#include <string>
#include <string_view>

namespace insonify {

/// What is counted. Names in INSONIFY_LIMITS, such as "triangles=1e8 memory=3e10", and defaults:
enum class Budget {
  kBytes,      ///< bytes: of a file that is read whole: 4e9.
  kPixels,     ///< pixels: of a picture, points of a height grid: 1e8.
  kNodes,      ///< nodes: elements and attributes of an XML file, with the files that it includes: 2e6.
  kInstances,  ///< instances: nodes of a mesh file that stand at their places, objects of a world: 1e5.
  kTriangles,  ///< triangles: of a mesh, or a third of its vertices: 5e7.
  kMemory,     ///< memory: of a reader, and of what libsdformat reads [bytes]: half of the machine's, at most 1.6e10.
  kSeconds,    ///< seconds: processor time of a reader for a file [s]: 60.
};

/// @throws Error for an INSONIFY_LIMITS that is not made of such words.
[[nodiscard]] double budget(Budget which);

/// @param path   Of the file, for messages.
/// @param count  How much it asks for.
/// @throws Error "PATH: has 900000000 pixels, more than 100000000; for a file that you trust:
///         INSONIFY_LIMITS=pixels=900000000".
void check_budget(Budget which, double count, std::string_view path);

}  // namespace insonify

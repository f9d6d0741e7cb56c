// ply_body.h -- reads the numbers of PLY elements, from text or binary.

#pragma once

#include <fstream>
#include <memory>
#include <vector>

#include "io/mesh/ply_header.h"

namespace insonify {

class PlyBody {
 public:
  virtual ~PlyBody() = default;

  /// Reads the next element: the numbers of each property. Returns false if the file ends before its end.
  /// @throws Error "PATH:LINE: ..." for a line of a text with too few numbers, or with a word that is none.
  [[nodiscard]] virtual bool read(const PlyElement& element, std::vector<std::vector<double>>& values) = 0;
};

/// @throws Error for an unknown format.
[[nodiscard]] std::unique_ptr<PlyBody> make_ply_body(std::ifstream& file, const PlyHeader& header,
                                                     const std::filesystem::path& path);

}  // namespace insonify

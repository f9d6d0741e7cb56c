// gltf_file.h -- a glTF 2.0 file: its JSON, its buffers, and the numbers of its accessors.

#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace insonify {

/// A .gltf file, or the two chunks of a .glb file.
class GltfFile {
 public:
  /// @throws Error "PATH:LINE:COLUMN: not valid JSON", or "PATH: ..." for a GLB that is not whole.
  explicit GltfFile(const std::filesystem::path& path);

  nlohmann::json json;

  /// A list at the root; made, and empty, if there is none.
  [[nodiscard]] nlohmann::json& list(const char* name);

  /// The bytes of a buffer: a file, data in its URI, or the binary chunk of a GLB.
  [[nodiscard]] const std::string& buffer(std::size_t index);

  /// Numbers of an accessor as single-precision values, count x components: of any component type, normalised,
  /// strided or sparse.
  /// @throws Error for one that does not exist, or leads out of its buffer, and if they are more in all than nine for
  ///         each of Budget::kTriangles.
  [[nodiscard]] std::vector<float> numbers(std::size_t accessor);

  /// Element `index` of a list at the root.
  /// @throws Error if there is none.
  [[nodiscard]] const nlohmann::json& at(const char* list, std::size_t index) const;

  /// A whole number of an object, not negative.
  /// @throws Error for another value, or one that is missing and has no default.
  [[nodiscard]] std::size_t whole(const nlohmann::json& object, const char* key, long otherwise = -1) const;

 private:
  // Where elements lie in a buffer.
  struct Layout {
    std::size_t view = 0, offset = 0;
    int component_type = 0;
    std::size_t components = 1, count = 0;
    bool normalized = false;
  };

  void read_glb(const std::string& text);
  [[nodiscard]] std::vector<float> numbers(const Layout& layout);
  [[noreturn]] void fail(const std::string& reason) const;

  std::filesystem::path path_;
  std::string chunk_;
  double numbers_ = 0;  // Converted so far.
  std::map<std::size_t, std::string> buffers_;
};

/// Triangles of a primitive, by the count of its corners; 0 for points and lines.
[[nodiscard]] std::size_t triangle_count(const GltfFile& file, const nlohmann::json& primitive);

/// @throws Error if the nodes, once unfolded, or their meshes exceed a Budget, or if a node is within itself.
void check_gltf_nodes(GltfFile& file, const std::filesystem::path& path);

}  // namespace insonify

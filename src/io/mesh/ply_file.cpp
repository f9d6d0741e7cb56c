// ply_file.cpp -- makes a mesh of the elements of a PLY file.

#include "io/mesh/ply_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/mesh/ply_body.h"
#include "io/mesh/triangulate.h"

namespace insonify {
namespace {

constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

// Indices of the properties that hold a vector; empty if one of them is missing.
using Indices = std::vector<int>;
Indices indices_of(const PlyElement& element, std::initializer_list<std::initializer_list<std::string_view>> names) {
  Indices found;
  for (const auto& alternatives : names) {
    found.push_back(element.index_of(alternatives));
  }
  return std::ranges::count(found, -1) > 0 ? Indices() : found;
}

using Values = std::vector<std::vector<double>>;  // [property][number] Numbers of an element.

float number(const Values& values, int property) {
  const std::vector<double>& numbers = values[static_cast<std::size_t>(property)];
  return numbers.empty() ? NAN : static_cast<float>(numbers.front());
}

Vec3f vector_of(const Values& values, const Indices& indices) {
  return indices.empty() ? Vec3f::Zero()
                         : Vec3f(number(values, indices[0]), number(values, indices[1]), number(values, indices[2]));
}

// Collects vertices and corners of faces, and makes triangles of them at the end: faces may come first.
class PlyMesh {
 public:
  void add_elements(const PlyElement& element, const std::string& where, PlyBody& body) {
    const bool is_vertex = element.name == "vertex", is_strip = element.name == "tristrips";
    const Indices position = indices_of(element, {{"x"}, {"y"}, {"z"}});
    const Indices normal = indices_of(element, {{"nx"}, {"ny"}, {"nz"}});
    const Indices texture = indices_of(element, {{"s", "u", "tx", "texture_u"}, {"t", "v", "ty", "texture_v"}});
    const int corners = element.index_of({"vertex_indices", "vertex_index"});
    if (is_vertex && position.empty()) {
      throw Error(where + " has no properties x, y and z");
    }
    Values values(element.properties.size());
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (!body.read(element, values)) {
        throw Error(fmt::format("{}: the file ends after {}", where, i));
      }
      if (is_vertex) {
        made_.mesh.vertices.push_back(vector_of(values, position));
        made_.mesh.normals.push_back(vector_of(values, normal));
        if (!texture.empty()) {
          textures_.emplace_back(number(values, texture[0]), number(values, texture[1]));
        }
      } else if (corners >= 0 && is_strip) {
        add_strips(values[static_cast<std::size_t>(corners)]);
      } else if (corners >= 0 && element.name == "face") {
        const std::vector<double>& face = values[static_cast<std::size_t>(corners)];
        corners_.insert(corners_.end(), face.begin(), face.end());
        face_ends_.push_back(corners_.size());
      }
    }
  }

  FlattenedScene take() {
    std::size_t begin = 0;
    for (const std::size_t end : face_ends_) {
      add_face(std::span(corners_).subspan(begin, end - begin));
      begin = end;
    }
    made_.mesh.material_names = {""};
    return std::move(made_);
  }

 private:
  // Strips follow each other after -1. Every other triangle winds the other way; those with a corner twice only lead
  // on.
  void add_strips(const std::vector<double>& strip) {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < strip.size(); ++i) {
      if (strip[i] < 0) {
        begin = i + 1;
      } else if (i >= begin + 2 && strip[i] != strip[i - 1] && strip[i - 1] != strip[i - 2] &&
                 strip[i] != strip[i - 2]) {
        const bool is_even = (i - begin) % 2 == 0;
        corners_.insert(corners_.end(), {strip[is_even ? i - 2 : i - 1], strip[is_even ? i - 1 : i - 2], strip[i]});
        face_ends_.push_back(corners_.size());
      }
    }
  }

  [[nodiscard]] std::uint32_t vertex(double index) const {
    return index >= 0 && index < static_cast<double>(made_.mesh.vertices.size()) ? static_cast<std::uint32_t>(index)
                                                                                 : kNoVertex;
  }

  [[nodiscard]] Eigen::Vector2f texture_at(std::uint32_t vertex) const {
    return vertex < textures_.size() && textures_[vertex].allFinite() ? textures_[vertex]
                                                                      : Eigen::Vector2f(Eigen::Vector2f::Zero());
  }

  void add_face(std::span<const double> face) {
    if (face.size() < 3) {
      ++made_.lines_and_points;
      return;
    }
    places_.clear();
    for (const double index : face) {
      const std::uint32_t at = vertex(index);
      places_.push_back(at == kNoVertex ? Vec3f(Vec3f::Zero()) : made_.mesh.vertices[at]);
    }
    triangulate(places_, cut_);
    for (const auto& [a, b, c] : cut_) {
      const std::array<std::uint32_t, 3> triangle = {vertex(face[a]), vertex(face[b]), vertex(face[c])};
      made_.mesh.triangles.push_back(triangle);
      if (!textures_.empty()) {
        made_.mesh.texture_coordinates.push_back(
            {texture_at(triangle[0]), texture_at(triangle[1]), texture_at(triangle[2])});
      }
    }
  }

  FlattenedScene made_;
  std::vector<Eigen::Vector2f> textures_;          // [vertex] Texture coordinates.
  std::vector<double> corners_;                    // Vertices of all faces, as in the file,
  std::vector<std::size_t> face_ends_;             // and where each ends.
  std::vector<Vec3f> places_;                      // Corners of the present face,
  std::vector<std::array<std::uint32_t, 3>> cut_;  // and its triangles.
};

}  // namespace

FlattenedScene read_ply(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const PlyHeader header = read_ply_header(file, path);
  const std::unique_ptr<PlyBody> body = make_ply_body(file, header, path);
  PlyMesh mesh;
  for (const PlyElement& element : header.elements) {
    const std::string where = fmt::format("{}:{}: element {} {}", path.string(), element.line, printable(element.name),
                                          printable(element.count_as_written));
    if (element.count > 0 && element.properties.empty()) {
      throw Error(where + " has no properties");
    }
    mesh.add_elements(element, where, *body);
  }
  return mesh.take();
}

}  // namespace insonify

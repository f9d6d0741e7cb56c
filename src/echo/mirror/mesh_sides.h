// mesh_sides.h -- which triangles of a mesh share a side, however its corners are listed and its sides are divided.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "insonify/mesh.h"

namespace insonify {

/// [vertex] Number of each vertex of a mesh: same_places() within same_place_tolerance().
[[nodiscard]] std::vector<std::uint32_t> welded_vertices(const Mesh& mesh, Workers& workers);

/// The sides of all triangles, sorted by their ends. Side 3 t + k runs from vertex k of triangle t to the next. Corners
/// within same_place_tolerance() are one (scene/same_places.h). Where corners of other triangles lie on a side that no
/// other triangle has (T-junctions), its parts between them take its place, with numbers from 3 times the number of
/// triangles on. Sides both of whose ends are one corner are left out. Takes 12 bytes a triangle and 8 a vertex.
class MeshSides {
 public:
  MeshSides(const Mesh& mesh, Workers& workers);

  /// Ends of a side, by their numbers(); the lower first.
  struct Ends {
    std::uint32_t low, high;
    auto operator<=>(const Ends&) const = default;  // NOLINT(modernize-use-nullptr): there is none.
  };
  [[nodiscard]] Ends ends(std::uint32_t side) const;
  [[nodiscard]] bool runs_upwards(std::uint32_t side) const;  ///< From the lower of its ends to the higher.
  [[nodiscard]] std::uint32_t triangle(std::uint32_t side) const { return whole(side) / 3; }
  [[nodiscard]] std::uint32_t opposite(std::uint32_t side) const;  ///< Vertex of its triangle that is not on it.
  [[nodiscard]] std::uint32_t whole(std::uint32_t side) const {  ///< The side that a part is of; else the side itself.
    const auto first = static_cast<std::uint32_t>(3 * mesh_.triangles.size());
    return side < first ? side : parts_[side - first].side;
  }
  [[nodiscard]] std::uint32_t count() const {  ///< One more than the highest number of a side.
    return static_cast<std::uint32_t>(3 * mesh_.triangles.size() + parts_.size());
  }
  [[nodiscard]] bool has_corners(std::uint32_t triangle) const;  ///< Whether a triangle has three different ones.

  [[nodiscard]] const std::vector<std::uint32_t>& numbers() const { return numbers_; }  ///< [vertex] welded_vertices().

  /// Calls visit(sides) for each pair of ends at which the lower one is in [first, last), in order; `sides` are in
  /// order.
  template <typename Visit>
  void for_each_edge(std::size_t first, std::size_t last, const Visit& visit) const {
    for (std::size_t vertex = first; vertex < last; ++vertex) {
      const std::span<const std::uint32_t> sides = from(vertex);
      for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
        const std::uint32_t high = ends(sides[begin]).high;
        while (end < sides.size() && ends(sides[end]).high == high) {
          ++end;
        }
        visit(sides.subspan(begin, end - begin));
      }
    }
  }
  [[nodiscard]] std::size_t vertex_count() const { return numbers_.size(); }

 private:
  // Part of a side that corners of other triangles divide.
  struct Part {
    std::uint32_t from, to, side;
  };

  [[nodiscard]] std::span<const std::uint32_t> from(std::size_t vertex) const {
    const std::uint32_t begin = vertex == 0 ? 0 : ends_[vertex - 1];
    return {sides_.data() + begin, ends_[vertex] - begin};
  }
  void sort_sides(Workers& workers);
  [[nodiscard]] std::vector<std::uint32_t> open_sides(Workers& workers) const;
  void divide_sides(Workers& workers);

  const Mesh& mesh_;
  std::vector<std::uint32_t> numbers_;
  std::vector<Part> parts_;            // By side.
  std::vector<std::uint8_t> divided_;  // [side] 1 for those that parts replace; empty: none.
  std::vector<std::uint32_t> ends_;    // [vertex] End in `sides_` of the sides whose lower end it is.
  std::vector<std::uint32_t> sides_;   // By lower end, higher end and number.
};

}  // namespace insonify

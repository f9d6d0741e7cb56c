// mesh_sides.h -- which triangles of a mesh share a side, though its vertices may be listed more than once.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "insonify/mesh.h"

namespace insonify {

/// [vertex] Number of each vertex of a mesh: the lowest index of those at the same position.
[[nodiscard]] std::vector<std::uint32_t> welded_vertices(const Mesh& mesh, Workers& workers);

/// The sides of all triangles, sorted by their ends. Side 3 t + k runs from vertex k of triangle t to the next. Sides
/// both of whose ends are at one position are left out. Takes 12 bytes a triangle and 8 a vertex.
class MeshSides {
 public:
  MeshSides(const Mesh& mesh, Workers& workers);

  /// Ends of a side, by numbers of welded_vertices(); the lower first.
  struct Ends {
    std::uint32_t low, high;
    auto operator<=>(const Ends&) const = default;
  };
  [[nodiscard]] Ends ends(std::uint32_t side) const;
  [[nodiscard]] bool runs_upwards(std::uint32_t side) const;  ///< From the lower of its ends to the higher.

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
  [[nodiscard]] std::span<const std::uint32_t> from(std::size_t vertex) const {
    const std::uint32_t begin = vertex == 0 ? 0 : ends_[vertex - 1];
    return {sides_.data() + begin, ends_[vertex] - begin};
  }

  const Mesh& mesh_;
  std::vector<std::uint32_t> numbers_;
  std::vector<std::uint32_t> ends_;   // [vertex] End in `sides_` of the sides whose lower end it is.
  std::vector<std::uint32_t> sides_;  // By lower end, higher end and number.
};

}  // namespace insonify

// point_tree.cpp -- builds the tree by medians, and clips lines to its parts.

#include "echo/mirror/point_tree.h"

#include <algorithm>

namespace insonify {

// A line from one place to another.
struct PointTree::Line {
  std::uint32_t from, to;
  Vec3 start, step;
  double reach;
};

PointTree::PointTree(const std::vector<Vec3f>& places, std::vector<std::uint32_t> points)
    : places_(places), points_(std::move(points)) {
  divide(0, points_.size(), 0);
}

void PointTree::divide(std::size_t first, std::size_t last, int axis) {
  if (last - first < 2) {
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(middle), at(last),
                   [&](std::uint32_t a, std::uint32_t b) { return places_[a][axis] < places_[b][axis]; });
  divide(first, middle, (axis + 1) % 3);
  divide(middle + 1, last, (axis + 1) % 3);
}

// @param begin, end  Shares of the line that may be within reach of the part.
void PointTree::visit(const Line& line, std::size_t first, std::size_t last, int axis, double begin, double end,
                      std::vector<std::pair<double, std::uint32_t>>& found) const {
  if (first == last || begin > end) {
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  const std::uint32_t point = points_[middle];
  const Vec3 place = places_[point].cast<double>(), from = place - line.start;
  const double share = from.dot(line.step) / line.step.squaredNorm();
  if (share > 0 && share < 1 && point != line.from && point != line.to &&
      (from - share * line.step).norm() <= line.reach) {
    found.emplace_back(share, point);
  }
  // The shares of the line below the dividing plane, and above it.
  const double step = line.step[axis], off = place[axis] - line.start[axis];
  double below_begin = begin, below_end = end, above_begin = begin, above_end = end;
  if (step > 0) {
    below_end = std::min(end, (off + line.reach) / step);
    above_begin = std::max(begin, (off - line.reach) / step);
  } else if (step < 0) {
    below_begin = std::max(begin, (off + line.reach) / step);
    above_end = std::min(end, (off - line.reach) / step);
  } else if (off > line.reach) {
    above_begin = 2;
  } else if (off < -line.reach) {
    below_begin = 2;
  }
  visit(line, first, middle, (axis + 1) % 3, below_begin, below_end, found);
  visit(line, middle + 1, last, (axis + 1) % 3, above_begin, above_end, found);
}

void PointTree::find_between(std::uint32_t from, std::uint32_t to, double reach,
                             std::vector<std::pair<double, std::uint32_t>>& found) const {
  const Vec3 start = places_[from].cast<double>(), step = places_[to].cast<double>() - start;
  found.clear();
  if (step.squaredNorm() > 0) {
    visit({from, to, start, step, reach}, 0, points_.size(), 0, 0, 1, found);
  }
  std::ranges::sort(found);
}

}  // namespace insonify

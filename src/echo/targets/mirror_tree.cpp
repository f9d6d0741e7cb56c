// mirror_tree.cpp -- builds the hierarchy by medians.

#include "echo/targets/mirror_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace insonify {
namespace {

constexpr std::uint32_t kLeaf = 4;  // Most items of a leaf.

// Box of a triangle whose sides are moved outwards. Its corners move away from the centre of its inscribed circle, in
// proportion to their distance.
MirrorBox box_of(const PlaneMirror::Triangle& triangle, double margin, double reach) {
  const auto& [a, b, c] = triangle.corners;
  const double perimeter = (b - a).norm() + (c - b).norm() + (a - c).norm();
  const double radius = (b - a).cross(c - a).norm() / perimeter;
  const double farthest = a.cwiseAbs().cwiseMax(b.cwiseAbs()).cwiseMax(c.cwiseAbs()).maxCoeff();
  const double rounding = 2e-7 * (farthest + reach);
  const Vec3 more = Vec3::Constant(reach + rounding + (radius > 0 ? margin * 0.5 * perimeter / radius : 0));
  return {(a.cwiseMin(b).cwiseMin(c) - more).cast<float>(), (a.cwiseMax(b).cwiseMax(c) + more).cast<float>()};
}

}  // namespace

MirrorTree::MirrorTree(std::span<const PlaneMirror> mirrors, double margin, double reach) {
  for (std::uint32_t mirror = 0; mirror < mirrors.size(); ++mirror) {
    for (std::uint32_t i = 0; i < mirrors[mirror].triangles.size(); ++i) {
      items_.push_back({box_of(mirrors[mirror].triangles[i], margin, reach), mirror, i});
      items_.back().box.mirror = mirror;
    }
  }
  if (!items_.empty()) {
    divide(0, static_cast<std::uint32_t>(items_.size()));
  }
}

void MirrorTree::divide(std::uint32_t first, std::uint32_t last) {
  const auto number = nodes_.size();
  MirrorBox box = items_[first].box, middles = {box.low + box.high, {}};
  middles.high = middles.low;
  for (std::uint32_t i = first; i < last; ++i) {
    const MirrorBox& one = items_[i].box;
    box = {box.low.cwiseMin(one.low), box.high.cwiseMax(one.high),
           one.mirror == box.mirror ? one.mirror : MirrorBox::kSeveral};
    middles = {middles.low.cwiseMin(one.low + one.high), middles.high.cwiseMax(one.low + one.high)};
  }
  nodes_.push_back({box, first, last, 0});
  if (last - first <= kLeaf) {
    return;
  }
  int axis = 0;
  (middles.high - middles.low).maxCoeff(&axis);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(items_.begin() + first, items_.begin() + middle, items_.begin() + last,
                   [axis](const Item& a, const Item& b) {
                     // Coincident ones by their mirrors, so that there are nodes of one mirror.
                     return std::pair(a.box.low[axis] + a.box.high[axis], a.mirror) <
                            std::pair(b.box.low[axis] + b.box.high[axis], b.mirror);
                   });
  divide(first, middle);
  nodes_[number].second = static_cast<std::uint32_t>(nodes_.size());
  divide(middle, last);
}

}  // namespace insonify

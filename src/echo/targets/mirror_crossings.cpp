// mirror_crossings.cpp -- finds pairs of mirrors by their triangles, then triples of pairs.

#include "echo/targets/mirror_crossings.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <type_traits>
#include <utility>

#include "base/parallel_blocks.h"

namespace insonify {
namespace {

bool perpendicular(const PlaneMirror& a, const PlaneMirror& b) {
  return std::abs(a.normal.dot(b.normal)) < Corner::kPerpendicular;
}

bool touch(const PlaneMirror& a, const PlaneMirror& b) {
  return (a.low.array() < b.high.array() + Corner::kGap).all() && (b.low.array() < a.high.array() + Corner::kGap).all();
}

bool may_reach(const PlaneMirror& mirror, const Vec3& point) {
  return (mirror.low.array() < point.array() + Corner::kGap).all() &&
         (point.array() < mirror.high.array() + Corner::kGap).all();
}

// Pairs of perpendicular mirrors, the lower number first, of which some triangles of a span are near others.
std::vector<std::pair<std::uint32_t, std::uint32_t>> find_pairs(const std::vector<PlaneMirror>& mirrors,
                                                                const MirrorTree& tree,
                                                                std::span<const MirrorTree::Item> some) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const MirrorTree::Item& own : some) {
    const std::uint32_t number = own.box.mirror;
    const PlaneMirror& mirror = mirrors[number];
    const Vec3 widths = mirror.normal.cwiseAbs();
    const auto is_new = [&](std::uint32_t other) {
      return number < other && (pairs.empty() || pairs.back() != std::pair(number, other)) &&
             perpendicular(mirror, mirrors[other]) && touch(mirror, mirrors[other]);
    };
    const auto meets = [&]<typename Box>(const Box& box) {
      if constexpr (std::is_same_v<Box, MirrorGroup>) {
        if (!box.may_be_perpendicular(mirror.normal, Corner::kPerpendicular)) {
          return false;
        }
      }
      return (box.mirror == MirrorBox::kSeveral || is_new(box.mirror)) && box.meets(own.box) &&
             std::abs(mirror.normal.dot(box.middle()) - mirror.offset) <= box.half().dot(widths) + kCrossingReach;
    };
    tree.visit(meets, [&](const MirrorTree::Item& other) { pairs.emplace_back(number, other.box.mirror); });
  }
  std::ranges::sort(pairs);
  pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());
  return pairs;
}

// [mirror] Mirrors of higher index, perpendicular to it, that have triangles near its own.
std::vector<std::vector<std::uint32_t>> find_beside(const std::vector<PlaneMirror>& mirrors, const MirrorTree& tree,
                                                    Workers& workers) {
  constexpr std::size_t kBlock = 4096;
  const std::span<const MirrorTree::Item> items = tree.items();
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> pairs(items.size() / kBlock + 1);
  for_each_block(workers, items.size(), kBlock, [&](std::size_t first, std::size_t last) {
    pairs[first / kBlock] = find_pairs(mirrors, tree, items.subspan(first, last - first));
  });
  std::vector<std::vector<std::uint32_t>> beside(mirrors.size());
  for (const auto& some : pairs) {
    for (const auto& [low, high] : some) {
      beside[low].push_back(high);
    }
  }
  for (std::uint32_t i = 0; i < mirrors.size(); ++i) {
    if (mirrors.back().endless && !mirrors[i].endless && perpendicular(mirrors[i], mirrors.back()) &&
        touch(mirrors[i], mirrors.back())) {
      beside[i].push_back(static_cast<std::uint32_t>(mirrors.size() - 1));
    }
    std::ranges::sort(beside[i]);
    beside[i].erase(std::ranges::unique(beside[i]).begin(), beside[i].end());
  }
  return beside;
}

}  // namespace

std::vector<Crossing> find_crossings(const std::vector<PlaneMirror>& mirrors, const MirrorTree& tree,
                                     Workers& workers) {
  const std::vector<std::vector<std::uint32_t>> beside = find_beside(mirrors, tree, workers);
  std::vector<Crossing> crossings;
  for (std::uint32_t i = 0; i < mirrors.size(); ++i) {
    for (const std::uint32_t j : beside[i]) {
      for (const std::uint32_t k : beside[j]) {
        if (!std::ranges::binary_search(beside[i], k)) {
          continue;
        }
        const PlaneMirror &a = mirrors[i], &b = mirrors[j], &c = mirrors[k];
        Eigen::Matrix3d normals;
        normals << a.normal.transpose(), b.normal.transpose(), c.normal.transpose();
        const Vec3 apex = normals.inverse() * Vec3(a.offset, b.offset, c.offset);
        if (!may_reach(a, apex) || !may_reach(b, apex) || !may_reach(c, apex)) {
          continue;
        }
        const Vec3 second = (b.normal - b.normal.dot(a.normal) * a.normal).normalized();
        Eigen::Matrix3d axes;
        axes << a.normal, second, a.normal.cross(second);
        crossings.push_back({apex, axes, {i, j, k}});
      }
    }
  }
  return crossings;
}

}  // namespace insonify

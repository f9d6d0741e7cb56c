// same_places.cpp -- hash tables of places, triangles and cells of space, which all threads fill.

#include "scene/same_places.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel_blocks.h"

namespace insonify {
namespace {

constexpr std::size_t kItemsOfTask = 1 << 14;
constexpr std::uint32_t kEmpty = 0xffffffff;

std::uint64_t mixed(std::uint64_t hash, std::uint64_t more) {
  hash = (hash ^ more) * 0x9e3779b97f4a7c15U;
  return hash ^ (hash >> 29);
}

std::size_t hash_of(const Vec3f& place) {
  std::uint64_t hash = 0;
  for (const float x : place) {  // -0 is equal to 0.
    hash = mixed(hash, std::bit_cast<std::uint32_t>(x + 0.0F));
  }
  return hash;
}

// A table of numbered things with linear probing. The slot of a thing is that in which an equal one came first, and
// holds the lowest of these. HashOf(thing), IsSame(thing, other).
template <typename HashOf, typename IsSame>
class LowestTable {
 public:
  LowestTable(std::size_t count, const HashOf& hash_of, const IsSame& is_same)
      : hash_of_(hash_of), is_same_(is_same), slots_(std::bit_ceil(2 * count + 1), kEmpty) {}

  void add(std::uint32_t thing) {
    for (std::size_t i = first_slot(thing);; i = (i + 1) & (slots_.size() - 1)) {
      const std::atomic_ref<std::uint32_t> slot(slots_[i]);
      std::uint32_t held = slot.load(std::memory_order_relaxed);
      while (held == kEmpty || (thing < held && is_same_(held, thing))) {
        if (slot.compare_exchange_weak(held, thing, std::memory_order_relaxed)) {
          return;
        }
      }
      if (held == thing || is_same_(held, thing)) {
        return;
      }
    }
  }

  // After all have been added.
  [[nodiscard]] std::uint32_t lowest(std::uint32_t thing) const {
    std::size_t i = first_slot(thing);
    while (slots_[i] != thing && !is_same_(slots_[i], thing)) {
      i = (i + 1) & (slots_.size() - 1);
    }
    return slots_[i];
  }

 private:
  [[nodiscard]] std::size_t first_slot(std::uint32_t thing) const { return hash_of_(thing) & (slots_.size() - 1); }

  const HashOf& hash_of_;
  const IsSame& is_same_;
  std::vector<std::uint32_t> slots_;
};

// Calls visit(i) for the numbers [0, count).
template <typename Visit>
void for_each_number(std::size_t count, Workers& workers, const Visit& visit) {
  for_each_block(workers, count, kItemsOfTask, [&](std::size_t first, std::size_t last) {
    for (auto i = static_cast<std::uint32_t>(first); i < last; ++i) {
      visit(i);
    }
  });
}

// [thing] The lowest of those equal to it.
template <typename HashOf, typename IsSame>
std::vector<std::uint32_t> lowest_equal(std::size_t count, const HashOf& hash_of, const IsSame& is_same,
                                        Workers& workers) {
  LowestTable table(count, hash_of, is_same);
  for_each_number(count, workers, [&](std::uint32_t i) { table.add(i); });
  std::vector<std::uint32_t> lowest(count);
  for_each_number(count, workers, [&](std::uint32_t i) { lowest[i] = table.lowest(i); });
  return lowest;
}

// Different places by the cells of space in which they lie, sorted by counting.
class CellTable {
 public:
  // @param numbers  [place] Equal to its index if the place is to be added.
  CellTable(std::span<const Vec3f> places, std::span<const std::uint32_t> numbers, float tolerance, Workers& workers)
      : places_(places),
        tolerance_(double{tolerance}),
        per_metre_(1 / (kWide * double{tolerance})),
        ends_(std::bit_ceil(places.size() + 1), 0) {
    const auto for_each_place = [&](const auto& visit) {
      for_each_block(workers, places.size(), kItemsOfTask, [&](std::size_t first, std::size_t last) {
        for (auto i = static_cast<std::uint32_t>(first); i < last; ++i) {
          if (numbers[i] == i && places[i].allFinite()) {
            visit(i, std::atomic_ref<std::uint32_t>(ends_[slot_of(cell_of(places[i], 0))]));
          }
        }
      });
    };
    for_each_place([](std::uint32_t, const auto& count) { count.fetch_add(1, std::memory_order_relaxed); });
    std::uint32_t sum = 0;
    for (std::uint32_t& end : ends_) {
      sum += std::exchange(end, sum);
    }
    items_.resize(sum);
    for_each_place(
        [&](std::uint32_t i, const auto& next) { items_[next.fetch_add(1, std::memory_order_relaxed)] = i; });
  }

  // Calls visit(other) for others with a lower index whose distance is at most the tolerance. Cells with very many
  // places are skipped: they belong to meshes whose size is that of a few cells.
  template <typename Visit>
  void for_each_near(std::uint32_t place, const Visit& visit) const {
    const std::array<std::int64_t, 3> low = cell_of(places_[place], -tolerance_),
                                      high = cell_of(places_[place], tolerance_);
    for (std::int64_t x = low[0]; x <= high[0]; ++x) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          const std::size_t slot = slot_of({x, y, z});
          const std::uint32_t begin = slot == 0 ? 0 : ends_[slot - 1], end = ends_[slot];
          for (std::uint32_t i = begin; i < end && end - begin <= kMostOfCell; ++i) {
            if (items_[i] < place && (places_[items_[i]] - places_[place]).norm() <= static_cast<float>(tolerance_)) {
              visit(items_[i]);
            }
          }
        }
      }
    }
  }

 private:
  static constexpr double kWide = 16;  // Width of a cell [tolerances].
  static constexpr std::uint32_t kMostOfCell = 512;

  [[nodiscard]] std::array<std::int64_t, 3> cell_of(const Vec3f& place, double off) const {
    std::array<std::int64_t, 3> cell{};
    for (int k = 0; k < 3; ++k) {
      cell[k] = static_cast<std::int64_t>(std::floor((double{place[k]} + off) * per_metre_));
    }
    return cell;
  }
  [[nodiscard]] std::size_t slot_of(const std::array<std::int64_t, 3>& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t x : cell) {
      hash = mixed(hash, static_cast<std::uint64_t>(x));
    }
    return hash & (ends_.size() - 1);
  }

  std::span<const Vec3f> places_;
  double tolerance_, per_metre_;
  std::vector<std::uint32_t> ends_;   // [slot] End of its places in `items_`.
  std::vector<std::uint32_t> items_;  // By slot.
};

}  // namespace

float same_place_tolerance(std::span<const Vec3f> places) {
  float farthest = 0;
  for (const Vec3f& place : places) {
    farthest = std::max(farthest, place.allFinite() ? place.cwiseAbs().maxCoeff() : 0.0F);
  }
  return std::max(kSamePlace, 2 * std::numeric_limits<float>::epsilon() * farthest);
}

std::vector<std::uint32_t> same_places(std::span<const Vec3f> places, float tolerance, std::vector<float> most,
                                       Workers& workers) {
  std::vector<std::uint32_t> numbers = lowest_equal(
      places.size(), [&](std::uint32_t i) { return hash_of(places[i]); },
      [&](std::uint32_t a, std::uint32_t b) { return places[a] == places[b]; }, workers);
  for (std::uint32_t i = 0; i < most.size(); ++i) {
    most[numbers[i]] = std::min(most[numbers[i]], most[i]);
  }
  std::vector<std::uint32_t> nearest(numbers);  // The lowest near.
  {
    const CellTable table(places, numbers, tolerance, workers);
    for_each_number(places.size(), workers, [&](std::uint32_t i) {
      if (numbers[i] == i && places[i].allFinite()) {
        table.for_each_near(i, [&](std::uint32_t other) {
          const float limit = most.empty() ? tolerance : std::min({tolerance, most[i], most[other]});
          if ((places[i] - places[other]).norm() <= limit) {
            nearest[i] = std::min(nearest[i], other);
          }
        });
      }
    });
  }
  for_each_number(places.size(), workers, [&](std::uint32_t i) {
    const std::uint32_t near = nearest[numbers[i]];
    numbers[i] = nearest[near] == near ? near : numbers[i];
  });
  return numbers;
}

std::vector<std::uint32_t> repeated_triangles(const Mesh& mesh, Workers& workers) {
  const std::size_t count = mesh.triangles.size();
  std::vector<std::uint64_t> hashes(count);  // The same for any order of the corners.
  for_each_number(count, workers, [&](std::uint32_t i) {
    const auto& [a, b, c] = mesh.triangles[i];
    hashes[i] = mixed(0, hash_of(mesh.vertices[a]) + hash_of(mesh.vertices[b]) + hash_of(mesh.vertices[c]));
  });
  const auto has_corner = [&](std::uint32_t triangle, std::uint32_t vertex) {
    return std::ranges::any_of(mesh.triangles[triangle],
                               [&](std::uint32_t other) { return mesh.vertices[other] == mesh.vertices[vertex]; });
  };
  const auto is_same = [&](std::uint32_t one, std::uint32_t two) {
    return hashes[one] == hashes[two] &&
           std::ranges::all_of(mesh.triangles[one], [&](std::uint32_t vertex) { return has_corner(two, vertex); });
  };
  std::vector<std::uint32_t> first = lowest_equal(
      count, [&](std::uint32_t i) { return hashes[i]; }, is_same, workers);
  std::atomic<bool> any = false;
  for_each_number(count, workers, [&](std::uint32_t i) {
    if (first[i] != i) {
      any.store(true, std::memory_order_relaxed);
    }
  });
  if (!any) {
    first.clear();
  }
  return first;
}

}  // namespace insonify

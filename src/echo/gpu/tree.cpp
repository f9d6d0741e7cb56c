// tree.cpp -- has Embree build a tree, and compresses its nodes for shaders.

#include "echo/gpu/tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <utility>

#include "echo/embree.h"

namespace insonify {
namespace {

constexpr unsigned kSlots = 8;

// A node while Embree builds: a leaf has no children.
struct Branch {
  RTCBounds bounds[kSlots];
  Branch* children[kSlots];
  unsigned child_count = 0;
  std::uint32_t leaves[kMostInLeaf];
  std::uint32_t leaf_count = 0;
};

Branch* new_branch(RTCThreadLocalAllocator allocator) {
  return new (rtcThreadLocalAlloc(allocator, sizeof(Branch), alignof(Branch))) Branch;
}

void* make_branch(RTCThreadLocalAllocator allocator, unsigned, void*) {
  return new_branch(allocator);
}

void* make_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count, void*) {
  Branch* leaf = new_branch(allocator);
  leaf->leaf_count = static_cast<std::uint32_t>(count);
  for (std::size_t i = 0; i < count; ++i) {
    leaf->leaves[i] = primitives[i].primID;
  }
  return leaf;
}

void set_children(void* branch, void** children, unsigned count, void*) {
  auto& node = *static_cast<Branch*>(branch);
  node.child_count = count;
  for (unsigned i = 0; i < count; ++i) {
    node.children[i] = static_cast<Branch*>(children[i]);
  }
}

void set_bounds(void* branch, const RTCBounds** bounds, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) {
    static_cast<Branch*>(branch)->bounds[i] = *bounds[i];
  }
}

struct Builder {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCBVH tree = device == nullptr ? nullptr : rtcNewBVH(device);

  Builder() {
    if (tree == nullptr) {
      throw std::bad_alloc();
    }
  }
  Builder(const Builder&) = delete;
  Builder& operator=(const Builder&) = delete;
  ~Builder() {
    rtcReleaseBVH(tree);
    rtcReleaseDevice(device);
  }

  const Branch* build(std::vector<RTCBuildPrimitive>& primitives, int in_leaf, TreeDepth depth) {
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = kSlots;
    arguments.maxDepth = static_cast<unsigned>(depth);
    arguments.minLeafSize = 1;
    arguments.maxLeafSize = static_cast<unsigned>(in_leaf);
    arguments.bvh = tree;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = make_branch;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = make_leaf;
    const auto* root = static_cast<const Branch*>(rtcBuildBVH(&arguments));
    if (root == nullptr) {
      throw std::bad_alloc();
    }
    return root;
  }
};

RTCBounds bounds_of(const LeafBox& box) {
  return {box.low.x(), box.low.y(), box.low.z(), 0, box.high.x(), box.high.y(), box.high.z(), 0};
}

LeafBox around(const RTCBounds* bounds, unsigned count) {
  constexpr float kFar = std::numeric_limits<float>::max();
  LeafBox box{Vec3f::Constant(kFar), Vec3f::Constant(-kFar)};
  for (unsigned i = 0; i < count; ++i) {
    box.low = box.low.cwiseMin(Vec3f(bounds[i].lower_x, bounds[i].lower_y, bounds[i].lower_z));
    box.high = box.high.cwiseMax(Vec3f(bounds[i].upper_x, bounds[i].upper_y, bounds[i].upper_z));
  }
  return box;
}

// The slot of each child: child by child, the pair of child and octant that lies farthest out.
std::array<unsigned, kSlots> slots_of(const Branch& branch, const LeafBox& box) {
  float out[kSlots][kSlots];
  for (unsigned child = 0; child < branch.child_count; ++child) {
    const LeafBox own = around(&branch.bounds[child], 1);
    const Vec3f off = own.low + own.high - box.low - box.high;
    for (unsigned slot = 0; slot < kSlots; ++slot) {
      const Vec3f towards((slot & 4U) != 0 ? 1 : -1, (slot & 2U) != 0 ? 1 : -1, (slot & 1U) != 0 ? 1 : -1);
      out[child][slot] = off.dot(towards);
    }
  }
  std::array<unsigned, kSlots> slots;
  slots.fill(kSlots);
  bool taken[kSlots] = {};
  for (unsigned done = 0; done < branch.child_count; ++done) {
    unsigned best_child = kSlots, best_slot = 0;
    for (unsigned child = 0; child < branch.child_count; ++child) {
      for (unsigned slot = 0; slot < kSlots && slots[child] == kSlots; ++slot) {
        if (!taken[slot] && (best_child == kSlots || out[child][slot] > out[best_child][best_slot])) {
          best_child = child;
          best_slot = slot;
        }
      }
    }
    slots[best_child] = best_slot;
    taken[best_slot] = true;
  }
  return slots;
}

// Exponent of the unit in which a box is at most 255 long.
int exponent_of(float size) {
  constexpr int kLeast = -126;
  int exponent = kLeast;
  if (size > 0) {
    (void)std::frexp(size / 255, &exponent);  // 2^(exponent - 1) <= size / 255 < 2^exponent
  }
  return std::clamp(exponent, kLeast, 127);
}

void set_byte(std::uint32_t* words, unsigned index, unsigned value) {
  words[index / 4] |= value << (index % 4 * 8);
}

// Sets the box of a slot.
void set_box(const RTCBounds& bounds, const LeafBox& node_box, unsigned slot, shader::TreeNode& node) {
  const LeafBox box = around(&bounds, 1);
  for (unsigned axis = 0; axis < 3; ++axis) {
    const int exponent = static_cast<int>(node.scales >> (8 * axis) & 255U) - 127;
    const double from = node_box.low[axis];
    const double low = std::ldexp(double{box.low[axis]} - from, -exponent),
                 high = std::ldexp(double{box.high[axis]} - from, -exponent);
    set_byte(node.lows, 8 * axis + slot, static_cast<unsigned>(std::clamp(std::floor(low), 0.0, 255.0)));
    set_byte(node.highs, 8 * axis + slot, static_cast<unsigned>(std::clamp(std::ceil(high), 0.0, 255.0)));
  }
}

// Adds the contents of a leaf to the order and its kind to the node.
void add_leaf(const Branch& leaf, unsigned slot, shader::TreeNode& node, Tree& tree) {
  const auto place = static_cast<unsigned>(tree.order.size()) - node.first_leaf;
  set_byte(node.kinds, slot, ((1U << leaf.leaf_count) - 1) << 5U | place);
  tree.order.insert(tree.order.end(), leaf.leaves, leaf.leaves + leaf.leaf_count);
}

// Fills in the node at `place`. Returns its children that are nodes, by slot; their places follow each other.
std::array<const Branch*, kSlots> fill(const Branch& branch, std::size_t place, Tree& tree) {
  const LeafBox box = around(branch.bounds, branch.child_count);
  shader::TreeNode node = {};
  node.low = {box.low.x(), box.low.y(), box.low.z()};
  for (unsigned axis = 0; axis < 3; ++axis) {
    node.scales |= static_cast<unsigned>(exponent_of(box.high[axis] - box.low[axis]) + 127) << (8 * axis);
  }
  node.first_leaf = static_cast<std::uint32_t>(tree.order.size());
  node.first_child = static_cast<std::uint32_t>(tree.nodes.size());
  const std::array<unsigned, kSlots> slots = slots_of(branch, box);
  std::array<const Branch*, kSlots> in_slot = {}, inner = {};
  for (unsigned child = 0; child < branch.child_count; ++child) {
    in_slot[slots[child]] = branch.children[child];
    set_box(branch.bounds[child], box, slots[child], node);
  }
  for (unsigned slot = 0; slot < kSlots; ++slot) {
    if (in_slot[slot] == nullptr) {
      continue;
    }
    if (in_slot[slot]->leaf_count > 0) {
      add_leaf(*in_slot[slot], slot, node, tree);
    } else {
      inner[slot] = in_slot[slot];
      node.scales |= 1U << (24 + slot);
      set_byte(node.kinds, slot, 1U << 5U | (24 + slot));
      tree.nodes.emplace_back();
    }
  }
  tree.nodes[place] = node;
  return inner;
}

void compress(const Branch& root, Tree& tree) {
  struct Task {
    const Branch* branch;
    std::size_t place;
  };
  tree.nodes.emplace_back();
  std::vector<Task> tasks = {{&root, 0}};
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    const auto inner = fill(*task.branch, task.place, tree);
    std::size_t place = tree.nodes[task.place].first_child;
    for (const Branch* child : inner) {
      if (child != nullptr) {
        tasks.push_back({child, place++});
      }
    }
  }
}

}  // namespace

Tree build_tree(const std::vector<LeafBox>& boxes, int in_leaf, TreeDepth depth) {
  Tree tree;
  tree.order.reserve(boxes.size());
  if (boxes.empty()) {
    tree.nodes.emplace_back();  // A node whose slots are empty.
    return tree;
  }
  std::vector<RTCBuildPrimitive> primitives(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Vec3f &low = boxes[i].low, &high = boxes[i].high;
    primitives[i] = {low.x(), low.y(), low.z(), 0, high.x(), high.y(), high.z(), static_cast<unsigned>(i)};
  }
  Builder builder;
  Branch* root = const_cast<Branch*>(builder.build(primitives, in_leaf, depth));
  Branch above;
  if (root->leaf_count > 0) {  // The root is a node in any case.
    std::vector<RTCBounds> bounds;
    bounds.reserve(boxes.size());
    for (const LeafBox& box : boxes) {
      bounds.push_back(bounds_of(box));
    }
    const LeafBox all = around(bounds.data(), static_cast<unsigned>(bounds.size()));
    above.child_count = 1;
    above.children[0] = root;
    above.bounds[0] = bounds_of(all);
    root = &above;
  }
  compress(*root, tree);
  return tree;
}

}  // namespace insonify

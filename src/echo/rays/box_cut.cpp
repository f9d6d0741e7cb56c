// box_cut.cpp -- splits the box of greatest volume, by the surface area heuristic, until there are kMostBoxes.

#include "echo/rays/box_cut.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/lane_bits.h"
#include "base/vector_math.h"

namespace insonify {
namespace {

// Most boxes of static objects. Each costs two dozen instructions for sixteen rays.
constexpr std::size_t kMostBoxes = 64;

// Most groups of these boxes: the boxes there are after as many splits.
constexpr std::size_t kMostGroups = 8;

// Most pieces that are sorted into boxes. In larger scenes a piece consists of several consecutive triangles.
constexpr std::size_t kMostPieces = 1 << 12;

// Enlarges boxes on all sides [m]. Less than kRayClearance, so that a ray that starts on a flat wall is outside its
// box.
constexpr float kMargin = 1e-4F;

// Four coordinates, because that is a vector register; the fourth is not used.
using Corner = Eigen::Array4f;

struct Box {
  Corner low = Corner::Constant(1e30F), high = Corner::Constant(-1e30F);

  void add(const Vec3f& point) {
    const Corner corner(point.x(), point.y(), point.z(), 0);
    low = low.min(corner);
    high = high.max(corner);
  }
  void add(const Box& other) {
    low = low.min(other.low);
    high = high.max(other.high);
  }
  [[nodiscard]] bool empty() const { return low.x() > high.x(); }
  [[nodiscard]] float area() const {
    const Corner size = high - low;
    return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
  }
  [[nodiscard]] float volume() const { return (high - low).head<3>().prod(); }
};

// The pieces [first, last) and their best split: those whose centre lies below bin `split` along `axis`, and the rest.
struct Node {
  std::size_t first, last;
  Box box = {};
  float area = std::numeric_limits<float>::infinity();  // Sum over both parts; infinite if there is no split.
  int axis = 0, split = 0;
  std::size_t group = 0;
};

constexpr int kBins = 16;

// Bin of a piece's centre along each axis: the node's box is divided into kBins slices. 0 along an axis where it is
// flat.
using BinOfAxes = Eigen::Array4i;
class Binning {
 public:
  explicit Binning(const Box& all) : low_(all.low) {
    const Corner size = all.high - all.low;
    per_length_ = (size > 0).select(kBins / size.max(1e-30F), Corner::Zero());
  }

  [[nodiscard]] BinOfAxes operator()(const Box& piece) const {
    const Corner place = (0.5F * (piece.low + piece.high) - low_) * per_length_;
    return place.min(kBins - 0.5F).cast<int>();
  }

 private:
  Corner low_, per_length_;
};

std::vector<Box> pieces_of(const Instance& instance, const Vec3& origin, std::size_t together) {
  const Mesh& mesh = *instance.mesh;
  const Eigen::Matrix3d rotation = instance.world_from_mesh.orientation.toRotationMatrix();
  const Vec3 offset = instance.world_from_mesh.position - origin;
  std::vector<Vec3f> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const Vec3f& vertex : mesh.vertices) {
    vertices.push_back((rotation * vertex.cast<double>() + offset).cast<float>());
  }
  std::vector<Box> pieces;
  pieces.reserve(mesh.triangles.size() / together + 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t % together == 0) {
      pieces.emplace_back();
    }
    for (const std::uint32_t corner : mesh.triangles[t]) {
      pieces.back().add(vertices[corner]);
    }
  }
  return pieces;
}

// Finds the split with the least sum of areas: surface area heuristic, Goldsmith and Salmon (1987).
Node make_node(const std::vector<Box>& pieces, std::size_t first, std::size_t last) {
  Node node{first, last};
  for (std::size_t i = first; i < last; ++i) {
    node.box.add(pieces[i]);
  }
  Box bins_of_axis[3][kBins];
  const Binning bin_of(node.box);
  for (std::size_t i = first; i < last; ++i) {
    const BinOfAxes bin = bin_of(pieces[i]);
    for (int axis = 0; axis < 3; ++axis) {
      bins_of_axis[axis][bin[axis]].add(pieces[i]);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const Box* bins = bins_of_axis[axis];
    Box above[kBins];  // Box of this bin and all after it.
    above[kBins - 1] = bins[kBins - 1];
    for (int bin = kBins - 2; bin > 0; --bin) {
      above[bin] = bins[bin];
      above[bin].add(above[bin + 1]);
    }
    Box below;
    for (int split = 1; split < kBins; ++split) {
      below.add(bins[split - 1]);
      const float area = below.area() + above[split].area();
      if (!below.empty() && !above[split].empty() && area < node.area) {
        node.area = area;
        node.axis = axis;
        node.split = split;
      }
    }
  }
  return node;
}

// Splits the node of greatest volume again and again; reorders the pieces. Returns the nodes group by group.
std::vector<Node> cut(std::vector<Box>& pieces) {
  std::vector<Node> nodes = {make_node(pieces, 0, pieces.size())};
  while (nodes.size() < kMostBoxes) {
    const auto enclosed = [](const Node& node) { return std::isfinite(node.area) ? node.box.volume() : -1; };
    Node& best = *std::ranges::max_element(nodes, {}, enclosed);
    if (enclosed(best) < 0) {
      break;
    }
    const Node node = best;
    const auto at = [&](std::size_t i) { return pieces.begin() + static_cast<std::ptrdiff_t>(i); };
    const Binning bin_of(node.box);
    const auto middle = std::partition(at(node.first), at(node.last),
                                       [&](const Box& piece) { return bin_of(piece)[node.axis] < node.split; });
    const auto split_at = static_cast<std::size_t>(middle - pieces.begin());
    best = make_node(pieces, node.first, split_at);
    best.group = node.group;
    nodes.push_back(make_node(pieces, split_at, node.last));
    nodes.back().group = nodes.size() <= kMostGroups ? nodes.size() - 1 : node.group;
  }
  std::ranges::stable_sort(nodes, {}, &Node::group);
  return nodes;
}

// Sixteen rays, with the inverse of their directions.
struct Lanes {
  float origin_x[kRayLanes], origin_y[kRayLanes], origin_z[kRayLanes];
  float inverse_x[kRayLanes], inverse_y[kRayLanes], inverse_z[kRayLanes];
  float near[kRayLanes], far[kRayLanes];
};

// Sets met[lane] to 1 where the ray passes through a box between its ends. Rounding is monotonic, so that a ray that
// meets a box meets every box around it.
[[gnu::always_inline]] inline void mark_met(const BoxCut::Boxes& boxes, std::size_t box,
                                            const Lanes& __restrict__ lanes, float* __restrict__ met) {
  const float low_x = boxes.low[0][box], low_y = boxes.low[1][box], low_z = boxes.low[2][box];
  const float high_x = boxes.high[0][box], high_y = boxes.high[1][box], high_z = boxes.high[2][box];
#pragma GCC unroll 1
#pragma GCC ivdep
  for (int lane = 0; lane < kRayLanes; ++lane) {
    const float ax = (low_x - lanes.origin_x[lane]) * lanes.inverse_x[lane],
                bx = (high_x - lanes.origin_x[lane]) * lanes.inverse_x[lane];
    const float ay = (low_y - lanes.origin_y[lane]) * lanes.inverse_y[lane],
                by = (high_y - lanes.origin_y[lane]) * lanes.inverse_y[lane];
    const float az = (low_z - lanes.origin_z[lane]) * lanes.inverse_z[lane],
                bz = (high_z - lanes.origin_z[lane]) * lanes.inverse_z[lane];
    const float near_x = ax < bx ? ax : bx, near_y = ay < by ? ay : by, near_z = az < bz ? az : bz;
    const float far_x = ax < bx ? bx : ax, far_y = ay < by ? by : ay, far_z = az < bz ? bz : az;
    const float near_xy = near_x > near_y ? near_x : near_y, near = near_xy > near_z ? near_xy : near_z;
    const float far_xy = far_x < far_y ? far_x : far_y, far = far_xy < far_z ? far_xy : far_z;
    const bool meets = (near <= far) & (near <= lanes.far[lane]) & (far >= lanes.near[lane]);
    met[lane] = meets ? 1.0F : met[lane];
  }
}

}  // namespace

void BoxCut::Boxes::resize(std::size_t count) {
  for (int axis = 0; axis < 3; ++axis) {
    low[axis].resize(count);
    high[axis].resize(count);
  }
}

void BoxCut::put(std::size_t box, const Vec3f& low, const Vec3f& high) {
  for (int axis = 0; axis < 3; ++axis) {
    const float margin = kMargin + 1e-6F * std::max(std::abs(low[axis]), std::abs(high[axis]));
    boxes_.low[axis][box] = low[axis] - margin;
    boxes_.high[axis][box] = high[axis] + margin;
  }
}

// Box around boxes [first, last).
void BoxCut::add_group(std::size_t first, std::size_t last) {
  const std::size_t group = group_end_.size();
  group_end_.push_back(last);
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<float>&low = boxes_.low[axis], &high = boxes_.high[axis];
    const auto from = static_cast<std::ptrdiff_t>(first), to = static_cast<std::ptrdiff_t>(last);
    groups_.low[axis][group] = *std::min_element(low.begin() + from, low.begin() + to);
    groups_.high[axis][group] = *std::max_element(high.begin() + from, high.begin() + to);
  }
}

void BoxCut::set(const Scene& scene, const Vec3& origin) {
  std::vector<Box> pieces;
  moving_.clear();
  const std::size_t together = scene.triangle_count() / kMostPieces + 1;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    if (!instance.present) {
      continue;
    }
    if (instance.moving) {
      Moving& moving = moving_.emplace_back();
      moving.instance = static_cast<int>(i);
      Box box;
      for (const Vec3f& vertex : instance.mesh->vertices) {
        box.add(vertex);
      }
      moving.low = box.low.head<3>();
      moving.high = box.high.head<3>();
    } else {
      const std::vector<Box> more = pieces_of(instance, origin, together);
      pieces.insert(pieces.end(), more.begin(), more.end());
    }
  }
  const std::vector<Node> nodes = pieces.empty() ? std::vector<Node>() : cut(pieces);
  boxes_.resize(nodes.size() + moving_.size());
  groups_.resize(nodes.empty() ? 0 : nodes.back().group + 1);
  group_end_.clear();
  for (std::size_t first = 0, i = 0; i < nodes.size(); ++i) {
    put(i, nodes[i].box.low.head<3>(), nodes[i].box.high.head<3>());
    if (i + 1 == nodes.size() || nodes[i + 1].group != nodes[i].group) {
      add_group(first, i + 1);
      first = i + 1;
    }
  }
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    moving_[i].box = nodes.size() + i;
    Pose pose = scene.instances[moving_[i].instance].world_from_mesh;
    pose.position -= origin;
    move(moving_[i].instance, pose);
  }
}

void BoxCut::move(int instance, const Pose& scene_from_mesh) {
  const auto moving = std::ranges::find(moving_, instance, &Moving::instance);
  Box box;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3f place((corner & 1) != 0 ? moving->high.x() : moving->low.x(),
                      (corner & 2) != 0 ? moving->high.y() : moving->low.y(),
                      (corner & 4) != 0 ? moving->high.z() : moving->low.z());
    box.add((scene_from_mesh * place.cast<double>()).cast<float>());
  }
  put(moving->box, box.low.head<3>(), box.high.head<3>());
}

INSONIFY_VECTOR_CLONES
unsigned BoxCut::may_meet(const RayLanes& rays) const {
  Lanes lanes;
  float met[kRayLanes];
  for (int lane = 0; lane < kRayLanes; ++lane) {
    // Replaces zero components, since 0 x infinity is not a number.
    constexpr float kTiny = 1e-20F;
    const float x = rays.direction_x[lane], y = rays.direction_y[lane], z = rays.direction_z[lane];
    lanes.inverse_x[lane] = 1 / (std::abs(x) < kTiny ? kTiny : x);
    lanes.inverse_y[lane] = 1 / (std::abs(y) < kTiny ? kTiny : y);
    lanes.inverse_z[lane] = 1 / (std::abs(z) < kTiny ? kTiny : z);
    lanes.origin_x[lane] = rays.origin_x[lane];
    lanes.origin_y[lane] = rays.origin_y[lane];
    lanes.origin_z[lane] = rays.origin_z[lane];
    lanes.near[lane] = rays.near[lane];
    lanes.far[lane] = rays.far[lane];
    met[lane] = 0;
  }
  constexpr unsigned kAll = (1U << kRayLanes) - 1;
  unsigned all_met = 0;
  std::size_t box = 0;
  for (std::size_t group = 0; group < group_end_.size() && all_met != kAll; ++group) {
    float met_group[kRayLanes] = {};
    mark_met(groups_, group, lanes, met_group);
    if ((positive_of_sixteen(met_group) & ~all_met) != 0) {
      for (; box < group_end_[group]; ++box) {
        mark_met(boxes_, box, lanes, met);
      }
      all_met = positive_of_sixteen(met);
    }
    box = group_end_[group];
  }
  for (box = boxes_.size() - moving_.size(); box < boxes_.size(); ++box) {
    mark_met(boxes_, box, lanes, met);
  }
  return positive_of_sixteen(met);
}

}  // namespace insonify

// box_cut.cpp -- boxes around the static parts and the moving objects of a scene, and the rays that may meet them.

#include "echo/rays/box_cut.h"

#include <algorithm>
#include <cmath>

#include "base/lane_bits.h"
#include "base/vector_math.h"
#include "echo/rays/cut_boxes.h"

namespace insonify {
namespace {

// Most pieces that are sorted into boxes. In larger scenes a piece consists of several consecutive triangles.
constexpr std::size_t kMostPieces = 1 << 12;

// Enlarges boxes on all sides [m]. Less than kRayClearance, so that a ray that starts on a flat wall is outside its
// box.
constexpr float kMargin = 1e-4F;

std::vector<PieceBox> pieces_of(const Instance& instance, const Vec3& origin, std::size_t together) {
  const Mesh& mesh = *instance.mesh;
  const Eigen::Matrix3d rotation = instance.world_from_mesh.orientation.toRotationMatrix();
  const Vec3 offset = instance.world_from_mesh.position - origin;
  std::vector<Vec3f> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const Vec3f& vertex : mesh.vertices) {
    vertices.push_back((rotation * vertex.cast<double>() + offset).cast<float>());
  }
  std::vector<PieceBox> pieces;
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
  std::vector<PieceBox> pieces;
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
      PieceBox box;
      for (const Vec3f& vertex : instance.mesh->vertices) {
        box.add(vertex);
      }
      moving.low = box.low.head<3>();
      moving.high = box.high.head<3>();
    } else {
      const std::vector<PieceBox> more = pieces_of(instance, origin, together);
      pieces.insert(pieces.end(), more.begin(), more.end());
    }
  }
  const std::vector<GroupedBox> boxes = cut_boxes(pieces);
  boxes_.resize(boxes.size() + moving_.size());
  groups_.resize(boxes.empty() ? 0 : boxes.back().group + 1);
  group_end_.clear();
  for (std::size_t first = 0, i = 0; i < boxes.size(); ++i) {
    put(i, boxes[i].box.low.head<3>(), boxes[i].box.high.head<3>());
    if (i + 1 == boxes.size() || boxes[i + 1].group != boxes[i].group) {
      add_group(first, i + 1);
      first = i + 1;
    }
  }
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    moving_[i].box = boxes.size() + i;
    Pose pose = scene.instances[moving_[i].instance].world_from_mesh;
    pose.position -= origin;
    move(moving_[i].instance, pose);
  }
}

void BoxCut::move(int instance, const Pose& scene_from_mesh) {
  const auto moving = std::ranges::find(moving_, instance, &Moving::instance);
  PieceBox box;
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

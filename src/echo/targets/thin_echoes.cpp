// thin_echoes.cpp -- divides pieces into steps, asks whether each is visible, and integrates the scattering law over
// it.

#include "echo/targets/thin_echoes.h"

#include <algorithm>
#include <cmath>

#include "base/vector_math.h"
#include "echo/laws/laws.h"
#include "echo/model/hit.h"

namespace insonify {
namespace {

// Weight of an echo, as a share of its solid angle. The solid angle itself is in the grid already, from the samples of
// the lattice that hit the part; but an echo without weight would not label its cell.
constexpr float kWeight = 1e-3F;

// In thicknesses: distance of the ray's end in front of the axis, and distance in front of it from which hits on the
// same instance do not block.
constexpr float kInFront = 1, kOwnDepth = 3;

// Area times backscattering coefficient of a patch: Lambert's law and the facets' lobe, widened by curvature.
// @param cosine  n . d, negative.
float strength_of(const ThinParts::Patch& patch, const Vec3f& direction, float cosine, const ScatterTable::Laws& laws,
                  std::uint32_t material) {
  const float held = std::max(-cosine, kLeastCosine);
  const TurnProducts turns{patch.around.squaredNorm(),
                           patch.along.squaredNorm(),
                           patch.around.dot(patch.along),
                           patch.around.dot(direction),
                           patch.along.dot(direction),
                           0,
                           0};
  const LobeWidening widening = widen_lobe(turns, cosine, laws.steepness[material]);
  const float glint = facet_lobe(laws.lobe[material], laws.steepness[material],
                                 std::min(std::sqrt(held * held + widening.spared), 1.0F)) *
                      std::sqrt(widening.share);
  const float on_top =
      laws.by_angle == nullptr
          ? 0.0F
          : held * ScatterTable::at_angle(laws.by_angle,
                                          ScatterTable::kAngleStride * material + ScatterTable::kBackscatter, held);
  return patch.area * (laws.lambert[material] * cosine * cosine + glint + on_top);
}

// Spreads 16 bits to every second bit.
std::uint32_t interleaved(std::uint32_t bits) {
  bits = (bits | bits << 8) & 0x00FF00FFU;
  bits = (bits | bits << 4) & 0x0F0F0F0FU;
  bits = (bits | bits << 2) & 0x33333333U;
  return (bits | bits << 1) & 0x55555555U;
}

// Whether a sphere is outside the fan in azimuth. The fan is symmetric about x; false for fans wider than 180 degrees.
bool beside(const FlatPlan& plan, const Vec3f& middle, float radius) {
  const float edge = plan.lattice.azimuth.front() + plan.lattice.column_width.front();
  const float across = std::abs(middle.y());
  if (!(edge < 0.5F * std::numbers::pi_v<float>)) {
    return false;
  }
  return plan.lattice.shape == BeamShape::kWedge ? across * std::cos(edge) - middle.x() * std::sin(edge) > radius
                                                 : across - (middle.norm() + radius) * std::sin(edge) > radius;
}

// Whether a ray has met nothing but its own piece.
bool is_visible(const RayAnswers& hits, std::size_t ray) {
  const Hit& hit = hits.sights[ray];
  const SightEnd& own = hits.asked.ends[ray];
  return !std::isfinite(hit.distance) || (hit.instance == own.instance && hit.distance > own.from);
}

}  // namespace

ThinEchoes::ThinEchoes(std::shared_ptr<const ThinParts> parts) : parts_(std::move(parts)) {
  const std::vector<ThinParts::Piece>& pieces = parts_->pieces;
  for (std::size_t first = 0, last = 0; first < pieces.size(); first = last) {
    const std::uint16_t instance = instance_of(pieces[first].surface);
    Eigen::AlignedBox3f box;
    for (last = first; last < pieces.size() && instance_of(pieces[last].surface) == instance; ++last) {
      box.extend(pieces[last].middle);
    }
    Group group{instance, first, last, box.center(), 0};
    for (std::size_t i = first; i < last; ++i) {
      group.radius = std::max(group.radius, (pieces[i].middle - group.middle).norm() + pieces[i].half.norm());
    }
    groups_.push_back(group);
  }
  mesh_from_sonar_.resize(groups_.size());
  seen_.reserve(pieces.size());
  steps_.reserve(kMostSteps);
  order_.reserve(kMostRays);
  ray_of_.resize(kMostRays);
}

// Finds the pieces within the fan and the range window that are too thin for the lattice.
void ThinEchoes::find_seen(const PingView& view) {
  seen_.clear();
  const FlatPlan& plan = *view.plan;
  const Pose sonar_from_world = view.world_from_sonar.inverse();
  for (std::uint32_t i = 0; i < groups_.size(); ++i) {
    const Group& group = groups_[i];
    const Pose sonar_from_mesh = sonar_from_world * (*view.placement)[group.instance];
    const Vec3f middle = (sonar_from_mesh * group.middle.cast<double>().eval()).cast<float>();
    const float range = middle.norm();
    if (range - group.radius < plan.true_max_range && range + group.radius > plan.first_bin_at &&
        !beside(plan, middle, group.radius)) {
      add_seen(plan, i, sonar_from_mesh);
    }
  }
}

void ThinEchoes::add_seen(const FlatPlan& plan, std::uint32_t group, const Pose& sonar_from_mesh) {
  const float per_metre = thin_per_metre(plan);
  const float column = plan.lattice.column_width[plan.lattice.columns / 2];
  const Eigen::Matrix3d turn_exactly = sonar_from_mesh.orientation.toRotationMatrix();
  const Eigen::Matrix3f turn = turn_exactly.cast<float>();
  mesh_from_sonar_[group] = turn.transpose();
  for (std::size_t i = groups_[group].first; i < groups_[group].last; ++i) {
    const ThinParts::Piece& piece = parts_->pieces[i];
    const Vec3f half = turn * piece.half;
    const Vec3f middle = (turn_exactly * piece.middle.cast<double>() + sonar_from_mesh.position).cast<float>();
    const float range = middle.norm(), length = half.norm();
    if (range > plan.true_max_range + length || range + length < plan.first_bin_at || !(range > length) ||
        !(piece.thickness < per_metre * (range + length)) || plan.receives_nothing_of(middle, length) ||
        beside(plan, middle, length)) {
      continue;
    }
    const float radial = std::abs(half.dot(middle)) / range;
    const float across = std::sqrt(std::max(length * length - radial * radial, 0.0F)) / range;
    const float slope = 1 / std::sqrt(2 * plan.scatter.steepness(piece.surface));
    const float bins = 2 * radial * plan.bins_per_metre, parts = 2 * across / std::min(column, 0.5F * slope);
    seen_.push_back({static_cast<std::uint32_t>(i), group, 0, 0, middle, half, std::max(bins, parts)});
  }
}

// Divides the pieces into steps. False if there are too many.
// @param longer  Factor on the largest length of a step.
bool ThinEchoes::divide(float longer) {
  constexpr float kMostOfPiece = 256;
  std::uint32_t steps = 0;
  for (Seen& seen : seen_) {
    seen.first = steps;
    seen.count = static_cast<std::uint32_t>(std::clamp(std::ceil(seen.wished / longer), 1.0F, kMostOfPiece));
    steps += seen.count;
  }
  return steps <= kMostSteps;
}

void ThinEchoes::step_along(const FlatPlan& plan, const Seen& seen) {
  const ThinParts::Piece& piece = parts_->pieces[seen.piece];
  const float per_metre = thin_per_metre(plan), length = seen.half.norm(), count = static_cast<float>(seen.count);
  const Vec3f axis = length > 0 ? Vec3f(seen.half / length) : Vec3f(Vec3f::Zero());
  for (std::uint32_t k = 0; k < seen.count; ++k) {
    const Vec3f place = seen.middle + ((2 * static_cast<float>(k) + 1) / count - 1) * seen.half;
    const float distance = place.norm();
    const Vec3f direction = place / distance;
    const bool received = piece.thickness < per_metre * distance && plan.receives(direction);
    steps_[seen.first + k] = {seen.piece, received ? seen.count : 0,
                              place,      mesh_from_sonar_[seen.group] * direction,
                              axis,       std::abs(seen.half.dot(direction)) / count};
  }
}

// Finds the steps that the sonar receives.
void ThinEchoes::find_steps(const FlatPlan& plan, Workers& workers) {
  for (float longer = 1; !divide(longer); longer *= 2) {
    static_assert(ThinParts::kMostPieces < kMostSteps);  // At most as many steps as pieces in the end.
  }
  steps_.resize(seen_.empty() ? 0 : seen_.back().first + seen_.back().count);
  constexpr std::size_t kTogether = 128;
  workers.for_each(static_cast<int>((seen_.size() + kTogether - 1) / kTogether), [&](int task, int) {
    const std::size_t first = static_cast<std::size_t>(task) * kTogether;
    for (std::size_t i = first; i < std::min(first + kTogether, seen_.size()); ++i) {
      step_along(plan, seen_[i]);
    }
  });
  std::erase_if(steps_, [](const Step& step) { return step.count == 0; });
}

// Asks for a line of sight to every n-th step, to a place in front of the piece, beside its axis. Neighbouring rays are
// traced together: they are ordered along a curve that fills the fan (Morton order).
void ThinEchoes::ask_for_steps(const Pose& world_from_sonar, RayList& rays) {
  stride_ = (steps_.size() + kMostRays - 1) / kMostRays;
  order_.clear();
  for (std::size_t i = 0; i < steps_.size(); i += stride_) {
    const Vec3f direction = steps_[i].place.normalized();
    constexpr float kUnits = 65535;  // From -1 to 1.
    const auto across = static_cast<std::uint32_t>((0.5F + 0.5F * direction.y()) * kUnits);
    const auto up = static_cast<std::uint32_t>((0.5F + 0.5F * direction.z()) * kUnits);
    order_.push_back(static_cast<std::uint64_t>(interleaved(across) | interleaved(up) << 1) << 32 | i / stride_);
  }
  std::ranges::sort(order_);
  for (const std::uint64_t place : order_) {
    const auto number = static_cast<std::uint32_t>(place);
    ray_of_[number] = static_cast<std::uint32_t>(rays.sights.size());
    const Step& step = steps_[number * stride_];
    const ThinParts::Piece& piece = parts_->pieces[step.piece];
    const Vec3f direction = step.place.normalized();
    const Vec3f beside_axis = -direction + direction.dot(step.axis) * step.axis;
    const Vec3f front = beside_axis.squaredNorm() > 1e-6F ? Vec3f(beside_axis.normalized()) : Vec3f(-direction);
    const Vec3 there = (step.place + kInFront * piece.thickness * front).cast<double>();
    const double distance = there.norm();
    rays.sights.push_back({world_from_sonar.position, world_from_sonar.orientation * (there / distance), 0,
                           std::max(distance - double{kRayClearance}, 0.0)});
    rays.ends.push_back({distance - double{kOwnDepth * piece.thickness}, instance_of(piece.surface)});
  }
}

Echo ThinEchoes::echo_of(const FlatPlan& plan, const Step& step) const {
  const ThinParts::Piece& piece = parts_->pieces[step.piece];
  const ScatterTable::Laws laws = plan.scatter.laws();
  const std::uint32_t material = laws.index_of(piece.surface);
  float strength = 0, depth = 0, facing = 0;
  for (std::uint32_t i = piece.first_patch; i < piece.last_patch; ++i) {
    const ThinParts::Patch& patch = parts_->patches[i];
    const float cosine = patch.normal.dot(step.in_mesh);
    if (cosine < 0) {
      const float of_patch = strength_of(patch, step.in_mesh, cosine, laws, material);
      strength += of_patch;
      depth += of_patch * patch.offset.dot(step.in_mesh);
      facing -= patch.area * cosine;
    }
  }
  if (!(strength > 0)) {
    return {};
  }
  const float distance = step.place.norm();
  const FlatPlan::Arrival arrival = plan.arrival_from(step.place / distance);
  const float range = distance + depth / strength, square = range * range;
  const float spread = fast_exp(-4 * plan.neper_per_metre * range) / (square * square);
  const float weight = kWeight * facing / (square * static_cast<float>(step.count));
  const float intensity =
      strength * spread * arrival.sent * arrival.received * arrival.transmitted / static_cast<float>(step.count);
  return {.azimuth = arrival.bearing,
          .elevation = arrival.elevation,
          .path_length = 2 * range,
          .half_length = step.half_range,
          .power = intensity / weight,
          .weight = weight,
          .surface = piece.surface};
}

void ThinEchoes::ask(const PingView& view, Workers& workers, RayList& rays) {
  find_seen(view);
  find_steps(*view.plan, workers);
  if (!steps_.empty()) {
    ask_for_steps(view.world_from_sonar, rays);
  }
}

void ThinEchoes::answer(const PingView& view, const RayAnswers& hits, Workers& workers, RayList&, EchoList& found) {
  if (hits.sights.empty()) {
    return;
  }
  const FlatPlan& plan = *view.plan;
  found.spread.resize(steps_.size());
  constexpr std::size_t kTogether = 256;
  workers.for_each(static_cast<int>((steps_.size() + kTogether - 1) / kTogether), [&](int task, int) {
    const std::size_t first = static_cast<std::size_t>(task) * kTogether;
    for (std::size_t i = first; i < std::min(first + kTogether, steps_.size()); ++i) {
      const std::size_t ray = ray_of_[i / stride_];
      Echo& echo = found.spread[i];
      echo = is_visible(hits, ray) ? echo_of(plan, steps_[i]) : Echo{};
      const auto passed = static_cast<float>(hits.passed(ray));
      echo.power *= passed * passed;
    }
  });
  std::erase_if(found.spread, [](const Echo& echo) { return !(echo.weight > 0); });
}

}  // namespace insonify

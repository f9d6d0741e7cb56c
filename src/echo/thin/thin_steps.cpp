// thin_steps.cpp -- finds the thin pieces that the sonar may receive, and divides them into steps and parts.

#include <algorithm>
#include <cmath>

#include "echo/thin/thin_echoes.h"

namespace insonify {
namespace {

constexpr float kMostOfPiece = 256;  // Most steps of a piece.

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

}  // namespace

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

// Whether each patch of a piece is a part by itself.
bool ThinEchoes::parted(const ThinParts::Piece& piece) const {
  return by_patch_ && (piece.is_strip() || piece.thickness > ThinParts::kThickest);
}

// Divides the pieces into steps. False if there are too many parts.
// @param longer  Factor on the largest length of a step.
bool ThinEchoes::divide(float longer) {
  std::uint32_t steps = 0;
  std::size_t parts = 0;
  for (Seen& seen : seen_) {
    const ThinParts::Piece& piece = parts_->pieces[seen.piece];
    seen.first = steps;
    seen.count = static_cast<std::uint32_t>(std::clamp(std::ceil(seen.wished / longer), 1.0F, kMostOfPiece));
    steps += seen.count;
    parts += std::size_t{seen.count} * (parted(piece) ? piece.last_patch - piece.first_patch : 1);
  }
  return parts <= kMostParts;
}

void ThinEchoes::divide_pieces() {
  static_assert(ThinParts::kMostPieces < kMostParts);  // At most as many parts as pieces in the end.
  for (const bool by_patch : {true, false}) {
    by_patch_ = by_patch;
    for (float longer = 1; longer <= kMostOfPiece; longer *= 2) {
      if (divide(longer)) {
        return;
      }
    }
  }
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
    steps_[seen.first + k] = {seen.piece,
                              seen.group,
                              received ? seen.count : 0,
                              place,
                              mesh_from_sonar_[seen.group] * direction,
                              axis,
                              std::abs(seen.half.dot(direction)) / count};
  }
}

// Finds the steps that the sonar receives.
void ThinEchoes::find_steps(const FlatPlan& plan, Workers& workers) {
  divide_pieces();
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

void ThinEchoes::find_parts() {
  parts_of_steps_.clear();
  for (std::uint32_t i = 0; i < steps_.size(); ++i) {
    const ThinParts::Piece& piece = parts_->pieces[steps_[i].piece];
    if (!parted(piece)) {
      parts_of_steps_.push_back({i, piece.first_patch, piece.last_patch, false});
      continue;
    }
    for (std::uint32_t k = piece.first_patch; k < piece.last_patch; ++k) {
      if (parts_->patches[k].normal.dot(steps_[i].in_mesh) < 0) {
        parts_of_steps_.push_back({i, k, k + 1, true});
      }
    }
  }
}

}  // namespace insonify

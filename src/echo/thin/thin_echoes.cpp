// thin_echoes.cpp -- asks which parts of thin pieces are visible, and integrates the scattering law over them.

#include "echo/thin/thin_echoes.h"

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

// The same of a ray to one patch, whose middle lies inside a round body by up to 0.02 thicknesses.
constexpr float kPatchInFront = 0.05F, kPatchOwnDepth = 0.15F;

// Area times backscattering coefficient of a patch: Lambert's law and the facets' lobe, widened by curvature.
// @param cosine  n . d, negative.
// @param coherence  Share of the lobe that another source computes.
float strength_of(const ThinParts::Patch& patch, const Vec3f& direction, float cosine, const ScatterTable::Laws& laws,
                  std::uint32_t material, float coherence) {
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
                      std::sqrt(widening.share) * (1 - coherence);
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
  steps_.reserve(kMostParts);
  parts_of_steps_.reserve(kMostParts);
  order_.reserve(kMostRays);
  ray_of_.resize(kMostRays);
}

// On the axis, or on the surface for a part that is alone [m].
Vec3f ThinEchoes::place_of(const Part& part) const {
  const Step& step = steps_[part.step];
  return part.alone
             ? Vec3f(step.place + mesh_from_sonar_[step.group].transpose() * parts_->patches[part.first_patch].offset)
             : step.place;
}

// Asks for a line of sight to every n-th part. Neighbouring rays are traced together: they are ordered along a curve
// that fills the fan (Morton order).
void ThinEchoes::ask_for_parts(const Pose& world_from_sonar, RayList& rays) {
  stride_ = (parts_of_steps_.size() + kMostRays - 1) / kMostRays;
  order_.clear();
  for (std::size_t i = 0; i < parts_of_steps_.size(); i += stride_) {
    const Vec3f direction = place_of(parts_of_steps_[i]).normalized();
    constexpr float kUnits = 65535;  // From -1 to 1.
    const auto across = static_cast<std::uint32_t>((0.5F + 0.5F * direction.y()) * kUnits);
    const auto up = static_cast<std::uint32_t>((0.5F + 0.5F * direction.z()) * kUnits);
    order_.push_back(static_cast<std::uint64_t>(interleaved(across) | interleaved(up) << 1) << 32 | i / stride_);
  }
  std::ranges::sort(order_);
  for (const std::uint64_t place : order_) {
    const auto number = static_cast<std::uint32_t>(place);
    ray_of_[number] = static_cast<std::uint32_t>(rays.sights.size());
    ask_for(parts_of_steps_[number * stride_], world_from_sonar, rays);
  }
}

// To a place in front of the piece, beside its axis; or in front of one patch.
void ThinEchoes::ask_for(const Part& part, const Pose& world_from_sonar, RayList& rays) const {
  const Step& step = steps_[part.step];
  const ThinParts::Piece& piece = parts_->pieces[step.piece];
  Vec3f in_front;
  if (part.alone) {
    in_front = kPatchInFront * (mesh_from_sonar_[step.group].transpose() * parts_->patches[part.first_patch].normal);
  } else {
    const Vec3f direction = step.place.normalized();
    const Vec3f beside_axis = -direction + direction.dot(step.axis) * step.axis;
    in_front = kInFront * (beside_axis.squaredNorm() > 1e-6F ? Vec3f(beside_axis.normalized()) : Vec3f(-direction));
  }
  const Vec3 there = (place_of(part) + piece.thickness * in_front).cast<double>();
  const double distance = there.norm();
  const float own_depth = part.alone ? kPatchOwnDepth : kOwnDepth;
  rays.sights.push_back({world_from_sonar.position, world_from_sonar.orientation * (there / distance), 0,
                         std::max(distance - double{kRayClearance}, 0.0)});
  rays.ends.push_back({distance - double{own_depth * piece.thickness}, instance_of(piece.surface)});
}

Echo ThinEchoes::echo_of(const FlatPlan& plan, const Part& part) const {
  const Step& step = steps_[part.step];
  const ThinParts::Piece& piece = parts_->pieces[step.piece];
  const ScatterTable::Laws laws = plan.scatter.laws();
  const std::uint32_t material = laws.index_of(piece.surface);
  const Vec3f place = place_of(part);
  const float distance = place.norm();
  const Vec3f in_mesh = part.alone ? Vec3f(mesh_from_sonar_[step.group] * (place / distance)) : step.in_mesh;
  float strength = 0, depth = 0, facing = 0, half_depth = 0;
  for (std::uint32_t i = part.first_patch; i < part.last_patch; ++i) {
    const ThinParts::Patch& patch = parts_->patches[i];
    const float cosine = patch.normal.dot(in_mesh);
    if (cosine < 0) {
      const double coherence = piece.glints ? coherent_share(plan, piece.surface, double{cosine}) : 0;
      const float of_patch = strength_of(patch, in_mesh, cosine, laws, material, static_cast<float>(coherence));
      strength += of_patch;
      facing -= patch.area * cosine;
      if (piece.is_strip()) {
        half_depth = std::abs(piece.side.dot(in_mesh));
      } else if (part.alone) {  // A patch of a ball reaches half a step of its normals to both sides.
        half_depth = 0.25F * ThinParts::kTurnStep * piece.thickness * std::sqrt(std::max(1 - cosine * cosine, 0.0F));
      } else {
        depth += of_patch * patch.offset.dot(in_mesh);
      }
    }
  }
  if (!(strength > 0)) {
    return {};
  }
  const FlatPlan::Arrival arrival = plan.arrival_from(place / distance);
  const float range = distance + depth / strength, square = range * range;
  const float spread = fast_exp(-4 * plan.neper_per_metre * range) / (square * square);
  const float weight = kWeight * facing / (square * static_cast<float>(step.count));
  const float intensity =
      strength * spread * arrival.sent * arrival.received * arrival.transmitted / static_cast<float>(step.count);
  return {.azimuth = arrival.bearing,
          .elevation = arrival.elevation,
          .path_length = 2 * range,
          .half_length = step.half_range + half_depth,
          .power = intensity / weight,
          .weight = weight,
          .surface = piece.surface};
}

void ThinEchoes::ask(const PingView& view, Workers& workers, RayList& rays) {
  find_seen(view);
  find_steps(*view.plan, workers);
  find_parts();
  if (!parts_of_steps_.empty()) {
    ask_for_parts(view.world_from_sonar, rays);
  }
}

void ThinEchoes::answer(const PingView& view, const RayAnswers& hits, Workers& workers, RayList&, EchoList& found) {
  if (hits.sights.empty()) {
    return;
  }
  const FlatPlan& plan = *view.plan;
  found.spread.resize(parts_of_steps_.size());
  constexpr std::size_t kTogether = 256;
  workers.for_each(static_cast<int>((found.spread.size() + kTogether - 1) / kTogether), [&](int task, int) {
    const std::size_t first = static_cast<std::size_t>(task) * kTogether;
    for (std::size_t i = first; i < std::min(first + kTogether, found.spread.size()); ++i) {
      const std::size_t ray = ray_of_[i / stride_];
      Echo& echo = found.spread[i];
      echo = is_visible(hits, ray) ? echo_of(plan, parts_of_steps_[i]) : Echo{};
      const auto passed = static_cast<float>(hits.passed(ray));
      echo.power *= passed * passed;
    }
  });
  std::erase_if(found.spread, [](const Echo& echo) { return !(echo.weight > 0); });
}

}  // namespace insonify

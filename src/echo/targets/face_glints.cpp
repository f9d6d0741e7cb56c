// face_glints.cpp -- finds the faces at normal incidence, traces a line of sight to each, and computes its echo.

#include "echo/targets/face_glints.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "acoustics/fresnel.h"
#include "base/vector_math.h"
#include "echo/model/coherent_share.h"
#include "echo/targets/fresnel_reach.h"
#include "echo/targets/point_echoes.h"

namespace insonify {
namespace {

constexpr double kLeastShare = 1e-4;  // Least coherent or visible share that counts.
constexpr double kGap = 2e-3;         // Largest distance of a hit on the face from its plane [m].
// Rays to an end of a side aim inside the face by a share of its half length, or by this much of Fresnel's argument if
// that is less.
constexpr double kInside = 0.01, kInsideZone = 0.1;

// Places around the nearest point where rays look whether a face is hidden, in Fresnel's argument. What is hidden
// beyond them changes a glint by less than 0.8 dB.
const Eigen::Vector2d kAround[] = {{2, 0},       {0, 2},        {-2, 0},        {0, -2},
                                   {1.41, 1.41}, {-1.41, 1.41}, {-1.41, -1.41}, {1.41, -1.41}};

// As many probes may differ from the others: a ray exactly along an edge between triangles may pass between them.
constexpr std::size_t kStray = 1;

INSONIFY_VECTOR_CLONES
void find_near(int count, float x, float y, float z, float wavelength, const GlintingFaces::Group& group,
               std::uint8_t* __restrict__ near) {
  const float *const middle_x = group.middle_x.data(), *const middle_y = group.middle_y.data(),
                     *const middle_z = group.middle_z.data();
  const float *const ax = group.first_x.data(), *const ay = group.first_y.data(), *const az = group.first_z.data();
  const float *const bx = group.second_x.data(), *const by = group.second_y.data(), *const bz = group.second_z.data();
  const float *const a_half = group.first_half.data(), *const b_half = group.second_half.data();
  for (int i = 0; i < count; ++i) {
    const float dx = x - middle_x[i], dy = y - middle_y[i], dz = z - middle_z[i];
    const float a = std::abs(dx * ax[i] + dy * ay[i] + dz * az[i]), b = std::abs(dx * bx[i] + dy * by[i] + dz * bz[i]);
    const float distance = std::sqrt(dx * dx + dy * dy + dz * dz);
    const bool is_near = (a < a_half[i] + fresnel_reach(a_half[i], distance, wavelength)) &
                         (b < b_half[i] + fresnel_reach(b_half[i], distance, wavelength));
    near[i] = is_near ? 1 : 0;
  }
}

}  // namespace

double face_glint(const Eigen::Vector2d& foot, const Eigen::Vector2d& half, double distance, double wavelength) {
  const Eigen::Vector2d nearest = foot.cwiseMax(-half).cwiseMin(half);
  const double range = std::hypot(distance, (nearest - foot).norm());
  double sides = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const GlintSide side = GlintSide::of(foot[axis], half[axis], nearest[axis], range, wavelength);
    sides *= std::norm(fresnel_between(side.low, side.high)) / side.bend;
  }
  const double cosine = distance / range;
  return sides * cosine * cosine / (16 * range * range);
}

FaceGlints::FaceGlints(std::shared_ptr<const GlintingFaces> faces) : faces_(std::move(faces)) {
  if (faces_ && faces_->any()) {
    std::size_t most = 0;
    for (const GlintingFaces::Group& group : faces_->groups) {
      most = std::max(most, group.surface.size());
    }
    near_.resize(most);
    shown_.resize(faces_->count());
    static_assert(std::size(kAround) + 1 == kProbes);
    constexpr std::size_t kMostRays =
        std::max(kProbes * GlintingFaces::kMostTogether, kMostPartly * GlintWindow::kCount);
    glints_.reserve(GlintingFaces::kMostTogether);
    partly_.reserve(kMostPartly);
    rays_.reserve(kMostRays);
    hits_.resize(kMostRays);
    ends_.reserve(kMostRays);
    sight_rays_ = SightRays(kMostRays);
  }
}

// Adds glints and rays of the faces of one instance that are at normal incidence.
void FaceGlints::find(const PingPlan& plan, const Pose& world_from_sonar, const Pose& world_from_mesh,
                      const GlintingFaces::Group& group) {
  const Vec3 sonar = world_from_mesh.inverse() * world_from_sonar.position;
  const Pose sonar_from_mesh = world_from_sonar.inverse() * world_from_mesh;
  const Vec3f at = sonar.cast<float>();
  const auto count = static_cast<int>(group.surface.size());
  find_near(count, at.x(), at.y(), at.z(), plan.wavelength(), group, near_.data());
  for (int i = 0; i < count; ++i) {
    if (near_[i] == 0 || glints_.size() == GlintingFaces::kMostTogether) {
      continue;
    }
    const Vec3 middle = Vec3f(group.middle_x[i], group.middle_y[i], group.middle_z[i]).cast<double>(),
               first = Vec3f(group.first_x[i], group.first_y[i], group.first_z[i]).cast<double>(),
               second = Vec3f(group.second_x[i], group.second_y[i], group.second_z[i]).cast<double>();
    const Vec3 from = sonar - middle;
    const Eigen::Vector2d foot(from.dot(first), from.dot(second)), half(group.first_half[i], group.second_half[i]);
    const double distance = std::abs(from.dot(first.cross(second)));
    const Eigen::Vector2d end = foot.cwiseMax(-half).cwiseMin(half);
    const double to_end = std::hypot(distance, (end - foot).norm()), wavelength = double{plan.wavelength()};
    const GlintWindow window{{GlintSide::of(foot[0], half[0], end[0], to_end, wavelength),
                              GlintSide::of(foot[1], half[1], end[1], to_end, wavelength)}};
    const Eigen::Vector2d scale(window.sides[0].scale, window.sides[1].scale);
    const Eigen::Vector2d inside = half - (kInside * half).cwiseMin(kInsideZone * scale.cwiseInverse());
    const Eigen::Vector2d nearest = foot.cwiseMax(-inside).cwiseMin(inside);
    const Vec3 place = middle + nearest[0] * first + nearest[1] * second;
    const double range = (sonar - place).norm();
    const Vec3f direction = (sonar_from_mesh * place).normalized().cast<float>();
    if (!(distance > kGap) || plan.bin_of(static_cast<float>(range)) < 0 || !plan.receives(direction)) {
      continue;
    }
    const double cosine = distance / range, share = coherent_share(plan, group.surface[i], cosine);
    if (share < kLeastShare) {
      continue;
    }
    const PingPlan::Arrival arrival = plan.arrival_from(direction);
    const double reflectance = plan.scatter.scattering(group.surface[i]).reflectance(std::min(cosine, 1.0));
    glints_.push_back({group.instance, group.first_number + static_cast<std::size_t>(i), range,
                       reflectance * share * face_glint(foot, half, distance, wavelength) *
                           std::exp(-4 * double{plan.neper_per_metre} * range) * arrival.both_ways(),
                       arrival, window, world_from_mesh * middle, world_from_mesh.orientation * first,
                       world_from_mesh.orientation * second});
    aim(world_from_sonar.position, glints_.back(), nearest);
    for (const Eigen::Vector2d& probe : kAround) {
      const Eigen::Vector2d beside = nearest + probe.cwiseQuotient(scale);
      aim(world_from_sonar.position, glints_.back(), beside.cwiseMax(-inside).cwiseMin(inside));
    }
  }
}

// Adds a ray to a place on a face.
void FaceGlints::aim(const Vec3& sonar, const Glint& glint, const Eigen::Vector2d& place) {
  const Vec3 there = glint.middle + place[0] * glint.first + place[1] * glint.second - sonar;
  const double range = there.norm();
  rays_.push_back({sonar, there / range, 0, range + kGap});
  ends_.push_back({range - kGap, static_cast<std::uint16_t>(glint.instance)});
}

void FaceGlints::trace(const PingPlan& plan, Engine& engine) {
  sight_rays_.trace(plan, engine, rays_, std::span(hits_).first(rays_.size()), ends_);
}

bool FaceGlints::hidden(std::size_t ray) const {
  return hits_[ray].distance < ends_[ray].from;
}

// Adds a glint of which the given share of the intensity is left.
void FaceGlints::show(const PingPlan& plan, const Glint& glint, double share, EchoGrid& grid) {
  shown_[glint.number] = 1;
  add_discrete_echo(plan, glint.arrival, 1, glint.range, glint.intensity * share, plan.turns_per_metre * glint.range,
                    grid);
}

// Adds the glints of faces that are partly hidden.
void FaceGlints::add_partly(const PingPlan& plan, const Vec3& sonar, Engine& engine, EchoGrid& grid) {
  rays_.clear();
  ends_.clear();
  for (const std::size_t i : partly_) {
    for (int cell = 0; cell < GlintWindow::kCount; ++cell) {
      aim(sonar, glints_[i], glints_[i].window.middle(cell));
    }
  }
  trace(plan, engine);
  std::size_t ray = 0;
  for (const std::size_t i : partly_) {
    std::array<double, GlintWindow::kCount> passed;
    for (double& one : passed) {
      one = hidden(ray) ? 0 : sight_rays_.passed(ray);
      ++ray;
    }
    if (const double share = glints_[i].window.visible(passed); share > kLeastShare) {
      show(plan, glints_[i], share, grid);
    }
  }
}

void FaceGlints::add(const PingPlan& plan, const Pose& world_from_sonar, std::span<const Pose> world_from_mesh,
                     Engine& engine, EchoGrid& grid) {
  for (const Glint& glint : glints_) {
    shown_[glint.number] = 0;
  }
  glints_.clear();
  rays_.clear();
  ends_.clear();
  if (!faces_ || !faces_->any() || plan.rough_mirrors) {
    return;
  }
  for (const GlintingFaces::Group& group : faces_->groups) {
    find(plan, world_from_sonar, world_from_mesh[group.instance], group);
  }
  trace(plan, engine);
  partly_.clear();
  for (std::size_t i = 0; i < glints_.size(); ++i) {
    const std::size_t probe = kProbes * i;
    std::size_t hidden_probes = 0;
    for (std::size_t k = 0; k < kProbes; ++k) {
      hidden_probes += hidden(probe + k) ? 1 : 0;
    }
    const bool partly = hidden_probes > kStray && hidden_probes + kStray < kProbes;
    if (partly && partly_.size() < kMostPartly) {
      partly_.push_back(i);
    } else if (2 * hidden_probes < kProbes && (hidden(probe) || hits_[probe].instance == glints_[i].instance)) {
      const double passed = sight_rays_.passed(probe);
      show(plan, glints_[i], passed * passed, grid);
    }
  }
  if (!partly_.empty()) {
    add_partly(plan, world_from_sonar.position, engine, grid);
  }
}

}  // namespace insonify

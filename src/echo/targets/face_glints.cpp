// face_glints.cpp -- finds the faces at normal incidence, asks whether they are hidden, and computes their echoes.

#include "echo/targets/face_glints.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "acoustics/diffraction.h"
#include "base/vector_math.h"
#include "echo/model/flat_plan.h"
#include "echo/targets/glint_window.h"
#include "echo/targets/point_echoes.h"

namespace insonify {
namespace {

constexpr double kLeastShare = 1e-4;  // Least coherent or visible share that counts.
// Largest distance of a hit on the face from its plane [m]: less than the thickness from which both sides of a sheet
// glint, lest its near side passes for the far one.
constexpr double kGap = 0.75 * GlintingFaces::kThinnest;
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

// Whether something hides the place that a ray aims at.
bool is_hidden(const RayAnswers& hits, std::size_t ray) {
  return hits.sights[ray].distance < hits.asked.ends[ray].from;
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

FaceGlints::FaceGlints(std::shared_ptr<const GlintingFaces> faces) : faces_(std::move(faces)), shown_(faces_->count()) {
  static_assert(std::size(kAround) + 1 == kProbes);
  std::size_t most = 0;
  for (const GlintingFaces::Group& group : faces_->groups) {
    most = std::max(most, group.surface.size());
  }
  near_.resize(most);
}

// Adds glints and rays of the faces of one instance that are at normal incidence.
void FaceGlints::find(const FlatPlan& plan, const Pose& world_from_sonar, const Pose& world_from_mesh,
                      const GlintingFaces::Group& group, RayList& rays) {
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
    const double height = from.dot(first.cross(second)), distance = std::abs(height);
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
    const bool behind = group.covered[i] * height > 0;  // The nearer side of the sheet glints instead.
    if (behind || !(distance > kGap) || plan.bin_of(static_cast<float>(range)) < 0 || !plan.receives(direction)) {
      continue;
    }
    const double cosine = distance / range, share = coherent_share(plan, group.surface[i], cosine);
    if (share < kLeastShare) {
      continue;
    }
    const FlatPlan::Arrival arrival = plan.arrival_from(direction);
    const double reflectance = plan.scatter.scattering(group.surface[i]).reflectance(std::min(cosine, 1.0));
    glints_.push_back({group.instance, group.first_number + static_cast<std::size_t>(i), range,
                       reflectance * share * face_glint(foot, half, distance, wavelength) *
                           std::exp(-4 * double{plan.neper_per_metre} * range) * arrival.both_ways(),
                       arrival, window, world_from_mesh * middle, world_from_mesh.orientation * first,
                       world_from_mesh.orientation * second});
    glints_.back().aim(world_from_sonar.position, nearest, rays);
    for (const Eigen::Vector2d& probe : kAround) {
      const Eigen::Vector2d beside = nearest + probe.cwiseQuotient(scale);
      glints_.back().aim(world_from_sonar.position, beside.cwiseMax(-inside).cwiseMin(inside), rays);
    }
  }
}

void FaceGlints::Glint::aim(const Vec3& sonar, const Eigen::Vector2d& place, RayList& rays) const {
  const Vec3 there = middle + place[0] * first + place[1] * second - sonar;
  const double distance = there.norm();
  rays.sights.push_back({sonar, there / distance, 0, distance + kGap});
  rays.ends.push_back({distance - kGap, static_cast<std::uint16_t>(instance)});
}

// Adds a glint of which the given share of the intensity is left.
void FaceGlints::show(const FlatPlan& plan, const Glint& glint, double share, EchoList& found) {
  shown_[glint.number] = 1;
  add_discrete_echo(plan, glint.arrival, 1, glint.range, glint.intensity * share, plan.turns_per_metre * glint.range,
                    found);
}

void FaceGlints::ask(const PingView& view, Workers&, RayList& rays) {
  for (const Glint& glint : glints_) {
    shown_[glint.number] = 0;
  }
  glints_.clear();
  stage_ = Stage::kDone;
  if (view.plan->rough_mirrors) {
    return;
  }
  for (const GlintingFaces::Group& group : faces_->groups) {
    find(*view.plan, view.world_from_sonar, (*view.placement)[group.instance], group, rays);
  }
  stage_ = glints_.empty() ? Stage::kDone : Stage::kProbes;
}

void FaceGlints::answer(const PingView& view, const RayAnswers& hits, Workers&, RayList& more, EchoList& found) {
  if (stage_ == Stage::kProbes) {
    answer_probes(view, hits, more, found);
  } else if (stage_ == Stage::kPartly) {
    answer_partly(view, hits, found);
  }
}

// Adds the glints of faces that are not hidden, and asks for more rays to those that are partly hidden.
void FaceGlints::answer_probes(const PingView& view, const RayAnswers& hits, RayList& more, EchoList& found) {
  partly_.clear();
  for (std::size_t i = 0; i < glints_.size(); ++i) {
    const std::size_t probe = kProbes * i;
    std::size_t hidden_probes = 0;
    for (std::size_t k = 0; k < kProbes; ++k) {
      hidden_probes += is_hidden(hits, probe + k) ? 1 : 0;
    }
    const bool partly = hidden_probes > kStray && hidden_probes + kStray < kProbes;
    if (partly && partly_.size() < kMostPartly) {
      partly_.push_back(i);
    } else if (2 * hidden_probes < kProbes &&
               (is_hidden(hits, probe) || hits.sights[probe].instance == glints_[i].instance)) {
      const double passed = hits.passed(probe);
      show(*view.plan, glints_[i], passed * passed, found);
    }
  }
  for (const std::size_t i : partly_) {
    for (int cell = 0; cell < GlintWindow::kCount; ++cell) {
      glints_[i].aim(view.world_from_sonar.position, glints_[i].window.middle(cell), more);
    }
  }
  stage_ = partly_.empty() ? Stage::kDone : Stage::kPartly;
}

// Adds the glints of faces that are partly hidden.
void FaceGlints::answer_partly(const PingView& view, const RayAnswers& hits, EchoList& found) {
  std::size_t ray = 0;
  for (const std::size_t i : partly_) {
    std::array<double, GlintWindow::kCount> passed;
    for (double& one : passed) {
      one = is_hidden(hits, ray) ? 0 : hits.passed(ray);
      ++ray;
    }
    if (const double share = glints_[i].window.visible(passed); share > kLeastShare) {
      show(*view.plan, glints_[i], share, found);
    }
  }
  stage_ = Stage::kDone;
}

}  // namespace insonify

// reference_column.cpp -- the echoes of one lattice column, in the order of docs/concepts.

#include "echo/reference/reference_column.h"

#include <algorithm>
#include <cmath>

#include "echo/model/hit.h"

namespace insonify {
ColumnFrame::ColumnFrame(const Lattice& lattice, int column, const Pose& world_from_sonar) {
  const double cosine = lattice.cos_azimuth[column], sine = lattice.sin_azimuth[column];
  const bool cone = lattice.shape == BeamShape::kCone;
  const Eigen::Quaterniond& turn = world_from_sonar.orientation;
  along = turn * Vec3(cosine, cone ? 0 : sine, 0);
  up = turn * Vec3(0, 0, cone ? cosine : 1);
  across = cone ? turn * Vec3(0, cosine, 0) : up.cross(along);
  beside = turn * Vec3(0, cone ? sine : 0, 0);
}

Vec3 ColumnFrame::direction(const Lattice& lattice, int column, int row) const {
  return (along * double{lattice.cosines(column)[row]} + up * double{lattice.sines(column)[row]} + beside).normalized();
}

ReferenceColumn::ReferenceColumn(const TriangleScene& scene, const LeftOut* left_out, const FlatPlan& plan,
                                 SecondarySampling sampling, int column, const Pose& world_from_sonar)
    : scene_(scene),
      left_out_(left_out),
      plan_(plan),
      sampling_(sampling),
      column_(column),
      rows_(plan.lattice.rows),
      world_from_sonar_(world_from_sonar),
      frame_(plan.lattice, column, world_from_sonar),
      rays_(rows_),
      first_(rows_),
      strip_(1, rows_),
      hits_(strip_.column(0)),
      segments_(rows_) {
  hits_.rows = rows_;
  hits_.has_relief = scene.has_relief();
}

Ray ReferenceColumn::ray_of(int column, int row) const {
  const ColumnFrame frame = column == column_ ? frame_ : ColumnFrame(plan_.lattice, column, world_from_sonar_);
  return {world_from_sonar_.position, frame.direction(plan_.lattice, column, row), 0, plan_.true_max_range};
}

// Traces one ray per row to its first surface.
void ReferenceColumn::trace_primary_rays(const Workers& workers) {
  for (int row = 0; row < rows_; ++row) {
    workers.check_stop();
    rays_[row] = ray_of(column_, row);
    first_[row] = scene_.nearest(rays_[row]);
    if (first_[row].met()) {
      store_hit(row);
    }
  }
  counts_.primary += rows_;
  make_normals_unit(plan_, hits_);
}

void ReferenceColumn::store_hit(int row) {
  const RayHit& hit = first_[row];
  const Vec3f normal = hit.normal.cast<float>(), direction = rays_[row].direction.cast<float>();
  hits_.surface[row] = hit.surface();
  hits_.triangle[row] = scene_.in_mesh(hit);
  hits_.range[row] = static_cast<float>(hit.distance);
  hits_.normal_x[row] = normal.x();
  hits_.normal_y[row] = normal.y();
  hits_.normal_z[row] = normal.z();
  hits_.reflectivity[row] = hit.reflectivity;
  hits_.gradient_x[row] = hit.gradient.x();
  hits_.gradient_y[row] = hit.gradient.y();
  hits_.gradient_z[row] = hit.gradient.z();
  hits_.texture[row] = hit.texture;
  hits_.direction_x[row] = direction.x();
  hits_.direction_y[row] = direction.y();
  hits_.direction_z[row] = direction.z();
}

// scattering.md, "Curved surfaces".
precise::LobeWidening ReferenceColumn::widening(int row) const {
  if (!hits_.curved) {
    return {1, 0};
  }
  const precise::Triple up = {hits_.turn_up_x[row], hits_.turn_up_y[row], hits_.turn_up_z[row]};
  const precise::Triple side = {hits_.turn_side_x[row], hits_.turn_side_y[row], hits_.turn_side_z[row]};
  const Vec3 ray = rays_[row].direction, normal = hits_.has_relief ? first_[row].bent : first_[row].normal;
  return precise::widen_lobe(precise::turn_products(up, side, precise::triple_of(ray), precise::triple_of(normal)),
                             normal.dot(ray),
                             precise::scatterer_of(plan_.scatter.scattering(hits_.surface[row])).steepness);
}

// What each row's echo adds to the grid per unit of solid angle: docs/concepts/calibrated-model.md, "An echo", and
// paper-model.md, "From a hit to an echo".
void ReferenceColumn::compute_powers() {
  const double gamma = plan_.neper_per_metre;
  for (int row = 0; row < rows_; ++row) {
    if (!first_[row].met()) {
      hits_.strength[row] = hits_.power[row] = 0;
    } else if (plan_.model == EchoModel::kCalibrated) {
      const double texture = hits_.has_relief ? first_[row].texture : 1.0F;
      const double share = hits_.has_relief
                               ? precise::facet_share(precise::triple_of(first_[row].gradient.cast<double>()),
                                                      precise::triple_of(rays_[row].direction), hits_.facing[row])
                               : 1.0;
      hits_.power[row] = static_cast<float>(
          share * precise::primary_intensity_of(plan_.scatter.scattering(hits_.surface[row]), hits_.facing[row],
                                                texture, gamma, first_[row].distance, widening(row)));
    } else {
      const double strength =
          precise::paper_strength(hits_.facing[row], first_[row].reflectivity, gamma, 2 * first_[row].distance);
      hits_.strength[row] = static_cast<float>(strength);
      hits_.power[row] = static_cast<float>(plan_.shape.model().shape(strength));
    }
  }
}

// How the echoes of the rows are spread over range bins: paper-model.md, "From echoes to bins".
void ReferenceColumn::deposit_primary_echoes(SecondarySampling sampling, EchoGrid& grid) {
  SurfaceSums sums;
  sums.prepare(plan_.bin_count);
  measure_column(
      plan_, column_,
      {frame_.along.cast<float>(), frame_.across.cast<float>(), frame_.up.cast<float>(), frame_.beside.cast<float>()},
      hits_, segments_);
  find_passing(plan_, hits_);
  compute_powers();
  weaken_behind(plan_, hits_);
  if (left_out_ != nullptr) {
    leave_out(*left_out_, plan_, hits_);
  }
  finish_column(plan_, sampling, column_, hits_, segments_);
  deposit_column(plan_, column_, hits_, segments_, sums, grid);
}

// The same ray once more, from behind its hit.
void ReferenceColumn::trace_behind(const Workers& workers) {
  for (int row = 0; row < rows_; ++row) {
    workers.check_stop();
    const float passed = hits_.passing && first_[row].met() ? hits_.passed[row] : 0.0F;
    hits_.reached[row] = passed;
    if (passed > 0) {
      rays_[row].min_distance = first_[row].distance + double{kRayClearance};
      ++counts_.primary;
    }
    first_[row] = passed > 0 ? scene_.nearest(rays_[row]) : RayHit{};
    if (first_[row].met()) {
      store_hit(row);
    } else {
      hits_.surface[row] = kNoSurface;
      hits_.range[row] = hits_.reflectivity[row] = 0;
    }
  }
  hits_.passing = true;
  make_normals_unit(plan_, hits_);
}

void ReferenceColumn::insonify(EchoGrid& grid, std::vector<Echo>& arrivals, const Workers& workers) {
  deposit_primary_echoes(sampling_, grid);
  for (int row = 0; row < rows_ && sampling_ != SecondarySampling::kNone; ++row) {
    workers.check_stop();
    if (hits_.selected[row] == 0) {
      continue;
    }
    const std::optional<Reflection> path = reflect(row);
    if (path && plan_.model == EchoModel::kCalibrated) {
      deposit_mirror_echoes(*path, grid, arrivals);
    } else if (path) {
      deposit_paper_echo(*path, grid);
    }
  }
}

}  // namespace insonify

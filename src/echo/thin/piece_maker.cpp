// piece_maker.cpp -- sorts the surface of a piece by its normals.

#include "echo/thin/piece_maker.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "echo/laws/laws.h"

namespace insonify {
namespace {

constexpr float kTurnStep = ThinParts::kTurnStep;
constexpr float kStraight = 1e-3F;  // Spreads of unit normals below this are rounding.
// Variance of the normals of a curved bin, in squares of kTurnStep: Gaussians of this variance at even steps have a sum
// that is constant within 0.06 dB (2 exp(-2 pi^2 x 0.25) = 1.4 %).
constexpr float kBinVariance = 0.25F;

// Turn of a patch whose normals have this standard deviation, as in TurnProducts.
float turn_of(float deviation) {
  return deviation / std::sqrt(kFootprintVariance);
}

// Normals of round pieces are binned by their place on the sides of a cube around the piece.
Vec3f normal_on_cube(const std::array<int, 3>& key, int side) {
  Vec3f normal;
  normal[side % 3] = side < 3 ? 1 : -1;
  normal[(side + 1) % 3] = std::tan(kTurnStep * static_cast<float>(key[1]));
  normal[(side + 2) % 3] = std::tan(kTurnStep * static_cast<float>(key[2]));
  return normal.normalized();
}

}  // namespace

PieceMaker::PieceMaker(const std::vector<Facet>& facets, bool by_patch) {
  for (const Facet& facet : facets) {
    area_ += facet.area;
    middle_ += facet.area * facet.middle;
  }
  middle_ /= area_;
  Eigen::Matrix3f covariance = Eigen::Matrix3f::Zero();
  for (const Facet& facet : facets) {
    const Vec3f from = facet.middle - middle_;
    covariance += facet.area / area_ * (from * from.transpose() + facet.spread);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver(covariance);
  axis_ = solver.eigenvectors().col(2).normalized();
  one_ = axis_.unitOrthogonal();
  two_ = axis_.cross(one_);
  float curved_area = 0, square = 0;
  for (const Facet& facet : facets) {
    const float rise = rise_of(facet), area = facet.curved ? facet.area : 0;
    curved_area += area;
    square += area * rise * rise;
  }
  round_ = square > curved_area * kTurnStep * kTurnStep;
  // A straight piece of length l has a variance of l^2 / 12 along its axis. A round one has no section that is the same
  // all along it.
  constexpr float kLong = 2;
  const Vec3f& variance = solver.eigenvalues();
  half_ = !(round_ && by_patch) && variance[2] > kLong * variance[1] ? Vec3f(std::sqrt(3 * variance[2]) * axis_)
                                                                     : Vec3f(Vec3f::Zero());
  for (const Facet& facet : facets) {
    sort(facet);
  }
}

void PieceMaker::add_patches(std::vector<ThinParts::Patch>& patches) const {
  for (const auto& [key, bin] : bins_) {
    ThinParts::Patch patch{};
    patch.area = bin.area;
    const Vec3f from = bin.place / bin.area - middle_;
    patch.offset = from - (half_.isZero() ? 0.0F : from.dot(axis_)) * axis_;
    if (key[0] == kFlatBin) {
      patch.normal = bin.normal.normalized();
      patch.around = patch.along = Vec3f::Zero();
    } else if (key[0] == kAroundAxis) {
      turn_around_axis(key, bin, patch);
    } else {
      patch.normal = normal_on_cube(key, key[0] - kOnCube);
      patch.around = turn_of(std::sqrt(kBinVariance) * kTurnStep) * patch.normal.unitOrthogonal();
      patch.along = patch.normal.cross(patch.around);
    }
    patches.push_back(patch);
  }
}

void PieceMaker::turn_around_axis(const Key& key, const Bin& bin, ThinParts::Patch& patch) const {
  const float angle = kTurnStep * static_cast<float>(key[1]), rise = bin.along / bin.area;
  const Vec3f out = std::cos(angle) * one_ + std::sin(angle) * two_;
  patch.normal = std::cos(rise) * out + std::sin(rise) * axis_;
  const float around = turn_of(std::sqrt(kBinVariance) * kTurnStep) * std::cos(rise);
  patch.around = around * (std::cos(angle) * two_ - std::sin(angle) * one_);
  // Along the axis a bin is uniform, with a variance of w^2/12, where it is full.
  const float variance = std::max(bin.along_square / bin.area - rise * rise, 0.0F);
  const float along = variance < kStraight * kStraight ? 0.0F : turn_of(std::sqrt(12 * kBinVariance * variance));
  patch.along = along * (std::cos(rise) * axis_ - std::sin(rise) * out);
}

void PieceMaker::add(const Key& key, const Facet& facet, float share, float rise) {
  if (share > 0) {
    Bin& bin = bins_[key];
    const float area = share * facet.area;
    bin.area += area;
    bin.along += area * rise;
    bin.along_square += area * rise * rise;
    bin.normal += area * facet.normal;
    bin.place += area * facet.middle;
  }
}

// Angle between the normal and the cross section [rad].
float PieceMaker::rise_of(const Facet& facet) const {
  return std::asin(std::clamp(facet.normal.dot(axis_), -1.0F, 1.0F));
}

// Flat facets are binned by their normal.
void PieceMaker::sort(const Facet& facet) {
  if (facet.curved && round_) {
    sort_on_cube(facet);
  } else if (facet.curved) {
    sort_around_axis(facet);
  } else {
    constexpr float kFlatTurn = 0.01F;
    const Vec3f rounded = facet.normal / kFlatTurn;
    const auto x = static_cast<int>(std::lround(rounded.x())), y = static_cast<int>(std::lround(rounded.y())),
               z = static_cast<int>(std::lround(rounded.z()));
    add({kFlatBin, x * 512 + y, z}, facet, 1, 0);
  }
}

// The area of a curved facet is shared between the two nearest of the evenly spaced normals around the axis (linear
// interpolation), so that a round rod's echo does not depend on its roll.
void PieceMaker::sort_around_axis(const Facet& facet) {
  constexpr int kAround = 24;
  const float rise = rise_of(facet);
  const float angle = std::atan2(facet.normal.dot(two_), facet.normal.dot(one_)) / kTurnStep + kAround;
  const int below = static_cast<int>(angle), along = static_cast<int>(std::lround(rise / kTurnStep));
  const float share = angle - static_cast<float>(below);
  add({kAroundAxis, below % kAround, along}, facet, 1 - share, rise);
  add({kAroundAxis, (below + 1) % kAround, along}, facet, share, rise);
}

// The same between the four nearest normals on the sides of a cube. Around an axis these would crowd at its ends, where
// a ball was 0.6 dB louder.
void PieceMaker::sort_on_cube(const Facet& facet) {
  int side = 0;
  const float most = facet.normal.cwiseAbs().maxCoeff(&side);
  const float one = std::atan(facet.normal[(side + 1) % 3] / most) / kTurnStep, below_one = std::floor(one);
  const float two = std::atan(facet.normal[(side + 2) % 3] / most) / kTurnStep, below_two = std::floor(two);
  for (int k = 0; k < 4; ++k) {
    const int up_one = k % 2, up_two = k / 2;
    const float share =
        (up_one == 1 ? one - below_one : 1 - one + below_one) * (up_two == 1 ? two - below_two : 1 - two + below_two);
    add({kOnCube + (facet.normal[side] > 0 ? side : side + 3), static_cast<int>(below_one) + up_one,
         static_cast<int>(below_two) + up_two},
        facet, share, 0);
  }
}

}  // namespace insonify

// piece_maker.h -- middle, axis and patches of a piece of a thin part, from its surface.

#pragma once

#include <array>
#include <map>
#include <vector>

#include "echo/thin/thin_parts.h"

namespace insonify {

/// A small part of the surface with nearly constant normal.
struct Facet {
  Vec3f middle, normal;
  float area;
  Eigen::Matrix3f spread;  ///< Covariance of its points [m^2].
  bool curved;
};

/// Computes middle and axis of a piece from its facets, and bins their area by normal.
class PieceMaker {
 public:
  /// @param by_patch  Whether each patch has an echo at its own place: then a round piece has no axis.
  PieceMaker(const std::vector<Facet>& facets, bool by_patch);

  [[nodiscard]] const Vec3f& middle() const { return middle_; }
  [[nodiscard]] const Vec3f& half() const { return half_; }  ///< ThinParts::Piece::half
  void add_patches(std::vector<ThinParts::Patch>& patches) const;

 private:
  // Sums over the facets of one bin of normals, weighted by area.
  struct Bin {
    float area = 0;
    float along = 0, along_square = 0;  // Angle between normal and cross section [rad], and its square.
    Vec3f normal = Vec3f::Zero(), place = Vec3f::Zero();
  };
  enum Kind { kFlatBin, kAroundAxis, kOnCube };
  using Key = std::array<int, 3>;  // Kind (kOnCube + side, 0..5), and two numbers of the normal.

  [[nodiscard]] float rise_of(const Facet& facet) const;
  void add(const Key& key, const Facet& facet, float share, float rise);
  void sort(const Facet& facet);
  void sort_around_axis(const Facet& facet);
  void sort_on_cube(const Facet& facet);
  void turn_around_axis(const Key& key, const Bin& bin, ThinParts::Patch& patch) const;

  float area_ = 0;
  Vec3f middle_ = Vec3f::Zero(), half_, axis_, one_, two_;
  bool round_ = false;  // Curved along the axis too, as a ball.
  std::map<Key, Bin> bins_;
};

}  // namespace insonify

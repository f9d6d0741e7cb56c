// paper_shape.h -- how strong an echo is in the `paper` model, and how strongly it is drawn.

#pragma once

#include "insonify/paper_model.h"

namespace insonify {

/// The paper's sigmoid S with its scaling worked out: S(x) = scale / (1 + exp(-slope (x - midpoint))) + offset.
class PaperShape {
 public:
  explicit PaperShape(const PaperModel& model);

  /// S of one strength, 0..1.
  [[nodiscard]] float operator()(float strength) const;

  /// S of `count` strengths; may be done in place.
  void apply(int count, const float* strength, float* power) const;

 private:
  bool linear_;  // S(x) = x
  float slope_ = 0, midpoint_ = 0, scale_ = 1, offset_ = 0;
};

}  // namespace insonify

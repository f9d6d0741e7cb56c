// paper_shape.h -- the paper's sigmoid for many strengths at once.

#pragma once

#include "echo/laws/laws.h"
#include "insonify/paper_model.h"

namespace insonify {

/// PaperModel::shape() in single precision, with precomputed constants.
class PaperShape {
 public:
  explicit PaperShape(const PaperModel& model);

  /// The model it was made from, whose shape() is the same function in double precision.
  [[nodiscard]] const PaperModel& model() const { return model_; }

  /// Constants of the sigmoid; without one they mean nothing.
  [[nodiscard]] const Logistic& terms() const { return logistic_; }

  /// S of `count` strengths; `power` may be the same array as `strength`.
  void apply(int count, const float* strength, float* power) const;

 private:
  PaperModel model_;
  Logistic logistic_;
};

}  // namespace insonify

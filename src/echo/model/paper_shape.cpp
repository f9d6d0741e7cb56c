// paper_shape.cpp -- the sigmoid of the paper's eq. (energy_norm).

#include "echo/model/paper_shape.h"

#include <algorithm>
#include <cmath>

#include "base/vector_math.h"

namespace insonify {
namespace {

double logistic(double x, double midpoint, double slope) {
  return 1 / (1 + std::exp(-slope * (x - midpoint)));
}

// 0.5 tanh(9 (x - 2/3)) + 0.5, as the authors' code has it, is the logistic of twice the slope.
constexpr double kAuthorsMidpoint = 2.0 / 3.0;
constexpr double kAuthorsSlope = 18;

INSONIFY_VECTOR_CLONES
void apply_logistic(int count, float slope, float midpoint, float scale, float offset, const float* strength,
                    float* power) {
  for (int i = 0; i < count; ++i) {
    const float shaped = scale / (1 + fast_exp(-slope * (strength[i] - midpoint))) + offset;
    power[i] = shaped > 0 ? shaped : 0.0F;
  }
}

}  // namespace

double PaperModel::shape(double strength) const {
  switch (sigmoid) {
    case Sigmoid::kAuthors:
      return logistic(strength, kAuthorsMidpoint, kAuthorsSlope);
    case Sigmoid::kLogistic: {
      const double at_zero = logistic(0, sigmoid_midpoint, sigmoid_slope);
      const double at_one = logistic(1, sigmoid_midpoint, sigmoid_slope);
      return (logistic(strength, sigmoid_midpoint, sigmoid_slope) - at_zero) / (at_one - at_zero);
    }
    case Sigmoid::kNone:
      break;
  }
  return strength;
}

PaperShape::PaperShape(const PaperModel& model) : linear_(model.sigmoid == Sigmoid::kNone) {
  if (model.sigmoid == Sigmoid::kAuthors) {
    slope_ = static_cast<float>(kAuthorsSlope);
    midpoint_ = static_cast<float>(kAuthorsMidpoint);
  } else if (model.sigmoid == Sigmoid::kLogistic) {
    const double at_zero = logistic(0, model.sigmoid_midpoint, model.sigmoid_slope);
    const double at_one = logistic(1, model.sigmoid_midpoint, model.sigmoid_slope);
    slope_ = static_cast<float>(model.sigmoid_slope);
    midpoint_ = static_cast<float>(model.sigmoid_midpoint);
    scale_ = static_cast<float>(1 / (at_one - at_zero));
    offset_ = static_cast<float>(-at_zero / (at_one - at_zero));
  }
}

float PaperShape::operator()(float strength) const {
  return linear_ ? strength : std::max(0.0F, scale_ / (1 + fast_exp(-slope_ * (strength - midpoint_))) + offset_);
}

void PaperShape::apply(int count, const float* strength, float* power) const {
  if (linear_) {
    std::copy_n(strength, count, power);
  } else {
    apply_logistic(count, slope_, midpoint_, scale_, offset_, strength, power);
  }
}

}  // namespace insonify

// paper_shape.cpp -- the sigmoid of the paper's eq. (energy_norm), for one strength and for many.

#include "echo/model/paper_shape.h"

#include <algorithm>
#include <cmath>

#include "base/vector_math.h"
#include "echo/laws/laws.h"

namespace insonify {
namespace {

precise::Logistic logistic_of(const PaperModel& model) {
  if (model.sigmoid == Sigmoid::kAuthors) {
    // 0.5 tanh(9 (x - 2/3)) + 0.5, as the authors' code has it, is the logistic of twice the slope.
    return {.slope = 18, .midpoint = 2.0 / 3.0, .scale = 1, .offset = 0};
  }
  const double slope = model.sigmoid_slope, midpoint = model.sigmoid_midpoint;
  const double at_zero = 1 / (1 + std::exp(-slope * (0 - midpoint)));
  const double at_one = 1 / (1 + std::exp(-slope * (1 - midpoint)));
  return {slope, midpoint, 1 / (at_one - at_zero), -at_zero / (at_one - at_zero)};
}

// Every value depends on its own strength alone, so that the loop may be vectorised even where both arrays are the
// same.
INSONIFY_VECTOR_CLONES
void apply_logistic(int count, Logistic terms, const float* strength, float* power) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    power[i] = logistic(terms, strength[i]);
  }
}

}  // namespace

void PaperModel::validate() const {
  check_fields("paper", *this);
}

double PaperModel::shape(double strength) const {
  if (sigmoid == Sigmoid::kNone) {
    return strength;
  }
  return precise::logistic(logistic_of(*this), strength);
}

PaperShape::PaperShape(const PaperModel& model) : model_(model) {
  const precise::Logistic terms = logistic_of(model);
  logistic_ = {static_cast<float>(terms.slope), static_cast<float>(terms.midpoint), static_cast<float>(terms.scale),
               static_cast<float>(terms.offset)};
}

void PaperShape::apply(int count, const float* strength, float* power) const {
  if (model_.sigmoid == Sigmoid::kNone) {
    std::copy_n(strength, count, power);
  } else {
    apply_logistic(count, logistic_, strength, power);
  }
}

}  // namespace insonify

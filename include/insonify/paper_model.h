// paper_model.h -- the settings of the `paper` model: Cerqueira et al., "A rasterized ray-tracer pipeline for
// real-time, multi-device sonar simulation" (2020), section 3, with its errors corrected
// (docs/concepts/paper-model.md).

#pragma once

#include "insonify/settings_table.h"
#include "insonify/words.h"

namespace insonify {

/// Shape of the function S of the paper, which maps an echo's strength, 0..1, to displayed intensity, 0..1.
enum class Sigmoid {
  kLogistic,  ///< A logistic with `sigmoid_midpoint` and `sigmoid_slope`, scaled so that S(0) = 0 and S(1) = 1.
  kAuthors,   ///< The authors' code: 0.5 tanh(9 (x - 2/3)) + 0.5, unscaled: a logistic of midpoint 2/3 and slope 18.
  kNone       ///< S(x) = x.
};
template <>
constexpr auto words_of<Sigmoid>() {
  return EnumWords<Sigmoid, 3>{
      {{"logistic", Sigmoid::kLogistic}, {"authors", Sigmoid::kAuthors}, {"none", Sigmoid::kNone}}};
}

struct PaperModel {
  Sigmoid sigmoid = Sigmoid::kLogistic;
  double sigmoid_midpoint = 0.1;  ///< Strength that is drawn at half (before scaling), 0..1.
  double sigmoid_slope = 12;      ///< Steepness at the midpoint, times 4, in (0, 1e6].

  // Noise: intensity x multiplicative + additive, both Gaussian and independent for every ping, beam and bin.
  double multiplicative_mean = 1.0;        ///< 0..1e6. The authors' code has 0.4.
  double multiplicative_deviation = 0.25;  ///< 0..1e6. The authors' code has 0.15.
  double additive_deviation = 0.01;        ///< 0..1e6, about a zero mean. The authors' code has none.

  /// S(strength), for strength in 0..1.
  [[nodiscard]] double shape(double strength) const;

  /// @throws Error on the first field out of limits.
  void validate() const;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"sigmoid", "", {}, "logistic, authors (their code's) or none.", ActsIn::kPaper}, self.sigmoid);
    visit(
        Field{"sigmoid_midpoint", "", from_to(0, 1), "Echo strength that is drawn at half (logistic).", ActsIn::kPaper},
        self.sigmoid_midpoint);
    visit(Field{"sigmoid_slope", "", above_to(0, 1e6),
                "Steepness of the sigmoid, four times its slope at the midpoint (logistic).", ActsIn::kPaper},
          self.sigmoid_slope);
    visit(Field{"multiplicative_mean", "", from_to(0, 1e6), "Mean of the multiplicative noise.", ActsIn::kPaper,
                "receiver.gains_db"},
          self.multiplicative_mean);
    visit(Field{"multiplicative_deviation", "", from_to(0, 1e6), "Standard deviation of the multiplicative noise.",
                ActsIn::kPaper, "receiver.speckle"},
          self.multiplicative_deviation);
    visit(Field{"additive_deviation", "", from_to(0, 1e6), "Standard deviation of the additive noise, whose mean is 0.",
                ActsIn::kPaper, "receiver.ambient_noise_db"},
          self.additive_deviation);
  }
};

}  // namespace insonify

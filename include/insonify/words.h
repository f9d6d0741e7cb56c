// words.h -- spelling of enumerators in files and in Python.

#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "insonify/engine.h"
#include "insonify/ground_truth.h"
#include "insonify/paper_model.h"
#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"

namespace insonify {

template <typename Enum, std::size_t count>
using Words = std::array<std::pair<std::string_view, Enum>, count>;

/// The words of an enumeration, in the order of messages.
template <typename Enum>
constexpr auto words_of();

template <>
constexpr auto words_of<SonarType>() {
  return Words<SonarType, 2>{{{"fls", SonarType::kForwardLooking}, {"msis", SonarType::kMechanicallyScanned}}};
}

template <>
constexpr auto words_of<Mounting>() {
  return Words<Mounting, 2>{{{"horizontal", Mounting::kHorizontal}, {"vertical", Mounting::kVertical}}};
}

template <>
constexpr auto words_of<Mapping>() {
  return Words<Mapping, 2>{{{"gamma", Mapping::kGamma}, {"logarithmic", Mapping::kLogarithmic}}};
}

template <>
constexpr auto words_of<Steering>() {
  return Words<Steering, 2>{{{"electronic", Steering::kElectronic}, {"lens", Steering::kLens}}};
}

template <>
constexpr auto words_of<Sigmoid>() {
  return Words<Sigmoid, 3>{
      {{"logistic", Sigmoid::kLogistic}, {"authors", Sigmoid::kAuthors}, {"none", Sigmoid::kNone}}};
}

template <>
constexpr auto words_of<PrimaryEchoes>() {
  return Words<PrimaryEchoes, 3>{
      {{"auto", PrimaryEchoes::kAuto}, {"rays", PrimaryEchoes::kRays}, {"raster", PrimaryEchoes::kRaster}}};
}
template <>
constexpr auto words_of<EchoModel>() {
  return Words<EchoModel, 2>{{{"paper", EchoModel::kPaper}, {"calibrated", EchoModel::kCalibrated}}};
}
template <>
constexpr auto words_of<BeamPattern>() {
  return Words<BeamPattern, 8>{{{"top_hat", BeamPattern::kTopHat},
                                {"rectangular", BeamPattern::kRectangular},
                                {"hann", BeamPattern::kHann},
                                {"hamming", BeamPattern::kHamming},
                                {"cosine", BeamPattern::kCosine},
                                {"taylor", BeamPattern::kTaylor},
                                {"dolph_chebyshev", BeamPattern::kDolphChebyshev},
                                {"instrument", BeamPattern::kInstrument}}};
}
template <>
constexpr auto words_of<BeamShape>() {
  return Words<BeamShape, 2>{{{"wedge", BeamShape::kWedge}, {"cone", BeamShape::kCone}}};
}
template <>
constexpr auto words_of<PulseKind>() {
  return Words<PulseKind, 4>{{{"none", PulseKind::kNone},
                              {"cw", PulseKind::kCw},
                              {"lfm", PulseKind::kLfm},
                              {"instrument", PulseKind::kInstrument}}};
}
template <>
constexpr auto words_of<PulseWindow>() {
  return Words<PulseWindow, 5>{{{"rectangular", PulseWindow::kRectangular},
                                {"hann", PulseWindow::kHann},
                                {"hamming", PulseWindow::kHamming},
                                {"cosine", PulseWindow::kCosine},
                                {"taylor", PulseWindow::kTaylor}}};
}
template <>
constexpr auto words_of<Decimation>() {
  return Words<Decimation, 3>{
      {{"peak", Decimation::kPeak}, {"mean", Decimation::kMean}, {"sample", Decimation::kSample}}};
}
template <>
constexpr auto words_of<SecondaryEchoes>() {
  return Words<SecondaryEchoes, 3>{
      {{"none", SecondaryEchoes::kNone}, {"selective", SecondaryEchoes::kSelective}, {"all", SecondaryEchoes::kAll}}};
}
template <>
constexpr auto words_of<GroundTruth>() {
  return Words<GroundTruth, 3>{
      {{"none", GroundTruth::kNone}, {"labels", GroundTruth::kLabels}, {"full", GroundTruth::kFull}}};
}

/// Spelling of a value in files.
template <typename Enum>
constexpr std::string_view word_of(Enum value) {
  for (const auto& [word, meaning] : words_of<Enum>()) {
    if (meaning == value) {
      return word;
    }
  }
  return {};
}

}  // namespace insonify

// sounding_columns.cpp -- names, types, units and meanings of the tables of soundings.

#include "io/file/sounding_columns.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace insonify {
namespace {

const SoundingColumn kColumns[] = {
    {"sounding_range", &Sounding::range, "m", "Slant range of the bottom in each beam; NaN where none was found."},
    {"sounding_uncertainty", &Sounding::uncertainty, "m", "Standard deviation of sounding_range."},
    {"sounding_quality", &Sounding::quality, "1", "log10(range / uncertainty); 0 where no bottom was found."},
    {"sounding_intensity", &Sounding::intensity, "1", "Mean echo intensity of the bins of the bottom's echo."},
    {"sounding_snippet_begin", &Sounding::snippet_begin, "1", "First bin of the bottom's echo."},
    {"sounding_snippet_end", &Sounding::snippet_end, "1", "Bin behind its last; equal to the first without an echo."},
    {"sounding_detection", &Sounding::detection, "1",
     "How the bottom was found: 0 not at all, 1 by amplitude, 2 by phase."},
};

template <typename Member>
struct ValueOfMember;
template <typename Value>
struct ValueOfMember<Value Sounding::*> {
  using type = Value;
};

}  // namespace

const char* SoundingColumn::type() const {
  return std::visit(
      [](auto of) {
        using Value = typename ValueOfMember<decltype(of)>::type;
        return std::is_same_v<Value, float> ? "<f4" : std::is_same_v<Value, std::int32_t> ? "<i4" : "|u1";
      },
      member);
}

void SoundingColumn::store(std::span<const Sounding> soundings, std::vector<std::byte>& values) const {
  std::visit(
      [&](auto of) {
        using Value = typename ValueOfMember<decltype(of)>::type;
        values.resize(soundings.size() * sizeof(Value));
        std::byte* into = values.data();
        for (const Sounding& sounding : soundings) {
          std::memcpy(into, &(sounding.*of), sizeof(Value));
          into += sizeof(Value);
        }
      },
      member);
}

void SoundingColumn::restore(std::span<const double> numbers, std::span<Sounding> soundings) const {
  std::visit(
      [&](auto of) {
        using Value = typename ValueOfMember<decltype(of)>::type;
        for (std::size_t i = 0; i < soundings.size(); ++i) {
          if constexpr (std::is_same_v<Value, Detection>) {
            soundings[i].*of = numbers[i] == 1   ? Detection::kAmplitude
                               : numbers[i] == 2 ? Detection::kPhase
                                                 : Detection::kNone;
          } else if constexpr (std::is_integral_v<Value>) {
            constexpr double kMost = std::numeric_limits<Value>::max();  // Strangers' files may hold anything.
            soundings[i].*of = std::abs(numbers[i]) <= kMost ? static_cast<Value>(numbers[i]) : 0;
          } else {
            soundings[i].*of = static_cast<Value>(numbers[i]);
          }
        }
      },
      member);
}

std::span<const SoundingColumn> sounding_columns() {
  return kColumns;
}

}  // namespace insonify

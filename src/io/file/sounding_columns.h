// sounding_columns.h -- the soundings of a multibeam's pings, as stored in recordings: a table for each member.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "insonify/sounding.h"

namespace insonify {

struct SoundingColumn {
  const char* name;
  std::variant<float Sounding::*, std::int32_t Sounding::*, Detection Sounding::*> member;
  const char *units, *description;

  [[nodiscard]] const char* type() const;  ///< Type of a value in the file, as NumPy spells it: "<f4", "<i4", "|u1".

  /// Its value of each sounding, as in the file.
  void store(std::span<const Sounding> soundings, std::vector<std::byte>& values) const;

  /// Sets it from the numbers of a table, one for each sounding.
  void restore(std::span<const double> numbers, std::span<Sounding> soundings) const;
};

/// All members but the azimuth, which is that of the beam. Recordings of multibeams have these tables, others none.
[[nodiscard]] std::span<const SoundingColumn> sounding_columns();

}  // namespace insonify

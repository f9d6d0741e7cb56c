// bearing_response.cpp -- tabulates the array's beam pattern as gain matrices: once for all pings, or where that would
// need too much memory, in each.

#include "receiver/array/bearing_response.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "base/interruption.h"

namespace insonify {
namespace {

// Sets the bins of `bins` that are not in `kept` to 0 in every row of `beams`, [beam][bin].
template <typename Value>
void clear_outside(std::span<Value> beams, int bin_count, BinRange bins, BinRange kept) {
  const int first = kept.empty() ? bins.last : kept.first, last = kept.empty() ? bins.last : kept.last;
  for (std::size_t start = 0; start < beams.size(); start += bin_count) {
    const auto row = beams.subspan(start, bin_count);
    std::fill(row.begin() + bins.first, row.begin() + first, Value{});
    std::fill(row.begin() + last, row.begin() + bins.last, Value{});
  }
}

}  // namespace

BearingResponse::BearingResponse(const ArrayPattern& pattern, double length, std::span<const double> cell_sines,
                                 std::span<const double> beam_sines, double floor_db, const Extras& extras)
    : pattern_(pattern),
      length_(length),
      element_(extras.element),
      beam_sines_(beam_sines.begin(), beam_sines.end()),
      cell_sines_(cell_sines.begin(), cell_sines.end()),
      cell_edges_(extras.cell_edges.begin(), extras.cell_edges.end()) {
  assert(cell_edges_.empty() || cell_edges_.size() == cell_sines.size() + 1);
  for (int cell = 0; cell < cell_count(); ++cell) {
    const double width = cell_edges_.empty() ? 0 : length_ * (cell_edges_[cell] - cell_edges_[cell + 1]);
    if (width > kWideCell) {
      wide_.push_back(cell);
      widest_ = std::max(widest_, 0.5 * width);
    }
  }
  const double floor = std::pow(10, floor_db / 10);
  defocus(extras, floor);
  if (std::ranges::any_of(focuses_, [](const Focus& focus) { return focus.tables.empty(); })) {
    fill_in_focus(floor);
  }
}

std::complex<double> BearingResponse::focused_gain(int beam, double u) const {
  const std::complex<double> array = pattern_.amplitude(length_ * (u - beam_sines_[beam]));
  return element_.is_flat() ? array : array * std::sqrt(element_.intensity(u));
}

const BearingResponse::Focus& BearingResponse::focus_at(int bin) const {
  const auto focus = std::ranges::find_if(focuses_, [&](const Focus& each) { return bin < each.end; });
  return focus == focuses_.end() ? focuses_.back() : *focus;
}

std::complex<double> BearingResponse::gain(int beam, double u, int bin) const {
  const Focus& focus = focus_at(bin);
  if (focus.tables.empty()) {
    return focused_gain(beam, u);
  }
  const std::complex<double> array = tables_->amplitude(focus.tables[beam], length_ * (u - beam_sines_[beam]));
  return element_.is_flat() ? array : array * std::sqrt(element_.intensity(u));
}

// Mean of |g|^2 over a cell.
// @param gain  Gain of the sine of a bearing.
template <typename Gain>
double BearingResponse::mean_intensity(int cell, const Gain& gain) const {
  constexpr double kStep = 1.0 / 16;  // [wavelength / D]
  const double from = cell_edges_[cell + 1], to = cell_edges_[cell];
  const int steps = static_cast<int>(std::ceil(length_ * (to - from) / kStep));
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    sum += std::norm(std::complex<double>(gain(from + (i + 0.5) / steps * (to - from))));
  }
  return sum / steps;
}

void BearingResponse::fill_in_focus(double floor) {
  const int cells = cell_count(), beams = beam_count();
  in_focus_.energy = in_focus_.in_phase = GainMatrix(beams, cells);
  if (!pattern_.is_real()) {
    in_focus_.quadrature = GainMatrix(beams, cells);
  }
  for (int beam = 0; beam < beams; ++beam) {
    check_interruption();  // Thousands of beams take seconds.
    const auto gain_at = [&](double u) { return focused_gain(beam, u); };
    int first = cells, last = 0;
    for (int cell = 0; cell < cells; ++cell) {
      const std::complex<double> gain = std::ranges::binary_search(wide_, cell)
                                            ? std::sqrt(mean_intensity(cell, gain_at))
                                            : gain_at(cell_sines_[cell]);
      in_focus_.energy.set(beam, cell, static_cast<float>(std::norm(gain)));
      in_focus_.in_phase.set(beam, cell, static_cast<float>(gain.real()));
      if (in_focus_.quadrature.beam_count() > 0) {
        in_focus_.quadrature.set(beam, cell, static_cast<float>(gain.imag()));
      }
      if (std::norm(gain) >= floor) {
        first = std::min(first, cell);
        last = cell + 1;
      }
    }
    for (GainMatrix* matrix : {&in_focus_.energy, &in_focus_.in_phase, &in_focus_.quadrature}) {
      if (matrix->beam_count() > 0) {
        matrix->limit(beam, first, last);
      }
    }
  }
}

// Chooses the table of each beam in each zone.
void BearingResponse::defocus(const Extras& extras, double floor) {
  if (extras.zones.empty()) {
    focuses_.emplace_back();
    return;
  }
  for (const double sine : cell_sines_) {
    places_.push_back(static_cast<float>(length_ * sine));
    element_gains_.push_back(static_cast<float>(std::sqrt(element_.is_flat() ? 1 : element_.intensity(sine))));
  }
  double steered = 0;
  for (const double sine : beam_sines_) {
    steered = std::max(steered, std::abs(sine));
  }
  tables_.emplace(pattern_, extras.elements, length_ * (1 + steered), floor);
  for (const Zone& zone : extras.zones) {
    Focus& focus = focuses_.emplace_back();
    focus.end = zone.end;
    for (std::size_t beam = 0; zone.edge_phase != 0 && beam < beam_sines_.size(); ++beam) {
      const double sine = beam_sines_[beam];  // The projected length of a steered array is shorter.
      focus.tables.push_back(tables_->table_for(zone.edge_phase * (1 - sine * sine)));
    }
  }
  keep_gains(extras.most_kept);
}

// From the nearest zone on, as each costs a ping the same.
void BearingResponse::keep_gains(std::size_t most) {
  const std::size_t blocks = (beam_sines_.size() + GainMatrix::kBlockBeams - 1) / GainMatrix::kBlockBeams;
  const std::size_t of_zone = 3 * blocks * GainMatrix::kBlockBeams * cell_sines_.size();
  for (Focus& focus : focuses_) {
    if (focus.tables.empty() || kept_ + of_zone > most) {
      continue;
    }
    check_interruption();
    Scratch scratch;
    for (GainMatrix* matrix : {&scratch.gains.energy, &scratch.gains.in_phase, &scratch.gains.quadrature}) {
      matrix->reshape(beam_count(), cell_count());
    }
    for (std::size_t block = 0; block < blocks; ++block) {
      for (const bool energy : {true, false}) {
        set_block(focus, static_cast<int>(block), 0, energy, scratch);
      }
    }
    focus.kept = std::move(scratch.gains);
    kept_ += of_zone;
  }
}

// Sets the gains of a block of beams, out of focus, within the band of its cells.
// @param first_beam  The first beam of block 0.
void BearingResponse::set_block(const Focus& focus, int block, int first_beam, bool energy, Scratch& scratch) const {
  Gains& gains = scratch.gains;
  const int begin = block * GainMatrix::kBlockBeams;
  const int end = std::min(begin + GainMatrix::kBlockBeams, gains.energy.beam_count());
  int first = cell_count(), last = 0;
  for (int i = begin; i < end; ++i) {
    const DefocusedTables::Extent extent = tables_->extent_of(focus.tables[first_beam + i]);
    const double steered = length_ * beam_sines_[first_beam + i];
    const auto from = std::ranges::partition_point(
        places_, [&](float place) { return double{place} > steered + extent.high + widest_; });
    const auto to = std::partition_point(from, places_.end(),
                                         [&](float place) { return double{place} >= steered + extent.low - widest_; });
    if (from != to) {
      first = std::min(first, static_cast<int>(from - places_.begin()));
      last = std::max(last, static_cast<int>(to - places_.begin()));
    }
  }
  const std::size_t count = std::max(0, last - first);
  scratch.in_phase.resize(cell_sines_.size());
  scratch.quadrature.resize(cell_sines_.size());
  float *const real = scratch.in_phase.data(), *const imaginary = scratch.quadrature.data();
  for (int i = begin; i < end && count > 0; ++i) {
    const int beam = first_beam + i, table = focus.tables[beam];
    tables_->look_up(table, length_ * beam_sines_[beam], std::span(places_).subspan(first, count),
                     std::span(element_gains_).subspan(first, count), real + first, imaginary + first);
    for (const int cell : wide_) {
      const auto gain_at = [&](double u) { return tables_->amplitude(table, length_ * (u - beam_sines_[beam])); };
      real[cell] = element_gains_[cell] * static_cast<float>(std::sqrt(mean_intensity(cell, gain_at)));
      imaginary[cell] = 0;
    }
    float *const energies = gains.energy.row(i), *const in_phase = gains.in_phase.row(i),
                 *const quadrature = gains.quadrature.row(i);
    for (int cell = first; cell < last; ++cell) {
      const std::ptrdiff_t at = std::ptrdiff_t{GainMatrix::kBlockBeams} * cell;
      if (energy) {
        energies[at] = real[cell] * real[cell] + imaginary[cell] * imaginary[cell];
      } else {
        in_phase[at] = real[cell];
        quadrature[at] = imaginary[cell];
      }
    }
  }
  for (GainMatrix* matrix : {&gains.energy, &gains.in_phase, &gains.quadrature}) {
    matrix->limit(begin, first, last);
  }
}

// Calls receive(gains, first beam, bins) with the gains of some beams in some of the bins, until all have been
// received.
// @param energy  Whether `energy` of the gains is used, or else the other two.
template <typename Receive>
void BearingResponse::for_each_part(BinRange bins, bool energy, const Receive& receive) const {
  constexpr int kMostGains = 1 << 18;  // A megabyte. A product packs its cells once for all of its beams.
  const int blocks = std::max(1, kMostGains / (GainMatrix::kBlockBeams * cell_count()));
  thread_local Scratch some;
  int first = bins.first;
  for (const Focus& focus : focuses_) {
    const int last = &focus == &focuses_.back() ? bins.last : std::min(bins.last, focus.end);
    if (first >= last) {
      continue;
    }
    const BinRange part{first, last};
    first = last;
    if (focus.tables.empty() || focus.kept) {
      receive(focus.kept ? *focus.kept : in_focus_, 0, part);
      continue;
    }
    for (int beam = 0; beam < beam_count(); beam += blocks * GainMatrix::kBlockBeams) {
      const int count = std::min(blocks * GainMatrix::kBlockBeams, beam_count() - beam);
      for (GainMatrix* matrix : {&some.gains.energy, &some.gains.in_phase, &some.gains.quadrature}) {
        matrix->reshape(count, cell_count());
      }
      for (int block = 0; block * GainMatrix::kBlockBeams < count; ++block) {
        set_block(focus, block, beam, energy, some);
      }
      receive(some.gains, beam, part);
    }
  }
}

std::vector<GainZone> BearingResponse::zones() const {
  std::vector<GainZone> zones;
  for (const Focus& focus : focuses_) {
    const Gains& gains = focus.kept ? *focus.kept : in_focus_;
    zones.push_back({.end = focus.end,
                     .in_phase = gains.in_phase.table(),
                     .quadrature = gains.quadrature.beam_count() > 0 ? gains.quadrature.table() : GainTable()});
  }
  return zones;
}

void BearingResponse::receive_energy(std::span<const float> cells, std::span<float> beams, int bin_count, BinRange bins,
                                     BinRange filled) const {
  assert(cells.size() == static_cast<std::size_t>(cell_count()) * bin_count);
  assert(beams.size() == static_cast<std::size_t>(beam_count()) * bin_count);
  const BinRange received = bins & filled;
  clear_outside(beams, bin_count, bins, received);
  for_each_part(received, true, [&](const Gains& gains, int beam, BinRange part) {
    float* const to = &beams[static_cast<std::size_t>(beam) * bin_count];
    gains.energy.multiply(cells.data(), to, bin_count, part.first, part.last);
  });
}

// A complex row is processed as 2 x bin_count floats, because a real gain multiplies both parts alike. The imaginary
// part of a gain multiplies i x field: add_turned() swaps the two floats of each value and negates one.
void BearingResponse::receive_field(std::span<const std::complex<float>> cells, std::span<std::complex<float>> beams,
                                    int bin_count, BinRange bins, BinRange filled) const {
  assert(cells.size() == static_cast<std::size_t>(cell_count()) * bin_count);
  assert(beams.size() == static_cast<std::size_t>(beam_count()) * bin_count);
  const auto* from = reinterpret_cast<const float*>(cells.data());
  const BinRange received = bins & filled;
  clear_outside(beams, bin_count, bins, received);
  for_each_part(received, false, [&](const Gains& gains, int beam, BinRange part) {
    auto* const to = reinterpret_cast<float*>(&beams[static_cast<std::size_t>(beam) * bin_count]);
    const int stride = 2 * bin_count, first = 2 * part.first, last = 2 * part.last;
    gains.in_phase.multiply(from, to, stride, first, last);
    if (gains.quadrature.beam_count() > 0) {
      gains.quadrature.add_turned(from, to, stride, first, last);
    }
  });
}

}  // namespace insonify

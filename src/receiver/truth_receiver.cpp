// truth_receiver.cpp -- instances ranked, orders compared, shadows measured, the direct echo heard.

#include "receiver/truth_receiver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "echo/surface_tally.h"

namespace insonify {
namespace {

constexpr int kBeamsATask = 16;  // One cache line of a row of the ping.
constexpr int kBinsATask = 64;

// All that one instance gave to a bin.
struct InstanceEcho {
  std::uint16_t instance, material;  // The latter of its strongest surface in one cell.
  float energy, strongest_surface;
  double elevation_moment, elevation_square;
};

// Instances that the cells of a slice may name: a scanning head's eight cells of kSurfacesKept each.
class Instances {
 public:
  void clear() { count_ = 0; }

  void add(const SurfaceEcho& echo) {
    const std::uint16_t instance = instance_of(echo.surface);
    auto* const end = echoes_.data() + count_;
    auto* entry = std::find_if(echoes_.data(), end, [&](const auto& known) { return known.instance == instance; });
    if (entry == end) {
      *entry = {instance, kNoLabel, 0, 0, 0, 0};
      ++count_;
    }
    entry->energy += echo.energy;
    entry->elevation_moment += double{echo.elevation_moment};
    entry->elevation_square += double{echo.elevation_square};
    if (echo.energy > entry->strongest_surface) {
      entry->strongest_surface = echo.energy;
      entry->material = material_of(echo.surface);
    }
  }

  // The strongest first; of equals that which comes first in the scene.
  [[nodiscard]] std::span<const InstanceEcho> strongest() {
    const std::ptrdiff_t wanted = std::min(count_, kStrongestCount);
    std::partial_sort(echoes_.begin(), echoes_.begin() + wanted, echoes_.begin() + count_,
                      [](const InstanceEcho& a, const InstanceEcho& b) {
                        return a.energy != b.energy ? a.energy > b.energy : a.instance < b.instance;
                      });
    return {echoes_.data(), static_cast<std::size_t>(wanted)};
  }

 private:
  std::array<InstanceEcho, BearingCells::kMostPerBeam * kSurfacesKept> echoes_;  // The first count_.
  int count_ = 0;
};

void add_surfaces(const SurfaceTally& tally, Instances& instances) {
  for (const SurfaceEcho& echo : tally) {
    if (echo.surface != kNoSurface) {
      instances.add(echo);
    }
  }
}

// Of the bin at `at` of the tables, whose echoes have `energy` in all.
void tell_strongest(std::span<const InstanceEcho> strongest, float energy, float middle_elevation, std::size_t at,
                    Ping& ping) {
  std::uint16_t* instance = &ping.strongest_instance[kStrongestCount * at];
  float* share = &ping.strongest_share[kStrongestCount * at];
  std::fill_n(instance, kStrongestCount, kNoLabel);
  std::fill_n(share, kStrongestCount, 0.0F);
  ping.instance[at] = ping.material[at] = kNoLabel;
  ping.elevation[at] = ping.elevation_spread[at] = std::numeric_limits<float>::quiet_NaN();
  if (strongest.empty()) {
    return;
  }
  for (std::size_t k = 0; k < strongest.size(); ++k) {
    instance[k] = strongest[k].instance;
    share[k] = std::min(strongest[k].energy / energy, 1.0F);
  }
  const InstanceEcho& first = strongest[0];
  ping.instance[at] = first.instance;
  ping.material[at] = first.material;
  const double mean = first.elevation_moment / double{first.energy};
  const double variance = first.elevation_square / double{first.energy} - mean * mean;
  ping.elevation[at] = middle_elevation + static_cast<float>(mean);
  ping.elevation_spread[at] = static_cast<float>(std::sqrt(std::max(variance, 0.0)));
}

}  // namespace

TruthReceiver::TruthReceiver(const SonarConfig& sonar, const BearingCells& cells, std::span<const float> cell_angles)
    : beams_(sonar.beam_count),
      bins_(sonar.bin_count),
      cells_(cells.sonar.beam_count),
      first_cell_(cells.first),
      cells_per_beam_(cells.per_beam),
      middle_elevation_(static_cast<float>(sonar.elevation_center)),
      angle_(cell_angles.begin(), cell_angles.end()) {}

void TruthReceiver::tell(const EchoGrid& grid, const Hearing& hearing, Workers& workers, Ping& ping) {
  hear_direct(grid, hearing, workers, ping);
  workers.for_each((beams_ + kBeamsATask - 1) / kBeamsATask, [&](int task, int) {
    const int first_beam = task * kBeamsATask, last_beam = std::min(first_beam + kBeamsATask, beams_);
    Instances instances;
    for (int first_bin = 0; first_bin < bins_; first_bin += kBinsATask) {
      for (int beam = first_beam; beam < last_beam; ++beam) {
        for (int bin = first_bin; bin < std::min(first_bin + kBinsATask, bins_); ++bin) {
          const float energy = tell_order(grid, beam, bin, ping);
          instances.clear();
          if (energy > 0) {  // Mostly it is not, and tallies lie far away.
            for_each_cell(beam, [&](int cell) {
              if (grid.filled(cell).has(bin)) {
                add_surfaces(grid.tallies(cell)[bin], instances);
              }
            });
          }
          tell_strongest(instances.strongest(), energy, middle_elevation_, ping.index(bin, beam), ping);
        }
      }
    }
    for (int beam = first_beam; beam < last_beam; ++beam) {
      tell_shadow(grid, beam, ping);
    }
  });
  for (const LoneEcho& echo : grid.lone_echoes()) {
    tell_lone_echo(grid, echo, ping);
  }
}

void TruthReceiver::hear_direct(const EchoGrid& grid, const Hearing& hearing, Workers& workers, Ping& ping) {
  direct_.resize(static_cast<std::size_t>(cells_) * bins_);
  direct_beams_.resize(hearing.bearing != nullptr ? static_cast<std::size_t>(beams_) * bins_ : 0);
  workers.for_each(cells_, [&](int cell, int) {
    const std::span<float> beam(&direct_[static_cast<std::size_t>(cell) * bins_], static_cast<std::size_t>(bins_));
    std::ranges::copy(grid.energy(1, cell), beam.begin());
    if (hearing.range != nullptr) {
      const BinRange heard = hearing.range->heard_from(grid.filled(cell), bins_);
      const auto within = [&](auto of_row) { return of_row.subspan(heard.first, heard.last - heard.first); };
      hearing.range->hear_energy(within(grid.energy(1, cell)), within(beam));
    }
  });
  BinRange heard;
  for (int cell = 0; cell < cells_; ++cell) {
    const BinRange filled = grid.filled(cell);
    heard = heard | (hearing.range != nullptr ? hearing.range->heard_from(filled, bins_) : filled);
  }
  std::vector<float>& energy = hearing.bearing != nullptr ? direct_beams_ : direct_;
  const int tasks = (bins_ + kBinsATask - 1) / kBinsATask;
  if (hearing.bearing != nullptr) {
    workers.for_each(tasks, [&](int task, int) {
      const int first = task * kBinsATask, last = std::min(first + kBinsATask, bins_);
      hearing.bearing->hear_energy(direct_, direct_beams_, bins_, {first, last}, heard);
    });
  }
  hearing.lone->add(grid.lone_echoes(), energy, 1);
  workers.for_each(tasks, [&](int task, int) {
    for (int bin = task * kBinsATask; bin < std::min((task + 1) * kBinsATask, bins_); ++bin) {
      for (int beam = 0; beam < beams_; ++beam) {
        ping.direct_intensity[ping.index(bin, beam)] =
            energy[static_cast<std::size_t>(beam) * bins_ + bin] * hearing.gain[bin];
      }
    }
  });
}

// Returns the energy of all orders.
float TruthReceiver::tell_order(const EchoGrid& grid, int beam, int bin, Ping& ping) const {
  float all = 0, most = 0;
  std::uint8_t order_of_most = 0;
  for (int order = 1; order <= grid.order_count(); ++order) {
    float energy = 0;
    for_each_cell(beam, [&](int cell) { energy += grid.energy(order, cell)[bin]; });
    all += energy;
    if (energy > most) {
      most = energy;
      order_of_most = static_cast<std::uint8_t>(order);
    }
  }
  ping.path_order[ping.index(bin, beam)] = order_of_most;
  return all;
}

// It is direct, and its bin no shadow: what hides it would have kept it from being heard.
void TruthReceiver::tell_lone_echo(const EchoGrid& grid, const LoneEcho& echo, Ping& ping) const {
  const int own = echo.beam - first_cell_;
  const int beam = own / cells_per_beam_;
  if (echo.order == 0 || own < 0 || beam >= beams_) {
    return;
  }
  float most = 0;
  for (int order = 1; order <= grid.order_count(); ++order) {
    float energy = 0;
    for_each_cell(beam, [&](int cell) { energy += grid.energy(order, cell)[echo.bin]; });
    most = std::max(most, energy);
  }
  const std::size_t at = ping.index(echo.bin, beam);
  ping.shadow[at] = 0;
  ping.path_order[at] = echo.intensity > most ? std::uint8_t{1} : ping.path_order[at];
}

// Each surface hides what lies behind it in its own directions: the solid angle met so far is hidden from there on.
void TruthReceiver::tell_shadow(const EchoGrid& grid, int beam, Ping& ping) const {
  float whole = 0, hidden = 0;
  for_each_cell(beam, [&](int cell) {
    whole += angle_[cell];
    hidden += grid.met_before(cell);
  });
  for (int bin = 0; bin < bins_; ++bin) {
    float met = 0, heard = 0;
    for_each_cell(beam, [&](int cell) {
      met += grid.weight(1, cell)[bin];
      heard += grid.energy(1, cell)[bin];
    });
    const bool direct = met > 0 || heard > 0;
    ping.shadow[ping.index(bin, beam)] = direct ? 0.0F : std::min(hidden / whole, 1.0F);
    hidden += met;
  }
}

}  // namespace insonify

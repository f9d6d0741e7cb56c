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
constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();

// All that one instance gave to a bin.
struct InstanceEcho {
  std::uint16_t instance = kNoLabel;
  std::uint16_t material = kNoLabel;  // Of its strongest surface.
  float energy = 0, strongest_surface = 0;
  double elevation_moment = 0, elevation_square = 0;
};

// Instances that the cells of a slice may name: a scanning head's eight cells of kSurfacesKept each.
class Instances {
 public:
  void add(const SurfaceEcho& echo) {
    const std::uint16_t instance = instance_of(echo.surface);
    auto* const end = echoes_.data() + count_;
    auto* entry = std::find_if(echoes_.data(), end, [&](const auto& known) { return known.instance == instance; });
    if (entry == end) {
      *entry = {.instance = instance};
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
  std::array<InstanceEcho, BearingCells::kMostPerBeam * kSurfacesKept> echoes_;
  int count_ = 0;
};

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
    for (int first_bin = 0; first_bin < bins_; first_bin += kBinsATask) {
      for (int beam = first_beam; beam < last_beam; ++beam) {
        for (int bin = first_bin; bin < std::min(first_bin + kBinsATask, bins_); ++bin) {
          tell_surfaces(grid, beam, bin, ping);
          tell_order(grid, beam, bin, ping);
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
    const std::span<float> heard(&direct_[static_cast<std::size_t>(cell) * bins_], static_cast<std::size_t>(bins_));
    if (hearing.range != nullptr) {
      hearing.range->hear_energy(grid.energy(1, cell), heard);
    } else {
      std::ranges::copy(grid.energy(1, cell), heard.begin());
    }
  });
  std::vector<float>& energy = hearing.bearing != nullptr ? direct_beams_ : direct_;
  const int tasks = (bins_ + kBinsATask - 1) / kBinsATask;
  if (hearing.bearing != nullptr) {
    workers.for_each(tasks, [&](int task, int) {
      const int first = task * kBinsATask, last = std::min(first + kBinsATask, bins_);
      hearing.bearing->hear_energy(direct_, direct_beams_, bins_, {first, last});
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

void TruthReceiver::tell_surfaces(const EchoGrid& grid, int beam, int bin, Ping& ping) const {
  Instances instances;
  float total = 0;  // Of all echoes, those that no surface is named for included.
  for_each_cell(beam, [&](int cell) {
    for (const SurfaceEcho& echo : grid.tallies(cell)[bin]) {
      if (echo.surface != kNoSurface) {
        instances.add(echo);
      }
    }
    for (int order = 1; order <= grid.order_count(); ++order) {
      total += grid.energy(order, cell)[bin];
    }
  });
  const std::span<const InstanceEcho> strongest = instances.strongest();
  const InstanceEcho first = strongest.empty() ? InstanceEcho{} : strongest[0];
  const std::size_t at = ping.index(bin, beam);
  ping.instance[at] = first.instance;
  ping.material[at] = first.material;
  const double energy = first.energy;
  const double mean = first.elevation_moment / energy;
  const double variance = first.elevation_square / energy - mean * mean;
  ping.elevation[at] = energy > 0 ? middle_elevation_ + static_cast<float>(mean) : kNotANumber;
  ping.elevation_spread[at] = energy > 0 ? static_cast<float>(std::sqrt(std::max(variance, 0.0))) : kNotANumber;
  for (std::size_t k = 0; k < kStrongestCount; ++k) {
    const bool named = k < strongest.size();
    ping.strongest_instance[kStrongestCount * at + k] = named ? strongest[k].instance : kNoLabel;
    ping.strongest_share[kStrongestCount * at + k] = named ? std::min(strongest[k].energy / total, 1.0F) : 0.0F;
  }
}

void TruthReceiver::tell_order(const EchoGrid& grid, int beam, int bin, Ping& ping) const {
  float most = 0;
  std::uint8_t order_of_most = 0;
  for (int order = 1; order <= grid.order_count(); ++order) {
    float energy = 0;
    for_each_cell(beam, [&](int cell) { energy += grid.energy(order, cell)[bin]; });
    if (energy > most) {
      most = energy;
      order_of_most = static_cast<std::uint8_t>(order);
    }
  }
  ping.path_order[ping.index(bin, beam)] = order_of_most;
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

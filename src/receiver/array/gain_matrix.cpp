// gain_matrix.cpp -- blocked matrix product in tiles of 8 beams x 16 values, whose sums stay in registers.
//
// A strip of 16 values from up to 256 cells is packed into a panel that fits the first-level cache; all beams then read
// it from there. This is the only file compiled with fused multiply-adds (CMakeLists.txt), which make the product twice
// as fast as separate multiplications and additions. Eigen's product takes four times as long, because Eigen is
// compiled for the oldest supported processor.

#include "receiver/array/gain_matrix.h"

#include <algorithm>

#include "base/vector_math.h"

namespace insonify {
namespace {

constexpr int kBlockBeams = GainMatrix::kBlockBeams;
constexpr int kStrip = 16;        // Floats: one cache line.
constexpr int kPanelCells = 256;  // 16 KiB: a panel and the gains it is multiplied by fit the first-level cache.

struct alignas(64) Panel {
  float values[kPanelCells][kStrip];
};
struct alignas(64) Tile {
  float sums[kBlockBeams][kStrip];
};

// Values processed at once: with AVX-512 each of the eight sums is one register of 16 floats; with NEON it is two
// registers of 4.
#ifdef __x86_64__
constexpr int kLanes = 16;
#else
constexpr int kLanes = 8;
#endif

// tile.sums[beam][v] = sum over cells of gains[cell][beam] values[cell][v]. The innermost loop is one vector
// instruction. It must not be unrolled before the compiler has vectorized it, or the sums do not stay in registers;
// hence the pragmas.
INSONIFY_FUSED_CLONES
void sum_tile(const float* __restrict__ gains, const float (*__restrict__ values)[kStrip], int cells,
              Tile& __restrict__ tile) {
  for (int lane = 0; lane < kStrip; lane += kLanes) {
    float sums[kBlockBeams][kLanes] = {};
    for (int cell = 0; cell < cells; ++cell) {
#pragma GCC unroll 8
      for (int beam = 0; beam < kBlockBeams; ++beam) {
#pragma GCC unroll 1
        for (int v = 0; v < kLanes; ++v) {
          sums[beam][v] += values[cell][lane + v] * gains[cell * kBlockBeams + beam];
        }
      }
    }
    for (int beam = 0; beam < kBlockBeams; ++beam) {
      std::copy_n(sums[beam], kLanes, &tile.sums[beam][lane]);
    }
  }
}

// Copies columns [0, count) of `cell_count` rows into the panel, multiplied by i if `turned`, and fills the strip up
// with zeros.
template <bool turned>
void pack(const float* cells, int stride, int cell_count, int count, Panel& panel) {
  for (int cell = 0; cell < cell_count; ++cell) {
    float* packed = panel.values[cell];
    const float* row = cells + static_cast<std::size_t>(cell) * stride;
    if (count < kStrip) {
      std::fill_n(packed, kStrip, 0.0F);
    }
    if constexpr (!turned) {
      count == kStrip ? std::copy_n(row, kStrip, packed) : std::copy_n(row, count, packed);
    } else {
      for (int i = 0; i < count; i += 2) {
        packed[i] = -row[i + 1];
        packed[i + 1] = row[i];
      }
    }
  }
}

}  // namespace

GainMatrix::GainMatrix(int beam_count, int cell_count) {
  reshape(beam_count, cell_count);
}

void GainMatrix::reshape(int beam_count, int cell_count) {
  beam_count_ = beam_count;
  cell_count_ = cell_count;
  const std::size_t blocks = (beam_count + kBlockBeams - 1) / kBlockBeams;
  gains_.resize(std::max(gains_.size(), blocks * kBlockBeams * cell_count));
  bands_.assign(blocks, {});
}

std::size_t GainMatrix::place(int beam, int cell) const {
  const std::size_t block = beam / kBlockBeams;
  return (block * cell_count_ + cell) * kBlockBeams + beam % kBlockBeams;
}

void GainMatrix::set(int beam, int cell, float gain) {
  gains_[place(beam, cell)] = gain;
}

float GainMatrix::get(int beam, int cell) const {
  const Band& band = bands_[beam / kBlockBeams];
  return cell >= band.first && cell < band.last ? gains_[place(beam, cell)] : 0;
}

void GainMatrix::limit(int beam, int first, int last) {
  Band& band = bands_[beam / kBlockBeams];
  if (first < last) {
    band = band.first < band.last ? Band{std::min(first, band.first), std::max(last, band.last)} : Band{first, last};
  }
}

GainTable GainMatrix::table() const {
  GainTable table = {.gains = gains_};
  for (const Band& band : bands_) {
    table.bands.insert(table.bands.end(), {band.first, band.last});
  }
  return table;
}

double GainMatrix::filled() const {
  double cells = 0;
  for (const Band& band : bands_) {
    cells += band.last - band.first;
  }
  return cells / (static_cast<double>(bands_.size()) * cell_count_);
}

void GainMatrix::multiply(const float* cells, float* beams, int stride, int first, int last) const {
  add_product<false>(cells, beams, stride, first, last);
}

void GainMatrix::add_turned(const float* cells, float* beams, int stride, int first, int last) const {
  add_product<true>(cells, beams, stride, first, last);
}

template <bool turned>
void GainMatrix::add_product(const float* cells, float* beams, int stride, int first, int last) const {
  // For each strip of values and each panel of cells: pack the panel, then add its product with each block of beams to
  // the beams' rows. The first panel of a plain product overwrites the rows instead (`fresh`), so that they need not be
  // cleared beforehand.
  Panel panel;
  Tile tile;
  for (int start = first; start < last; start += kStrip) {
    const int count = std::min(kStrip, last - start);
    for (int panel_first = 0; panel_first < cell_count_; panel_first += kPanelCells) {
      const int panel_last = std::min(panel_first + kPanelCells, cell_count_);
      pack<turned>(cells + static_cast<std::size_t>(panel_first) * stride + start, stride, panel_last - panel_first,
                   count, panel);
      for (int block = 0; block < static_cast<int>(bands_.size()); ++block) {
        const int from = std::min(std::max(panel_first, bands_[block].first), panel_last);
        const int to = std::max(from, std::min(panel_last, bands_[block].last));
        const bool fresh = !turned && panel_first == 0;
        if (from == to && !fresh) {
          continue;
        }
        const int beam = block * kBlockBeams;
        sum_tile(&gains_[place(beam, from)], &panel.values[from - panel_first], to - from, tile);
        for (int i = 0; i < std::min(kBlockBeams, beam_count_ - beam); ++i) {
          float* sums = beams + static_cast<std::size_t>(beam + i) * stride + start;
          if (fresh && count == kStrip) {
            std::copy_n(tile.sums[i], kStrip, sums);
          } else {
            for (int v = 0; v < count; ++v) {
              sums[v] = fresh ? tile.sums[i][v] : sums[v] + tile.sums[i][v];
            }
          }
        }
      }
    }
  }
}

}  // namespace insonify

// gain_matrix.cpp -- the product by tiles of 8 beams x 16 values, whose sums stay in registers.
//
// A strip of 16 values of some cells is packed into the nearest memory, where all beams read it in turn. Without fused
// multiply-adds (vector_math.h) two instructions make one sum: a core of 2.5 GHz with AVX-512 could do 40e9 sums a
// second, and does 30e9 while the gains fit its second memory. Eigen's product does 10e9, being compiled for any
// machine.

#include "receiver/gain_matrix.h"

#include <algorithm>

#include "base/vector_math.h"

namespace insonify {
namespace {

constexpr int kBlockBeams = 8;
constexpr int kStrip = 16;        // Values: one cache line.
constexpr int kPanelCells = 256;  // 16 KiB: a panel and the gains that meet it fit the nearest memory.

struct alignas(64) Panel {
  float values[kPanelCells][kStrip];
};
struct alignas(64) Tile {
  float sums[kBlockBeams][kStrip];
};

// As many values together as the widest registers hold: eight sums of 16 in AVX-512, of 8 in two registers each of
// NEON.
#ifdef __x86_64__
constexpr int kLanes = 16;
#else
constexpr int kLanes = 8;
#endif

// The innermost loop must not be unrolled before the compiler has seen that it is one instruction: then the sums stay
// in registers.
INSONIFY_VECTOR_CLONES
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

// Values beyond the strip's end are zeros.
void pack(const float* cells, int stride, int cell_count, int count, GainMatrix::Turn turn, Panel& panel) {
  for (int cell = 0; cell < cell_count; ++cell) {
    float* packed = panel.values[cell];
    const float* row = cells + static_cast<std::size_t>(cell) * stride;
    if (count < kStrip) {
      std::fill_n(packed, kStrip, 0.0F);
    }
    if (turn == GainMatrix::Turn::kNone) {
      std::copy_n(row, count, packed);
    } else {
      for (int i = 0; i < count; i += 2) {
        packed[i] = -row[i + 1];
        packed[i + 1] = row[i];
      }
    }
  }
}

}  // namespace

GainMatrix::GainMatrix(int beam_count, int cell_count) : beam_count_(beam_count), cell_count_(cell_count) {
  const std::size_t blocks = (beam_count + kBlockBeams - 1) / kBlockBeams;
  gains_.resize(blocks * kBlockBeams * cell_count);
  bands_.resize(blocks);
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

double GainMatrix::filled() const {
  double cells = 0;
  for (const Band& band : bands_) {
    cells += band.last - band.first;
  }
  return cells / (static_cast<double>(bands_.size()) * cell_count_);
}

void GainMatrix::add_product(const float* cells, float* beams, int stride, int first, int last, Turn turn) const {
  Panel panel;
  Tile tile;
  for (int start = first; start < last; start += kStrip) {
    const int count = std::min(kStrip, last - start);
    for (int panel_first = 0; panel_first < cell_count_; panel_first += kPanelCells) {
      const int panel_last = std::min(panel_first + kPanelCells, cell_count_);
      pack(cells + static_cast<std::size_t>(panel_first) * stride + start, stride, panel_last - panel_first, count,
           turn, panel);
      for (int block = 0; block < static_cast<int>(bands_.size()); ++block) {
        const int from = std::max(panel_first, bands_[block].first);
        const int to = std::min(panel_last, bands_[block].last);
        if (from >= to) {
          continue;
        }
        const int beam = block * kBlockBeams;
        sum_tile(&gains_[place(beam, from)], &panel.values[from - panel_first], to - from, tile);
        for (int i = 0; i < std::min(kBlockBeams, beam_count_ - beam); ++i) {
          float* sums = beams + static_cast<std::size_t>(beam + i) * stride + start;
          for (int v = 0; v < count; ++v) {
            sums[v] += tile.sums[i][v];
          }
        }
      }
    }
  }
}

}  // namespace insonify

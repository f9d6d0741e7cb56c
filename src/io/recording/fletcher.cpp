// fletcher.cpp -- Fletcher's checksum in lanes of vectors.

#include "io/recording/fletcher.h"

#include <algorithm>
#include <cstring>

namespace insonify {
namespace {

constexpr std::uint64_t kModulus = 65535;
constexpr std::size_t kLanes = 16;  // Word i of a block belongs to lane i % kLanes.
constexpr std::size_t kRows = 360;  // Most rows of a block: with more, the second sum of a lane may exceed 32 bits.

// Vectors of the compiler, which it keeps in registers.
using Words = std::uint16_t __attribute__((vector_size(2 * kLanes)));
using Lanes = std::uint32_t __attribute__((vector_size(4 * kLanes)));

// Sums modulo 65535 of words in the machine's order. Swapping the bytes of a word multiplies it by 256 modulo 65535, so
// the sums of swapped words are 256 times these.
struct Sums {
  std::uint64_t first = 0, second = 0;
  bool all_zero = true;

  // Adds rows of kLanes words. With w the word in row t and lane j of n rows, there come kLanes (n - t) - j second sums
  // from it on, itself included; lane j has summed (n - t) w.
  void add(const std::byte* bytes, std::size_t rows) {
    Lanes once{}, often{};
    for (std::size_t t = 0; t < rows; ++t) {
      Words words;
      std::memcpy(&words, bytes + t * sizeof words, sizeof words);
      once += __builtin_convertvector(words, Lanes);
      often += once;
    }
    std::uint64_t sum = 0, sum_of_often = 0, sum_by_lane = 0;
    for (std::size_t j = 0; j < kLanes; ++j) {
      sum += once[j];
      sum_of_often += often[j];
      sum_by_lane += j * once[j];
    }
    all_zero = all_zero && sum == 0;
    second = (second + rows * kLanes * first + kLanes * sum_of_often - sum_by_lane) % kModulus;
    first = (first + sum) % kModulus;
  }

  void add_word(std::uint16_t word) {
    all_zero = all_zero && word == 0;
    first = (first + word) % kModulus;
    second = (second + first) % kModulus;
  }

  // From 1 to 65535, as sums that are folded have it, or 0.
  [[nodiscard]] std::uint32_t folded(std::uint64_t sum) const {
    const std::uint64_t swapped = 256 * sum % kModulus;
    return static_cast<std::uint32_t>(all_zero || swapped != 0 ? swapped : kModulus);
  }
};

}  // namespace

std::uint32_t fletcher32(std::span<const std::byte> bytes) {
  constexpr std::size_t kRowBytes = 2 * kLanes;
  Sums sums;
  while (bytes.size() >= kRowBytes) {
    const std::size_t rows = std::min(bytes.size() / kRowBytes, kRows);
    sums.add(bytes.data(), rows);
    bytes = bytes.subspan(rows * kRowBytes);
  }
  for (; !bytes.empty(); bytes = bytes.subspan(std::min<std::size_t>(bytes.size(), 2))) {
    std::uint16_t word = 0;
    std::memcpy(&word, bytes.data(), std::min<std::size_t>(bytes.size(), 2));
    sums.add_word(word);
  }
  return sums.folded(sums.second) << 16U | sums.folded(sums.first);
}

}  // namespace insonify

// scan_slots.cpp -- finds the latest ping of a scanning sonar in each direction, and its neighbour.

#include "image/scan_slots.h"

#include <algorithm>
#include <cmath>

#include "image/canvas.h"

namespace insonify {
namespace {

// A slot is 0.022 degrees wide: half a pixel at the border of a picture of 2600 pixels.
constexpr int kSlots = 16384;
constexpr double kSlotsPerRadian = kSlots / kTwoPi;

double slot_azimuth(int slot) {
  return (slot + 0.5) / kSlotsPerRadian;
}

std::size_t slot_of(int slot) {
  return static_cast<std::size_t>(((slot % kSlots) + kSlots) % kSlots);
}

std::size_t slot_at(double azimuth) {
  return slot_of(static_cast<int>(std::floor(std::remainder(azimuth, kTwoPi) * kSlotsPerRadian)));
}

}  // namespace

ScanSlots::ScanSlots(const std::vector<double>& head_angles, double step, double width) : slots_(kSlots) {
  step = std::abs(step);
  const double half = width / 2;
  for (int ping = 0; ping < static_cast<int>(head_angles.size()); ++ping) {
    // A ping covers all slots whose middle lies within its width, and at least the slot that the head points at.
    const double head = std::remainder(head_angles[ping], kTwoPi);
    const int first = static_cast<int>(std::ceil((head - half) * kSlotsPerRadian - 0.5));
    const int last = static_cast<int>(std::floor((head + half) * kSlotsPerRadian - 0.5));
    slots_[slot_at(head)].ping = ping;
    for (int slot = first; slot <= last; ++slot) {
      slots_[slot_of(slot)].ping = ping;
    }
  }
  for (int i = 0; i < kSlots; ++i) {
    Mix& slot = slots_[i];
    if (slot.ping < 0) {
      continue;
    }
    slot.neighbour = slot.ping;
    const double head = head_angles[slot.ping];
    const double off = std::remainder(slot_azimuth(i) - head, kTwoPi);
    const int beside = slots_[slot_at(head + std::copysign(step, off))].ping;
    // Only the ping before or after is interpolated with, since others may show the scene at another time; and only if
    // the pings leave no gap between them.
    if (beside >= 0 && std::abs(beside - slot.ping) == 1 && width >= step) {
      slot.neighbour = beside;
      slot.share = std::min(0.5, std::abs(off) / step);
    }
  }
}

ScanSlots::Mix ScanSlots::at(double azimuth) const {
  return slots_[slot_at(azimuth)];
}

}  // namespace insonify

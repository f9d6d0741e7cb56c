// hit_strip.cpp -- memory for HitColumn and FootprintSegments.

#include "echo/model/hit_column.h"

namespace insonify {
namespace {

constexpr float* HitColumn::*kFields[] = {
    &HitColumn::direction_x, &HitColumn::direction_y, &HitColumn::direction_z, &HitColumn::range,
    &HitColumn::normal_x,    &HitColumn::normal_y,    &HitColumn::normal_z,    &HitColumn::reflectivity,
    &HitColumn::facing,      &HitColumn::strength,    &HitColumn::power,       &HitColumn::selected,
    &HitColumn::gradient_x,  &HitColumn::gradient_y,  &HitColumn::gradient_z,  &HitColumn::texture,
    &HitColumn::escapes,     &HitColumn::turn_up_x,   &HitColumn::turn_up_y,   &HitColumn::turn_up_z,
    &HitColumn::turn_side_x, &HitColumn::turn_side_y, &HitColumn::turn_side_z, &HitColumn::reached,
    &HitColumn::passed};

}  // namespace

void HitStrip::resize(int columns, int rows) {
  columns_ = columns;
  stride_ = rows + kPadding;
  surface_.assign(static_cast<std::size_t>(columns_) * stride_, kNoSurface);
  triangle_.assign(surface_.size(), 0);
  values_.assign(std::size(kFields) * surface_.size(), 0.0F);
}

HitColumn HitStrip::column(int column) {
  HitColumn hits{};
  const std::size_t start = static_cast<std::size_t>(column) * stride_;
  hits.surface = &surface_[start];
  hits.triangle = &triangle_[start];
  for (std::size_t field = 0; field < std::size(kFields); ++field) {
    hits.*kFields[field] = &values_[field * surface_.size() + start];
  }
  return hits;
}

void FootprintSegments::resize(int rows) {
  for (auto* values : {&normal_along, &normal_up, &normal_beside, &position, &reach, &low, &high, &power, &half_rise,
                       &density, &elevation}) {
    values->resize(rows);
  }
  joined.resize(rows);
  turned.resize(rows);
}

}  // namespace insonify

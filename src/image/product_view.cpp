// product_view.cpp -- chooses the picture of a sonar's pings.

#include "insonify/picture.h"

namespace insonify {

ProductView::ProductView(const SonarConfig& sonar) : sonar_(sonar) {
  if (sonar.product() == Product::kLine) {
    scan_.emplace(sonar);
  }
}

void ProductView::add(const Ping& ping) {
  if (scan_) {
    scan_->add(ping);
  } else {
    last_ = ping;
  }
}

double ProductView::fitting_full_scale() const {
  return scan_ ? scan_->fitting_full_scale() : insonify::fitting_full_scale(intensities_to_fit(last_, sonar_));
}

Picture ProductView::draw(const Display& display) const {
  return scan_ ? scan_->draw(display) : draw_fan(last_, sonar_, display);
}

}  // namespace insonify

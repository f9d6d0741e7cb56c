// bearing_grid.cpp -- makes grids of bearings whose slices touch, and lists the edges of any.

#include "insonify/bearing_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <utility>

namespace insonify {

BearingGrid BearingGrid::even(double middle, double extent, int count) {
  BearingGrid grid;
  for (int i = 0; i < count; ++i) {
    const auto edge = [&](double place) { return middle + extent * (0.5 - place / count); };
    grid.add(edge(i + 0.5), edge(i), edge(i + 1.0));
  }
  return grid;
}

BearingGrid BearingGrid::touching(std::vector<double> centres) {
  BearingGrid grid;
  grid.centres = std::move(centres);
  for (std::size_t i = 0; i + 1 < grid.centres.size(); ++i) {
    grid.starboard.push_back((grid.centres[i] + grid.centres[i + 1]) / 2);
  }
  grid.port.push_back(2 * grid.centres.front() - grid.starboard.front());
  grid.port.insert(grid.port.end(), grid.starboard.begin(), grid.starboard.end());
  grid.starboard.push_back(2 * grid.centres.back() - grid.starboard.back());
  return grid;
}

void BearingGrid::add(double centre, double port_edge, double starboard_edge) {
  centres.push_back(centre);
  port.push_back(port_edge);
  starboard.push_back(starboard_edge);
}

void BearingGrid::add(const BearingGrid& more) {
  assert(centres.empty() || more.centres.empty() || more.port.front() <= starboard.back());
  for (int i = 0; i < more.count(); ++i) {
    add(more.centres[i], more.port[i], more.starboard[i]);
  }
}

double BearingGrid::covered() const {
  double gaps = 0;
  for (int i = 0; i + 1 < count(); ++i) {
    gaps += starboard[i] - port[i + 1];
  }
  return extent() - gaps;
}

bool BearingGrid::gap_after(int slice) const {
  return slice >= 0 && slice + 1 < count() && starboard[slice] > port[slice + 1];
}

bool BearingGrid::has_gaps() const {
  for (int i = 0; i < count(); ++i) {
    if (gap_after(i)) {
      return true;
    }
  }
  return false;
}

std::vector<double> BearingGrid::sines() const {
  std::vector<double> sines;
  std::ranges::transform(centres, std::back_inserter(sines), [](double centre) { return std::sin(centre); });
  return sines;
}

std::vector<double> BearingGrid::edges() const {
  std::vector<double> edges;
  if (!has_gaps()) {
    edges = port;
    edges.push_back(starboard.back());
    return edges;
  }
  for (int i = 0; i < count(); ++i) {
    edges.insert(edges.end(), {port[i], starboard[i]});
  }
  return edges;
}

}  // namespace insonify

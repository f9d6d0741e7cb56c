// load_height_grid.cpp -- picks the reader of a height grid by its ending; degrees become metres here.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/log_line.h"
#include "insonify/error.h"
#include "insonify/files.h"
#include "io/file/budgets.h"
#include "io/file/input_file.h"
#include "io/grid/height_grid_file.h"
#include "io/picture/png_reader.h"

namespace insonify {
namespace {

constexpr std::array<std::string_view, 5> kEndings{".png", ".asc", ".bag", ".tif", ".tiff"};

// Grey pictures as heights from 0 to 1.
HeightGrid load_png_grid(const std::filesystem::path& path) {
  const PngReader png(path);
  if (png.width() < 2 || png.height() < 2) {
    throw Error(
        fmt::format("{}: {} x {} pixels; heights need at least 2 x 2", path.string(), png.width(), png.height()));
  }

  HeightGrid grid;
  grid.columns = static_cast<int>(png.width());
  grid.rows = static_cast<int>(png.height());
  grid.heights.reserve(png.width() * png.height());
  const float scale = 1 / static_cast<float>(png.full_scale());
  for (std::size_t row = 0; row < png.height(); ++row) {
    for (std::size_t column = 0; column < png.width(); ++column) {
      grid.heights.push_back(scale * static_cast<float>(png.grey(column, row, "heights need")));
    }
  }
  return grid;
}

HeightGrid load_by_ending(const std::filesystem::path& path, const Log& log) {
  const std::string ending = ending_of(path);
  if (ending == ".png") {
    return load_png_grid(path);
  }
  if (ending == ".asc") {
    return load_asc_grid(path, log);
  }
  if (ending == ".bag") {
    return load_bag_grid(path, log);
  }
  if (ending == ".tif" || ending == ".tiff") {
    return load_tiff_grid(path, log);
  }
  throw Error(fmt::format("{}: \"{}\" is not a known extension of a height grid; known: {}", path.string(),
                          path.extension().string(), height_grid_file_endings()));
}

}  // namespace

bool is_height_grid_file(const std::filesystem::path& path) {
  return std::ranges::count(kEndings, ending_of(path)) > 0;
}

std::string height_grid_file_endings() {
  return fmt::format("{}", fmt::join(kEndings, ", "));
}

DegreeLength degree_length(double latitude_deg) {
  // Radii of curvature of the ellipsoid, e.g. Torge, Geodesy (2001), eq. 4.13 and 4.15.
  constexpr double kEquatorialRadius = 6378137.0;  // [m]
  constexpr double kFirstEccentricitySquared = 6.69437999014e-3;
  const double sine = std::sin(radians_from_degrees(latitude_deg));
  const double w = std::sqrt(1 - kFirstEccentricitySquared * sine * sine);
  const double prime_vertical = kEquatorialRadius / w;
  const double meridian = kEquatorialRadius * (1 - kFirstEccentricitySquared) / (w * w * w);
  return {radians_from_degrees(1) * prime_vertical * std::cos(radians_from_degrees(latitude_deg)),
          radians_from_degrees(1) * meridian};
}

bool looks_geographic(const HeightGrid& grid) {
  constexpr double kWidestSpacing = 0.1;  // [deg]
  const double half_x = grid.columns * grid.spacing_x / 2;
  const double half_y = grid.rows * grid.spacing_y / 2;
  const bool within_ranges =
      std::abs(grid.origin.x()) + half_x <= 360 && std::abs(grid.origin.y()) + half_y <= 90 + grid.spacing_y;
  const bool holds_zero = std::abs(grid.origin.x()) <= half_x && std::abs(grid.origin.y()) <= half_y;
  return within_ranges && !holds_zero && std::max(grid.spacing_x, grid.spacing_y) <= kWidestSpacing;
}

void turn_degrees_into_metres(HeightGrid& grid, const std::filesystem::path& path, const Log& log) {
  const double latitude = grid.origin.y();
  if (!(std::abs(latitude) < 90)) {
    throw Error(fmt::format("{}: its middle is at latitude {:.6g}, which must be between -90 and 90 degrees",
                            path.string(), latitude));
  }
  const DegreeLength degree = degree_length(latitude);
  const double degrees_x = grid.spacing_x;
  const double degrees_y = grid.spacing_y;
  grid.spacing_x *= degree.east;
  grid.spacing_y *= degree.north;
  log_line(log, Severity::kInfo,
           fmt::format("{}: spacing of {:.6g} x {:.6g} degrees taken as {:.4g} x {:.4g} m, at latitude {:.4g}",
                       path.filename().string(), degrees_x, degrees_y, grid.spacing_x, grid.spacing_y, latitude));
}

Mesh height_field_of(const HeightGrid& grid) {
  check_budget(Budget::kTriangles, 2.0 * grid.rows * grid.columns, grid.name);
  return make_height_field(grid);
}

HeightGrid load_height_grid(const std::filesystem::path& path, const Log& log) {
  check_input_file(path);
  HeightGrid grid = load_by_ending(path, log);
  grid.name = path.string();
  return grid;
}

}  // namespace insonify

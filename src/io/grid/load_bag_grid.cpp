// load_bag_grid.cpp -- Bathymetric Attributed Grids: HDF5 with the heights in /BAG_root/elevation.
//
// Format Specification Document of the Bathymetric Attributed Grid Object, version 1.6 (2018).

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <pugixml.hpp>
#include <string_view>
#include <vector>

#include "base/log_line.h"
#include "base/names.h"
#include "insonify/error.h"
#include "io/file/budgets.h"
#include "io/file/hdf5.h"
#include "io/file/reader_process.h"
#include "io/file/xml_file.h"
#include "io/grid/height_grid_file.h"

namespace insonify {
namespace {

// ---------------------------------------------------------------- Metadata, ISO 19139

// Spacing, corners and units of the grid.
struct BagMetadata {
  std::optional<double> spacing_x;  // Between columns, in the units of the reference system.
  std::optional<double> spacing_y;  // Between rows.
  std::optional<Vec3> south_west;   // Corner point of the grid; z is 0.
  std::optional<Vec3> north_east;
  std::optional<bool> is_geographic;  // Whether the units are degrees; empty if the XML does not say.
};

// Whether a node is an element of that name, in whatever namespace.
bool is_named(pugi::xml_node node, std::string_view name) {
  const std::string_view own = node.name();
  return node.type() == pugi::node_element && own.substr(own.find(':') + 1) == name;  // npos + 1 is 0.
}

pugi::xml_node find_first(pugi::xml_node inside, std::string_view name) {
  return inside.find_node([&](pugi::xml_node node) { return is_named(node, name); });
}

// All text below a node, in lower case and without white space at its ends.
std::string text_of(pugi::xml_node below) {
  std::string text;
  below.find_node([&](pugi::xml_node node) {
    text += node.value();  // "" for an element.
    text += ' ';
    return false;
  });
  return without_outer_space(lower_case(text));
}

// All numbers in a text. Whatever separates them is skipped.
std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  const char* end = text.data() + text.size();
  for (const char* at = text.data(); at < end;) {
    double value = 0;
    const auto [after, failure] = std::from_chars(at, end, value);
    if (failure == std::errc() && std::isfinite(value)) {
      numbers.push_back(value);
      at = after;
    } else {
      ++at;
    }
  }
  return numbers;
}

std::optional<double> positive_number(const std::string& text) {
  const std::vector<double> numbers = numbers_of(text);
  return !numbers.empty() && numbers.front() > 0 ? std::optional(numbers.front()) : std::nullopt;
}

void read_dimension(pugi::xml_node dimension, BagMetadata& metadata) {
  const std::string name = text_of(find_first(dimension, "dimensionName"));
  const pugi::xml_node resolution = find_first(dimension, "resolution");
  const std::optional<double> spacing = positive_number(text_of(resolution));
  if (name == "row") {
    metadata.spacing_y = spacing;
  } else if (name == "column") {
    metadata.spacing_x = spacing;
  }
  for (const pugi::xml_attribute attribute : find_first(resolution, "Measure").attributes()) {
    if (std::string_view(attribute.value()).find("deg") != std::string_view::npos) {
      metadata.is_geographic = true;
    }
  }
}

void read_corners(pugi::xml_node xml, BagMetadata& metadata) {
  const std::vector<double> corners = numbers_of(text_of(find_first(xml, "cornerPoints")));
  if (corners.size() == 4) {
    metadata.south_west = Vec3(corners[0], corners[1], 0);
    metadata.north_east = Vec3(corners[2], corners[3], 0);
  }
}

// The first reference system is the horizontal one. It is given as well-known text, as a word or as an EPSG code.
void read_reference_system(pugi::xml_node xml, BagMetadata& metadata) {
  const std::string code = text_of(find_first(find_first(xml, "referenceSystemInfo"), "code"));
  const auto begins_with_one_of = [&](const auto& words) {
    return std::ranges::any_of(words, [&](std::string_view word) { return code.starts_with(word); });
  };
  // WGS 84, NAD 83, ETRS 89, and WGS 84 in three dimensions.
  constexpr std::array<std::string_view, 8> kGeographic{"geog", "geodcrs", "geodetic", "4326",
                                                        "4269", "4258",    "4979",     "epsg:4326"};
  constexpr std::array<std::string_view, 4> kProjected{"proj", "utm", "mercator", "local_cs"};
  if (begins_with_one_of(kGeographic)) {
    metadata.is_geographic = true;
  } else if (begins_with_one_of(kProjected)) {
    metadata.is_geographic = false;
  }
}

// Any version of BAG: namespaces, which differ between versions, are ignored.
BagMetadata parse_bag_metadata(const std::string& xml) {
  // XML that is not well-formed is used up to its fault. The caller reports elements that are missing.
  pugi::xml_document text;
  text.load_string(xml.c_str());
  BagMetadata metadata;
  read_reference_system(text, metadata);
  text.find_node([&](pugi::xml_node node) {
    if (is_named(node, "MD_Dimension")) {
      read_dimension(node, metadata);
    }
    return false;
  });
  read_corners(text, metadata);
  return metadata;
}

// ---------------------------------------------------------------- Contents

constexpr float kNoData = 1e6F;
constexpr hsize_t kMost = 200'000;  // Rows and columns.

void read_elevation(hid_t file, const std::filesystem::path& path, BagContents& bag) {
  const H5Handle dataset = h5_open_object(file, "/BAG_root/elevation", path);
  const H5Handle space = h5_own(H5Dget_space(dataset.get()), H5Sclose, path, "size /BAG_root/elevation");
  hsize_t size[2] = {0, 0};
  if (H5Sget_simple_extent_ndims(space.get()) != 2 || H5Sget_simple_extent_dims(space.get(), size, nullptr) != 2 ||
      std::min(size[0], size[1]) < 2 || std::max(size[0], size[1]) > kMost) {
    throw Error(fmt::format("{}: /BAG_root/elevation must have from 2 to {} rows and columns", path.string(), kMost));
  }
  check_budget(Budget::kPixels, static_cast<double>(size[0]) * static_cast<double>(size[1]), path.string());
  bag.rows = size[0];
  bag.columns = size[1];
  bag.heights.resize(size[0] * size[1]);
  h5_check(H5Dread(dataset.get(), H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, bag.heights.data()), path,
           "read /BAG_root/elevation");
}

std::string read_metadata(hid_t file, const std::filesystem::path& path) {
  const H5Handle dataset = h5_open_object(file, "/BAG_root/metadata", path);
  const H5Handle space = h5_own(H5Dget_space(dataset.get()), H5Sclose, path, "size /BAG_root/metadata");
  const H5Handle type = h5_own(H5Dget_type(dataset.get()), H5Tclose, path, "read /BAG_root/metadata");
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) != 0) {
    throw Error(fmt::format("{}: /BAG_root/metadata must be an array of characters", path.string()));
  }
  const hssize_t count = h5_check(H5Sget_simple_extent_npoints(space.get()), path, "size /BAG_root/metadata");
  check_budget(Budget::kBytes, static_cast<double>(count) * static_cast<double>(H5Tget_size(type.get())),
               path.string());
  std::string xml(static_cast<std::size_t>(count) * H5Tget_size(type.get()), '\0');
  h5_check(H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, xml.data()), path,
           "read /BAG_root/metadata");
  return xml;
}

// Heights are positive upwards, so depths are negative. The first row of the file is the southernmost.
HeightGrid grid_of(BagContents& bag) {
  HeightGrid grid;
  grid.rows = static_cast<int>(bag.rows);
  grid.columns = static_cast<int>(bag.columns);
  grid.heights = std::move(bag.heights);
  const auto row = [&](int index) { return grid.heights.begin() + static_cast<std::ptrdiff_t>(index) * grid.columns; };
  for (int south = 0, north = grid.rows - 1; south < north; ++south, --north) {
    std::swap_ranges(row(south), row(south + 1), row(north));
  }
  for (float& height : grid.heights) {
    if (!std::isfinite(height) || height >= kNoData) {
      height = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return grid;
}

// Spacing by the corner points: their distance divided by the number of steps between them.
std::optional<double> spacing_by_corners(const BagMetadata& metadata, int axis, int count) {
  if (!metadata.south_west || !metadata.north_east) {
    return std::nullopt;
  }
  const double spacing = ((*metadata.north_east)[axis] - (*metadata.south_west)[axis]) / (count - 1);
  return spacing > 0 ? std::optional(spacing) : std::nullopt;
}

double spacing(std::optional<double> told, std::optional<double> by_corners, std::string_view dimension,
               const std::filesystem::path& path, const Log& log) {
  if (!told && !by_corners) {
    throw Error(fmt::format("{}: its metadata gives no resolution of the {} dimension", path.string(), dimension));
  }
  // Some writers give the corners of the outermost cells, others their middles: a difference of one step.
  constexpr double kDiffer = 1.5;
  if (told && by_corners && std::max(*told / *by_corners, *by_corners / *told) > kDiffer) {
    log_line(log, Severity::kWarning,
             fmt::format("{}: its metadata gives a {} resolution of {:.6g}, but corner points {:.6g} apart; "
                         "the first is used",
                         path.filename().string(), dimension, *told, *by_corners));
  }
  return told ? *told : *by_corners;
}

}  // namespace

bool fits(const BagContents& bag) {
  return std::min(bag.rows, bag.columns) >= 2 && std::max(bag.rows, bag.columns) <= kMost &&
         bag.heights.size() == bag.rows * bag.columns;
}

BagContents read_bag(const std::filesystem::path& path) {
  const H5Handle file = h5_open_to_read(path);
  BagContents bag;
  read_elevation(file.get(), path, bag);
  bag.metadata = read_metadata(file.get(), path);
  bag.has_refinements = H5Lexists(file.get(), "/BAG_root/varres_refinements", H5P_DEFAULT) > 0;
  return bag;
}

HeightGrid load_bag_grid(const std::filesystem::path& path, const Log& log) {
  BagContents bag =
      reads_here() ? read_bag(path) : read_apart<BagContents>({path, "BAG"}, ReaderTask::kBag, path.string());
  HeightGrid grid = grid_of(bag);
  const BagMetadata metadata = parse_bag_metadata(bag.metadata);
  grid.spacing_x = spacing(metadata.spacing_x, spacing_by_corners(metadata, 0, grid.columns), "column", path, log);
  grid.spacing_y = spacing(metadata.spacing_y, spacing_by_corners(metadata, 1, grid.rows), "row", path, log);
  if (metadata.south_west && metadata.north_east) {
    grid.origin = (*metadata.south_west + *metadata.north_east) / 2;
  }

  if (metadata.is_geographic.value_or(metadata.south_west && looks_geographic(grid))) {
    turn_degrees_into_metres(grid, path, log);
  }
  if (bag.has_refinements) {
    log_line(log, Severity::kWarning,
             fmt::format("{}: a grid of variable resolution; only its base grid of {} x {} points every "
                         "{:.4g} m is read",
                         path.filename().string(), grid.columns, grid.rows, grid.spacing_x));
  }
  return grid;
}

}  // namespace insonify

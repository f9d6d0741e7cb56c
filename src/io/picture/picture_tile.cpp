// picture_tile.cpp -- converts the pixels of PNG files to slopes and levels.

#include "io/picture/picture_tile.h"

#include <fmt/format.h>

#include "insonify/error.h"

namespace insonify {
namespace {

// Least z of a normal. Rounding to 8 bits makes some normals lie in the surface, whose slope would be infinite.
constexpr float kLeastOut = 0.1F;

template <typename Texel, typename Read>
Tile<Texel> read_tile(const PngReader& png, const Read& read) {
  Tile<Texel> tile{static_cast<int>(png.width()), static_cast<int>(png.height()), {}};
  tile.texels.reserve(png.width() * png.height());
  for (std::size_t row = 0; row < png.height(); ++row) {
    for (std::size_t column = 0; column < png.width(); ++column) {
      tile.texels.push_back(read(column, row));
    }
  }
  return tile;
}

}  // namespace

Tile<Eigen::Vector2f> read_normals(const PngReader& png) {
  if (!png.has_colours()) {
    throw Error(png.name() + ": is grey; a normal map has colours");
  }
  const int middle = (png.full_scale() + 1) / 2;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const auto normals = read_tile<Eigen::Vector3f>(png, [&](std::size_t column, std::size_t row) {
    Eigen::Vector3f normal;
    for (int channel = 0; channel < 3; ++channel) {
      normal[channel] = static_cast<float>(png.colour(column, row, channel) - middle) / static_cast<float>(middle - 1);
    }
    sum += normal.cast<double>();
    normal.z() = std::max(normal.z(), kLeastOut);
    return normal;
  });
  const Eigen::Vector3d mean = sum / static_cast<double>(normals.texels.size());
  if (mean.z() < 0.5 || mean.head<2>().norm() > mean.z()) {
    throw Error(
        fmt::format("{}: is not a normal map in tangent space: its mean normal is ({:.2f}, {:.2f}, {:.2f}), must "
                    "point out of the surface, (0, 0, 1) or nearly",
                    png.name(), mean.x(), mean.y(), mean.z()));
  }
  return slopes_of_normals(normals);
}

Tile<Eigen::Vector2f> read_heights(const PngReader& png, double height) {
  Tile<float> heights = read_levels(png, "a height map needs");
  for (float& level : heights.texels) {
    level *= static_cast<float>(height);
  }
  return slopes_of_heights(heights);
}

Tile<float> read_levels(const PngReader& png, std::string_view purpose) {
  return read_tile<float>(png, [&](std::size_t column, std::size_t row) {
    return static_cast<float>(png.grey(column, row, purpose)) / static_cast<float>(png.full_scale());
  });
}

}  // namespace insonify

// normal_map.cpp -- slopes between texels, and libpng.

#include "kit/normal_map.h"

#include <fmt/format.h>
#include <png.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace {

std::vector<float> heights_of(const Ground& ground, const MapArea& area, int texels) {
  std::vector<float> heights;
  heights.reserve(static_cast<std::size_t>(texels) * texels);
  const double step = area.size / texels;
  for (int row = 0; row < texels; ++row) {
    for (int column = 0; column < texels; ++column) {
      const double x = area.low_x + (column + 0.5) * step, y = area.low_y + (texels - row - 0.5) * step;
      heights.push_back(static_cast<float>(ground(x, y)));
    }
  }
  return heights;
}

png_byte coded(double component) {
  return static_cast<png_byte>(std::lround(128 + 127 * component));
}

}  // namespace

void write_normal_map(const std::filesystem::path& path, const Ground& ground, const MapArea& area, int texels) {
  const std::vector<float> heights = heights_of(ground, area, texels);
  const auto at = [&](int column, int row) {
    return static_cast<double>(
        heights[static_cast<std::size_t>(std::clamp(row, 0, texels - 1)) * texels + std::clamp(column, 0, texels - 1)]);
  };
  const double two_steps = 2 * area.size / texels;
  std::vector<png_byte> pixels;
  pixels.reserve(3 * heights.size());
  for (int row = 0; row < texels; ++row) {
    for (int column = 0; column < texels; ++column) {
      const Vec3 normal = Vec3((at(column - 1, row) - at(column + 1, row)) / two_steps,
                               (at(column, row + 1) - at(column, row - 1)) / two_steps, 1)
                              .normalized();
      pixels.insert(pixels.end(), {coded(normal.x()), coded(normal.y()), coded(normal.z())});
    }
  }

  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = image.height = static_cast<png_uint_32>(texels);
  image.format = PNG_FORMAT_RGB;
  const std::filesystem::path unfinished = path.string() + ".part";
  if (png_image_write_to_file(&image, unfinished.c_str(), 0, pixels.data(), 0, nullptr) == 0) {
    throw std::runtime_error(fmt::format("{}: cannot be written: {}", unfinished.string(), image.message));
  }
  std::filesystem::rename(unfinished, path);
}

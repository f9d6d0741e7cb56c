// picture_files.h -- grey PNG files and minimal recordings that a test makes.

#pragma once

#define H5_USE_110_API  // Functions and structures of HDF5 1.10, which newer ones have too.
#include <hdf5.h>
#include <png.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace insonify {

/// Writes 8 or 16 bits a channel. `channels` is 1 (grey), 2 (with alpha), 3 (RGB) or 4.
template <typename Level>
void write_levels(const std::filesystem::path& path, int columns, int rows, const std::vector<Level>& levels,
                  int channels = 1) {
  static constexpr int kTypes[] = {0, PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                   PNG_COLOR_TYPE_RGB_ALPHA};
  FILE* file = fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, columns, rows, 8 * sizeof(Level), kTypes[channels], PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  std::vector<png_byte> line;
  for (int row = 0; row < rows; ++row) {
    line.clear();
    for (int i = row * columns * channels; i < (row + 1) * columns * channels; ++i) {
      if (sizeof(Level) == 2) {
        line.push_back(static_cast<png_byte>(levels[i] >> 8));
      }
      line.push_back(static_cast<png_byte>(levels[i]));
    }
    png_write_row(png, line.data());
  }
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  fclose(file);
}

/// Writes an HDF5 file with numbers `intensity` of any shape, and nothing else but, where named, the sonar.
inline void write_intensity(const std::filesystem::path& path, const std::vector<hsize_t>& shape, hid_t stored,
                            const std::vector<double>& values, const std::string& sonar = "",
                            const std::string& model = "") {
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
  const hid_t dataset = H5Dcreate2(file, "intensity", stored, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  for (const auto& [name, value] : {std::pair{"sonar", sonar}, std::pair{"model", model}}) {
    if (value.empty()) {
      continue;
    }
    const hid_t text = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, value.size());
    const hid_t one = H5Screate(H5S_SCALAR);
    const hid_t attribute = H5Acreate2(file, name, text, one, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, text, value.data());
    H5Aclose(attribute);
    H5Sclose(one);
    H5Tclose(text);
  }
  H5Dclose(dataset);
  H5Sclose(space);
  H5Fclose(file);
}

}  // namespace insonify

// jpeg_reader.cpp -- libjpeg, whose errors jump out of it: no object that must be destroyed may stand between.

#include <fmt/format.h>

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
// After <cstdio>, which it needs.
#include <jpeglib.h>

#include "insonify/error.h"
#include "io/file/budgets.h"
#include "io/file/input_file.h"
#include "io/picture/grey_picture.h"

namespace insonify {
namespace {

// What libjpeg calls on errors, with a pointer to its part `base`.
struct JpegErrors {
  jpeg_error_mgr base;
  std::jmp_buf back;
  std::array<char, JMSG_LENGTH_MAX> text;
};

struct JpegPixels {
  jpeg_decompress_struct decoder;
  JpegErrors errors;
  std::vector<std::uint8_t> values;  // Rows x columns x channels.
};

[[noreturn]] void leave_jpeg(j_common_ptr decoder) {
  auto* const errors = reinterpret_cast<JpegErrors*>(decoder->err);
  decoder->err->format_message(decoder, errors->text.data());
  std::longjmp(errors->back, 1);  // NOLINT: libjpeg has no other way.
}

// Warnings are errors: libjpeg fills what is missing with grey.
void warn_of_jpeg(j_common_ptr decoder, int level) {
  if (level < 0) {
    leave_jpeg(decoder);
  }
}

// False on an error, or if there are more pixels than `most`.
bool decode_pixels(JpegPixels& jpeg, std::string_view file, double most) {
  jpeg_decompress_struct& decoder = jpeg.decoder;
  if (setjmp(jpeg.errors.back) != 0) {  // NOLINT: as above.
    return false;
  }
  jpeg_mem_src(&decoder, reinterpret_cast<const unsigned char*>(file.data()), file.size());
  jpeg_read_header(&decoder, TRUE);
  if (static_cast<double>(decoder.image_width) * decoder.image_height > most) {
    return false;
  }
  decoder.out_color_space = decoder.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_start_decompress(&decoder);
  const std::size_t row = std::size_t{decoder.output_width} * decoder.output_components;
  jpeg.values.resize(row * decoder.output_height);
  while (decoder.output_scanline < decoder.output_height) {
    JSAMPROW line = &jpeg.values[row * decoder.output_scanline];
    jpeg_read_scanlines(&decoder, &line, 1);
  }
  jpeg_finish_decompress(&decoder);
  return true;
}

}  // namespace

DecodedGrey decode_jpeg(const std::string& name, std::string_view file) {
  JpegPixels jpeg{};
  jpeg.decoder.err = jpeg_std_error(&jpeg.errors.base);
  jpeg.errors.base.error_exit = leave_jpeg;
  jpeg.errors.base.emit_message = warn_of_jpeg;
  jpeg_create_decompress(&jpeg.decoder);
  const bool good = decode_pixels(jpeg, file, budget(Budget::kPixels));
  const std::uint64_t width = jpeg.decoder.image_width, height = jpeg.decoder.image_height;
  const auto channels = static_cast<std::size_t>(jpeg.decoder.output_components);
  jpeg_destroy_decompress(&jpeg.decoder);
  if (jpeg.errors.text[0] != '\0') {
    throw Error(fmt::format("{}: cannot be read: {}", name, foreign_reason(jpeg.errors.text.data())));
  }
  if (!good) {
    check_budget(Budget::kPixels, static_cast<double>(width) * static_cast<double>(height), name);
  }
  constexpr int kRounding = 4;  // Grey that was stored as colours comes back this exactly.
  DecodedGrey grey{.width = width, .height = height, .full_scale = 255, .levels = {}};
  for (std::size_t at = 0; at < jpeg.values.size(); at += channels) {
    const int level = channels == 1 ? jpeg.values[at] : jpeg.values[at + 1];  // Green.
    for (std::size_t channel = 0; channel < channels; ++channel) {
      if (std::abs(jpeg.values[at + channel] - level) > kRounding) {
        const std::uint64_t pixel = at / channels;
        throw Error(fmt::format("{}: the pixel in column {}, row {} is coloured; a comparison needs a grey picture",
                                name, pixel % width, pixel / width));
      }
    }
    grey.levels.push_back(static_cast<std::uint16_t>(level));
  }
  return grey;
}

}  // namespace insonify

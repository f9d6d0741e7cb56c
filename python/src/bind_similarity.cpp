// bind_similarity.cpp -- insonify.similarity: similarity measures of pictures, as arrays of grey levels.

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <span>

#include "bind.h"
#include "convert.h"
#include "insonify/recorded_pings.h"
#include "insonify/settings_table.h"
#include "insonify/similarity.h"
#include "python_types.h"

namespace insonify::python {
namespace {

using Levels = py::array_t<double, py::array::c_style | py::array::forcecast>;

GreyPicture picture_from(const Levels& levels, const char* name) {
  if (levels.ndim() != 2) {
    throw Error("", name, fmt::format(" must be an array [rows, columns], has {} axes", levels.ndim()));
  }
  return {name,
          static_cast<int>(levels.shape(1)),
          static_cast<int>(levels.shape(0)),
          {levels.data(), levels.data() + levels.size()}};
}

py::array_t<double> array_of(const GreyPicture& picture) {
  py::array_t<double> levels({picture.rows, picture.columns});
  std::copy(picture.values.begin(), picture.values.end(), levels.mutable_data());
  return levels;
}

// A read-only class of numbers, from its list of fields.
template <typename Measures>
void add_measures(py::module_& module, const py::module_& described, const char* name, const char* help) {
  py::class_<Measures> measures(module, name, help);
  for (const FieldEntry& field : table_of<Measures>().fields) {
    const auto get = [&field](const Measures& self) { return *static_cast<const double*>(field.in(&self)); };
    const std::string text = std::string(field.help) + " [" +
                             (field.unit.empty() ? "" : std::string(field.unit) + ", ") + field.limits.text() + "]";
    measures.def_property_readonly(std::string(field.name).c_str(), get, text.c_str());
    describe(described, name, std::string(field.name), {"float", ""});
  }
  measures.def("__repr__", [name = std::string(name)](const Measures& self) {
    std::string text;
    for (const FieldEntry& field : table_of<Measures>().fields) {
      text += fmt::format("{}{}={:.6g}", text.empty() ? "" : ", ", field.name,
                          *static_cast<const double*>(field.in(&self)));
    }
    return name + "(" + text + ")";
  });
}

// A measure of two pictures.
void add_measure(py::module_& module, const char* name, double (*measure)(const GreyPicture&, const GreyPicture&),
                 const char* help) {
  module.def(
      name, [measure](const Levels& a, const Levels& b) { return measure(picture_from(a, "a"), picture_from(b, "b")); },
      py::arg("a"), py::arg("b"), help);
}

void add_control(py::module_& module, const char* name, GreyPicture (*control)(const GreyPicture&), const char* help) {
  module.def(
      name, [control](const Levels& picture) { return array_of(control(picture_from(picture, "picture"))); },
      py::arg("picture"), help);
}

}  // namespace

void bind_similarity(py::module_& module) {
  py::module_ m =
      module.def_submodule("similarity",
                           "Similarity measures of two pictures, as `insonify compare` prints them. Pictures are "
                           "arrays [rows, columns] of levels from 0 to 1; in those of pings the rows are ranges. "
                           "insonify.compare() takes recordings. Pictures of unequal shape raise Error.");
  add_measures<Similarity>(m, module, "Similarity", "Similarity measures of two pictures.");
  add_measures<NormalisedSimilarity>(m, module, "NormalisedSimilarity",
                                     "The measures scaled to 0 (none) to 1 (equal): larger is better for each.");
  add_measure(m, "mean_squared_error", &mean_squared_error, "Mean of the squared differences of all pixels.");
  m.def("psnr_db", &psnr_db, py::arg("mse"), "-10 log10(mse) [dB re full scale 1], infinite for 0.");
  add_measure(m, "ssim", &ssim,
              "Structural similarity, -1 to 1, of pictures of at least 11 x 11 pixels. Wang, Bovik, Sheikh and "
              "Simoncelli, IEEE Trans. Image Processing 13(4), 600 (2004).");
  add_measure(m, "ms_ssim", &ms_ssim,
              "Structural similarity at five scales, 0 to 1; at fewer, with their weights divided by their sum, for "
              "pictures of fewer than 176 x 176 pixels, of which at least 11 x 11 are needed. Wang, "
              "Simoncelli and Bovik, 37th Asilomar Conference (2003).");
  m.def("ms_ssim_scales", &ms_ssim_scales, py::arg("columns"), py::arg("rows"),
        "Scales of MS-SSIM that a picture of so many pixels has room for, 0 to 5.");
  add_measure(m, "correlation", &correlation, "Pearson correlation of the pixels, -1 to 1; 0 for a constant picture.");
  m.def(
      "ks_distance",
      [](const Levels& a, const Levels& b) {
        return ks_distance(std::span(a.data(), static_cast<std::size_t>(a.size())),
                           std::span(b.data(), static_cast<std::size_t>(b.size())));
      },
      py::arg("a"), py::arg("b"),
      "Kolmogorov-Smirnov distance of two samples of any shape, 0 to 1. Raises Error for NaN.");
  m.def(
      "compare_pictures",
      [](const Levels& a, const Levels& b, bool with_ms_ssim) {
        return compare_pictures(picture_from(a, "a"), picture_from(b, "b"), {.ms_ssim = with_ms_ssim});
      },
      py::arg("a"), py::arg("b"), py::arg("ms_ssim") = true,
      "All measures of picture b against picture a: a Similarity. ms_ssim: False to skip that measure, NaN then. "
      "Raises Error for a picture that is constant or not from 0 to 1.");
  m.def(
      "_mean",
      [](const std::vector<Similarity>& all) {
        Similarity mean = all.at(0);
        for (const FieldEntry& field : table_of<Similarity>().fields) {
          double& value = *static_cast<double*>(field.in(&mean));
          for (std::size_t i = 1; i < all.size(); ++i) {
            value += *static_cast<const double*>(field.in(&all[i]));
          }
          value /= static_cast<double>(all.size());
        }
        return mean;
      },
      py::arg("similarities"));
  m.def("normalised", &normalised, py::arg("similarity"), "The measures scaled to 0 to 1: a NormalisedSimilarity.");
  add_control(m, "flat_grey", &flat_grey, "Control: every pixel is the picture's mean.");
  add_control(m, "mean_range_profile", &mean_range_profile, "Control: every row is its own mean.");
  add_control(m, "pixel_shuffle", &pixel_shuffle, "Control: the picture's pixels in a fixed random order.");
  m.def(
      "compare_controls",
      [](const Levels& picture, bool with_ms_ssim) {
        const ControlSimilarities found = compare_controls(picture_from(picture, "picture"), {.ms_ssim = with_ms_ssim});
        py::dict controls;
        controls["flat_grey"] = found.flat_grey;
        controls["range_profile"] = found.range_profile;
        controls["pixel_shuffle"] = found.pixel_shuffle;
        return controls;
      },
      py::arg("picture"), py::arg("ms_ssim") = true,
      "Similarity of each control to its picture, by name: a simulated picture is evidence for the simulator only if "
      "it scores higher than these.");
  m.def(
      "load_grey_picture", [](const py::object& path) { return array_of(load_grey_picture(path_from(path, "path"))); },
      py::arg("path"),
      "Reads a grey PNG of up to 16 bits as levels from 0 to 1. Raises Error for a coloured or transparent picture.");
}

}  // namespace insonify::python

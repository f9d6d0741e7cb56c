// convert.h -- values of fields, vectors, poses and lists between C++ and Python.

#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "insonify/error.h"
#include "insonify/geometry.h"
#include "insonify/settings_table.h"

namespace insonify::python {

namespace py = pybind11;

/// Text of a Python object for a message, shortened: 3, 'three', [1, 2].
[[nodiscard]] std::string shown(py::handle value);

/// "float", "list": the name of an object's class.
[[nodiscard]] std::string type_of(py::handle value);

// Values as Python has them: numbers, words, tuples of numbers, None. Tuples rather than lists or arrays, since a
// change of an element could not reach the configuration.
inline py::object to_python(double value, double scale) {
  return py::float_(value * scale);
}
inline py::object to_python(int value, double /*scale*/) {
  return py::int_(value);
}
inline py::object to_python(std::uint64_t value, double /*scale*/) {
  return py::int_(value);
}
inline py::object to_python(bool value, double /*scale*/) {
  return py::bool_(value);
}
inline py::object to_python(const std::string& value, double /*scale*/) {
  return py::str(value);
}
inline py::object to_python(const std::filesystem::path& value, double /*scale*/) {
  return py::str(value.string());
}
py::object to_python(const Vec3& value, double scale);
py::object to_python(const std::vector<double>& value, double scale);
py::object to_python(const std::vector<int>& value, double scale);
py::object to_python(const std::vector<std::string>& value, double scale);

inline py::object to_python(const EnumWord& value, double /*scale*/) {
  return py::str(std::string(value.text()));
}
template <typename T>
py::object to_python(const std::optional<T>& value, double scale) {
  return value ? to_python(*value, scale) : py::none();
}

// The way back: sets a member from a Python value that is `scale` times the member's.
// @throws Error about `name`, for a value of the wrong type.
void from_python(py::handle value, const std::string& name, double scale, double& member);
void from_python(py::handle value, const std::string& name, double scale, int& member);
void from_python(py::handle value, const std::string& name, double scale, std::uint64_t& member);
void from_python(py::handle value, const std::string& name, double scale, bool& member);
void from_python(py::handle value, const std::string& name, double scale, std::string& member);
void from_python(py::handle value, const std::string& name, double scale, std::filesystem::path& member);
void from_python(py::handle value, const std::string& name, double scale, Vec3& member);
void from_python(py::handle value, const std::string& name, double scale, std::vector<double>& member);
void from_python(py::handle value, const std::string& name, double scale, std::vector<int>& member);
void from_python(py::handle value, const std::string& name, double scale, std::vector<std::string>& member);
void from_python(py::handle value, const std::string& name, double scale, EnumWord& member);

/// A path from text or anything with __fspath__.
[[nodiscard]] inline std::filesystem::path path_from(py::handle value, const std::string& name) {
  std::filesystem::path path;
  from_python(value, name, 1, path);
  return path;
}

template <typename T>
void from_python(py::handle value, const std::string& name, double scale, std::optional<T>& member) {
  if (value.is_none()) {
    member.reset();
    return;
  }
  T found{};
  from_python(value, name, scale, found);
  member = found;
}

/// Two levels (low, high) [dB], as `levels` of pictures.
/// @throws Error unless they increase and are within 400 dB, as for `--levels`.
[[nodiscard]] std::pair<double, double> levels_from(py::handle value);

/// A pose from a position of three numbers, a 4 x 4 matrix, a pair (position, quaternion w x y z), these seven numbers
/// in a row, or a Pose.
/// @throws Error about `name`: for another shape, for values that are not finite, for a matrix that is not a rigid
///         transform, and for a quaternion whose norm is not within 1 % of 1.
[[nodiscard]] Pose pose_from(py::handle value, const std::string& name);

/// The value of a word. @throws Error for a word that is none of them.
template <typename Words>
Words word_from(const std::string& text, const char* name) {
  std::string known;
  for (const auto& [word, value] : words_of<Words>()) {
    if (word == text) {
      return value;
    }
    known += fmt::format("{}{}", known.empty() ? "" : ", ", word);
  }
  throw Error("", name, fmt::format(" = {} must be one of {}", text, known));
}

}  // namespace insonify::python

// convert.cpp -- checks values from Python, and says what was expected.

#include "convert.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/numpy.h>

#include <algorithm>
#include <cmath>

#include "insonify/printable.h"

namespace insonify::python {
namespace {

[[noreturn]] void refuse(py::handle value, const std::string& name, const std::string& expected) {
  throw Error("", name, fmt::format(" = {} must be {}", shown(value), expected));
}

// Python would drop the imaginary part of NumPy's numbers with a warning.
bool is_complex(py::handle value) {
  return PyComplex_Check(value.ptr()) != 0 ||
         (py::hasattr(value, "dtype") && py::str(value.attr("dtype").attr("kind")).equal(py::str("c")));
}

bool is_number(py::handle value) {
  if (PyFloat_Check(value.ptr()) != 0) {  // Also NumPy's float64.
    return true;
  }
  return !is_complex(value) && !py::isinstance<py::bool_>(value) && !py::isinstance<py::str>(value) &&
         (PyNumber_Check(value.ptr()) != 0) && !py::isinstance<py::sequence>(value);
}

// The number of an object with __float__, also NumPy's.
double number_from(py::handle value, const std::string& name, const std::string& expected) {
  if (!is_number(value)) {
    refuse(value, name, expected);
  }
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    refuse(value, name, expected);
  }
  return number;
}

// The whole number of an object with __index__.
template <typename Whole>
Whole whole_from(py::handle value, const std::string& name) {
  if (!py::isinstance<py::bool_>(value)) {
    // Null without __index__; pybind11 could not even name the type.
    if (const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()))) {
      try {
        return whole.cast<Whole>();
      } catch (const py::cast_error&) {  // Too large.
      }
    }
  }
  PyErr_Clear();
  refuse(value, name, std::is_unsigned_v<Whole> ? "a whole number of at least 0" : "a whole number");
}

std::vector<double> numbers_from(py::handle value, const std::string& name, const std::string& expected) {
  if (py::isinstance<py::str>(value) || PySequence_Check(value.ptr()) == 0) {
    refuse(value, name, expected);
  }
  const auto items = py::reinterpret_borrow<py::sequence>(value);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < items.size(); ++i) {
    numbers.push_back(number_from(items[i], fmt::format("{}[{}]", name, i), "a number"));
  }
  return numbers;
}

template <typename Value>
std::vector<Value> list_from(py::handle value, const std::string& name, const std::string& expected) {
  if (py::isinstance<py::str>(value) || PySequence_Check(value.ptr()) == 0) {
    refuse(value, name, expected);
  }
  std::vector<Value> values;
  for (const py::handle item : py::reinterpret_borrow<py::sequence>(value)) {
    const std::string item_name = fmt::format("{}[{}]", name, values.size());
    from_python(item, item_name, 1, values.emplace_back());
  }
  return values;
}

Pose pose_from_matrix(const Eigen::Matrix4d& matrix, const std::string& name) {
  const Eigen::Matrix3d turn = matrix.topLeftCorner<3, 3>();
  constexpr double kSlack = 1e-3;
  const bool rigid = (turn * turn.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < kSlack &&
                     turn.determinant() > 0 &&
                     (matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() < 1e-9;
  if (!matrix.allFinite() || !rigid) {
    throw Error("", name, " must be a rigid transform: a rotation, a position in the last column, and 0 0 0 1 below");
  }
  return {matrix.topRightCorner<3, 1>(), Eigen::Quaterniond(turn).normalized()};
}

Pose pose_from_parts(const std::vector<double>& position, const std::vector<double>& wxyz, const std::string& name) {
  if (position.size() != 3 || wxyz.size() != 4) {
    throw Error(
        "", name,
        fmt::format(" must be (position, quaternion) of 3 and 4 numbers, not {} and {}", position.size(), wxyz.size()));
  }
  if (!std::ranges::all_of(position, [](double number) { return std::isfinite(number); })) {
    throw Error("", name, fmt::format("[0] = [{:.6g}] must be finite", fmt::join(position, ", ")));
  }
  const Eigen::Quaterniond turn(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  if (!(std::abs(turn.norm() - 1) < 0.01)) {
    throw Error("", name,
                fmt::format("[1] = [{:.6g}] must have a norm of 1, not {:.4g}", fmt::join(wxyz, ", "), turn.norm()));
  }
  return {Vec3(position[0], position[1], position[2]), turn.normalized()};
}

}  // namespace

std::string shown(py::handle value) {
  return printable(py::repr(value).cast<std::string>(), kLongestName);
}

std::string type_of(py::handle value) {
  return py::str(py::type::handle_of(value).attr("__name__")).cast<std::string>();
}

py::object to_python(const Vec3& value, double scale) {
  return py::make_tuple(value.x() * scale, value.y() * scale, value.z() * scale);
}

py::object to_python(const std::vector<double>& value, double scale) {
  py::tuple numbers(value.size());
  for (std::size_t i = 0; i < value.size(); ++i) {
    numbers[i] = py::float_(value[i] * scale);
  }
  return numbers;
}

py::object to_python(const std::vector<int>& value, double /*scale*/) {
  py::tuple numbers(value.size());
  for (std::size_t i = 0; i < value.size(); ++i) {
    numbers[i] = py::int_(value[i]);
  }
  return numbers;
}

py::object to_python(const std::vector<std::string>& value, double /*scale*/) {
  py::tuple texts(value.size());
  for (std::size_t i = 0; i < value.size(); ++i) {
    texts[i] = py::str(value[i]);
  }
  return texts;
}

void from_python(py::handle value, const std::string& name, double scale, double& member) {
  member = number_from(value, name, "a number") / scale;
}

void from_python(py::handle value, const std::string& name, double /*scale*/, int& member) {
  member = whole_from<int>(value, name);
}

void from_python(py::handle value, const std::string& name, double /*scale*/, std::uint64_t& member) {
  member = whole_from<std::uint64_t>(value, name);
}

void from_python(py::handle value, const std::string& name, double /*scale*/, bool& member) {
  if (!py::isinstance<py::bool_>(value) && type_of(value) != "bool_") {
    refuse(value, name, "True or False");
  }
  member = value.cast<bool>();
}

void from_python(py::handle value, const std::string& name, double /*scale*/, std::string& member) {
  if (!py::isinstance<py::str>(value)) {
    refuse(value, name, "text");
  }
  member = value.cast<std::string>();
}

void from_python(py::handle value, const std::string& name, double /*scale*/, std::filesystem::path& member) {
  try {
    member = py::module_::import("os").attr("fspath")(value).cast<std::string>();
  } catch (const py::error_already_set&) {
    refuse(value, name, "a path");
  }
}

void from_python(py::handle value, const std::string& name, double scale, Vec3& member) {
  const std::vector<double> numbers = numbers_from(value, name, "three numbers");
  if (numbers.size() != 3) {
    refuse(value, name, "three numbers");
  }
  member = Vec3(numbers[0], numbers[1], numbers[2]) / scale;
}

void from_python(py::handle value, const std::string& name, double scale, std::vector<double>& member) {
  std::vector<double> numbers = numbers_from(value, name, "a list of numbers");
  for (double& number : numbers) {
    number /= scale;
  }
  member = std::move(numbers);
}

void from_python(py::handle value, const std::string& name, double /*scale*/, std::vector<int>& member) {
  member = list_from<int>(value, name, "a list of whole numbers");
}

void from_python(py::handle value, const std::string& name, double /*scale*/, std::vector<std::string>& member) {
  member = list_from<std::string>(value, name, "a list of texts");
}

void from_python(py::handle value, const std::string& name, double /*scale*/, EnumWord& member) {
  const std::vector<std::string_view>& words = member.list->words;
  const auto word = py::isinstance<py::str>(value) ? std::ranges::find(words, value.cast<std::string>()) : words.end();
  if (word == words.end()) {
    refuse(value, name, fmt::format("{}", fmt::join(words, ", ")));
  }
  member.index = static_cast<std::size_t>(word - words.begin());
}

std::pair<double, double> levels_from(py::handle value) {
  constexpr double kMost = 400;
  const std::vector<double> levels = numbers_from(value, "levels", "two numbers");
  if (levels.size() != 2 || !(-kMost <= levels[0] && levels[0] < levels[1] && levels[1] <= kMost)) {
    throw Error("", "levels", " must be two rising numbers [dB] from -400 to 400, such as (-90, -40)");
  }
  return {levels[0], levels[1]};
}

Pose pose_from(py::handle value, const std::string& name) {
  if (py::isinstance<Pose>(value)) {
    return value.cast<Pose>();
  }
  constexpr const char* kExpected =
      "a position of three numbers, a 4 x 4 matrix, a pair (position, quaternion w x y z), the seven numbers of these "
      "or a Pose";
  if (py::isinstance<py::str>(value) || PySequence_Check(value.ptr()) == 0) {
    refuse(value, name, kExpected);
  }
  const auto items = py::reinterpret_borrow<py::sequence>(value);
  if (items.size() == 2 && PySequence_Check(py::object(items[0]).ptr()) != 0) {
    return pose_from_parts(numbers_from(items[0], name + "[0]", "three numbers"),
                           numbers_from(items[1], name + "[1]", "four numbers, w x y z"), name);
  }
  if (items.size() == 3 && PySequence_Check(py::object(items[0]).ptr()) == 0) {
    const std::vector<double> position = numbers_from(items, name, "three numbers");
    return pose_from_parts(position, {1, 0, 0, 0}, name);
  }
  if (items.size() == 7) {
    const std::vector<double> numbers = numbers_from(items, name, "seven numbers");
    return pose_from_parts({numbers.begin(), numbers.begin() + 3}, {numbers.begin() + 3, numbers.end()}, name);
  }
  if (items.size() != 4) {
    refuse(value, name, kExpected);
  }
  Eigen::Matrix4d matrix;
  for (int row = 0; row < 4; ++row) {
    // Four numbers, such as a row of a single matrix where many matrices were expected.
    if (PySequence_Check(py::object(items[row]).ptr()) == 0) {
      refuse(value, name, kExpected);
    }
    const std::vector<double> numbers = numbers_from(items[row], fmt::format("{}[{}]", name, row), "four numbers");
    if (numbers.size() != 4) {
      refuse(value, name, kExpected);
    }
    matrix.row(row) = Eigen::Map<const Eigen::RowVector4d>(numbers.data());
  }
  return pose_from_matrix(matrix, name);
}

}  // namespace insonify::python

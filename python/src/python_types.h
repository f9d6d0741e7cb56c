// python_types.h -- Python type names of converted values, for the type stubs.

#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/pybind11.h>

#include <complex>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "held.h"

namespace insonify::python {

/// Type of a field when read, and when set.
struct PythonType {
  std::string read, given;
};

template <typename Member>
PythonType field_type() {
  if constexpr (std::is_same_v<Member, bool>) {
    return {"bool", "bool"};
  } else if constexpr (std::is_integral_v<Member>) {
    return {"int", "int"};
  } else if constexpr (std::is_floating_point_v<Member>) {
    return {"float", "float"};
  } else if constexpr (std::is_same_v<Member, std::string>) {
    return {"str", "str"};
  } else if constexpr (std::is_same_v<Member, std::filesystem::path>) {
    return {"str", "str | os.PathLike[str]"};
  } else if constexpr (std::is_same_v<Member, Vec3>) {
    return {"tuple[float, float, float]", "Sequence[float]"};
  } else if constexpr (std::is_same_v<Member, std::vector<double>>) {
    return {"tuple[float, ...]", "Sequence[float]"};
  } else if constexpr (std::is_same_v<Member, std::vector<int>>) {
    return {"tuple[int, ...]", "Sequence[int]"};
  } else if constexpr (std::is_same_v<Member, std::vector<std::string>>) {
    return {"tuple[str, ...]", "Sequence[str]"};
  } else {
    const PythonType inner = field_type<typename Member::value_type>();  // The type that an optional holds.
    return {inner.read + " | None", inner.given + " | None"};
  }
}

/// Type stub of a field.
inline PythonType python_type(const FieldEntry& field) {
  if (field.words != nullptr) {
    const std::string words = fmt::format("Literal[\"{}\"]", fmt::join(field.words->words, "\", \""));
    return {words, words};
  }
  return std::visit(
      []<typename Member>(Member*) {
        if constexpr (std::is_same_v<Member, EnumWord>) {
          return PythonType{};
        } else {
          return field_type<Member>();
        }
      },
      field.type);
}

/// Type stub of a part: a struct, an optional one, a list or a dict of them.
inline std::string part_type(const PartEntry& part) {
  const std::string& name = class_of(*part.table).name;
  switch (part.shape) {
    case PartShape::kOptional:
      return name + " | None";
    case PartShape::kList:
      return "list[" + name + "]";
    case PartShape::kMap:  // Materials by name; the name of one of the library stands for it.
      return "dict[str, " + name + " | str]";
    default:
      return name;
  }
}

/// The same where it is given: dicts stand for structs.
inline std::string given_part_type(const PartEntry& part) {
  const std::string one = class_of(*part.table).name + " | dict[str, Any]";
  switch (part.shape) {
    case PartShape::kOptional:
      return one + " | None";
    case PartShape::kList:
      return "Sequence[" + one + "]";
    case PartShape::kMap:
      return "Mapping[str, " + one + " | str]";
    default:
      return one;
  }
}

/// NumPy's name of the type of a table's values.
template <typename Value>
constexpr const char* number_name() {
  if constexpr (std::is_same_v<Value, float>) {
    return "float32";
  } else if constexpr (std::is_same_v<Value, std::complex<float>>) {
    return "complex64";
  } else if constexpr (std::is_same_v<Value, std::uint16_t>) {
    return "uint16";
  } else {
    static_assert(std::is_same_v<Value, std::uint8_t>);
    return "uint8";
  }
}

/// Lists an attribute of a class in the module's `_described`, for tools/make_python_stubs.py.
inline void describe(const py::module_& module, const char* class_name, const std::string& attribute,
                     const PythonType& type) {
  if (!py::hasattr(module, "_described")) {
    module.attr("_described") = py::dict();
  }
  py::dict described = module.attr("_described");
  if (!described.contains(class_name)) {
    described[class_name] = py::list();
  }
  py::list(described[class_name]).append(py::make_tuple(attribute, type.read, type.given));
}

}  // namespace insonify::python

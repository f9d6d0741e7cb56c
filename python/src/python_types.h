// python_types.h -- Python type names of converted values, for the type stubs.

#pragma once

#include <pybind11/pybind11.h>

#include <complex>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "held.h"

namespace insonify::python {

/// Type of a field when read, and when set.
struct PythonType {
  std::string read, given;
};

template <typename T>
struct IsOptional : std::false_type {};
template <typename T>
struct IsOptional<std::optional<T>> : std::true_type {};

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
  } else if constexpr (std::is_enum_v<Member>) {
    std::string words;
    for (const auto& [word, meaning] : words_of<Member>()) {
      words += (words.empty() ? "\"" : ", \"") + std::string(word) + "\"";
    }
    return {"Literal[" + words + "]", "Literal[" + words + "]"};
  } else {
    static_assert(IsOptional<Member>::value);
    const PythonType inner = field_type<typename Member::value_type>();
    return {inner.read + " | None", inner.given + " | None"};
  }
}

template <typename Config>
std::string class_name() {
  return py::str(py::type::of<Held<Config>>().attr("__name__")).cast<std::string>();
}

/// Type stub of a part: a struct, an optional one, a list or a dict of them.
template <typename Member>
std::string part_type() {
  if constexpr (IsOptional<Member>::value) {
    return class_name<typename Member::value_type>() + " | None";
  } else if constexpr (requires { typename Member::mapped_type; }) {
    const std::string name = class_name<typename Member::mapped_type>();
    const bool by_name = std::is_same_v<typename Member::mapped_type, MaterialOverride>;  // "steel" is one too.
    return "dict[str, " + name + (by_name ? " | str]" : "]");
  } else if constexpr (requires { typename Member::value_type; }) {
    return "list[" + class_name<typename Member::value_type>() + "]";
  } else {
    return class_name<Member>();
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

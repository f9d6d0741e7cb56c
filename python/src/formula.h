// formula.h -- binds formulas for numbers and arrays, with errors that name the argument.

#pragma once

#include <pybind11/complex.h>
#include <pybind11/numpy.h>

#include <array>
#include <string>
#include <type_traits>
#include <utility>

#include "convert.h"

namespace insonify::python {

/// An unchecked number or array of numbers from Python. Its signature is that of an array.
struct Numbers {
  py::object given;
};

/// @throws Error about `name` for anything else than a number or an array of numbers.
[[nodiscard]] py::array_t<double> array_from(const Numbers& numbers, const std::string& name);

/// @throws Error with the shapes of arrays that cannot be broadcast together.
void check_shapes(const py::array_t<double>* arrays, const std::string* names, std::size_t count);

namespace formula_detail {

template <typename>
using NumbersFor = Numbers;

template <typename Extra>
void take_name(const Extra& extra, std::string*& next) {
  if constexpr (std::is_base_of_v<py::arg, Extra>) {
    *next++ = extra.name;
  }
}

template <typename Result, typename... Args, std::size_t... I>
py::object over_arrays(Result (*function)(Args...), const std::array<std::string, sizeof...(Args)>& names,
                       const std::array<Numbers, sizeof...(Args)>& given, std::index_sequence<I...>) {
  const std::array<py::array_t<double>, sizeof...(Args)> arrays = {array_from(given[I], names[I])...};
  check_shapes(arrays.data(), names.data(), arrays.size());
  return py::vectorize(function)(arrays[I]...);
}

}  // namespace formula_detail

/// Adds a function to a module: it returns a number for numbers, and an array of the broadcast shape for arrays.
/// @param extra  An arg() for each argument, and the help.
template <typename Result, typename... Args, typename... Extra>
void add_formula(py::module_& module, const char* name, Result (*function)(Args...), const Extra&... extra) {
  std::array<std::string, sizeof...(Args)> names;
  std::string* next = names.data();
  (formula_detail::take_name(extra, next), ...);
  module.def(
      name,
      [function, names](const formula_detail::NumbersFor<Args>&... given) {
        return formula_detail::over_arrays(function, names, {given...}, std::index_sequence_for<Args...>());
      },
      extra...);
}

}  // namespace insonify::python

namespace PYBIND11_NAMESPACE {
namespace detail {

template <>
struct type_caster<insonify::python::Numbers> {
  PYBIND11_TYPE_CASTER(insonify::python::Numbers, const_name("numpy.ndarray[numpy.float64]"));
  bool load(handle source, bool /*convert*/) {
    value.given = reinterpret_borrow<object>(source);
    return true;
  }
};

}  // namespace detail
}  // namespace PYBIND11_NAMESPACE

// field_table.cpp -- help, values, comparison and text of any configuration's fields.

#include "field_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace insonify::python {
namespace {

// repr() of a value, but with 12 digits: angles are kept in radians, where 15 degrees are 14.999999999999998.
std::string rounded(py::handle value) {
  if (py::isinstance<py::float_>(value)) {
    return shown(py::float_(py::str(fmt::format("{:.12g}", value.cast<double>()))));
  }
  if (!py::isinstance<py::tuple>(value)) {
    return shown(value);
  }
  std::string text;
  for (const py::handle one : py::reinterpret_borrow<py::tuple>(value)) {
    text += (text.empty() ? "" : ", ") + rounded(one);
  }
  return "(" + text + (py::len(value) == 1 ? ",)" : ")");
}

}  // namespace

std::string FieldTable::help_of(const FieldEntry& entry, const void* defaults, double scale, std::string_view unit) {
  std::string facts;
  const auto add = [&](const std::string& fact) { facts += (facts.empty() ? "" : ", ") + fact; };
  const Limits& limits = entry.field.limits;
  if (!unit.empty()) {
    add(std::string(unit));
  }
  if (std::isfinite(limits.least) || std::isfinite(limits.most)) {
    add(limits.text(scale));
  }
  if (!entry.type->words.empty()) {
    add("one of " + entry.type->words);
  }
  const void* value = entry.in(defaults);
  if (entry.type->is_double) {
    add(fmt::format("default {:.10g}", *static_cast<const double*>(value) * scale));  // 120, not 119.99999999999999.
  } else {
    add("default " + shown(entry.type->to_python(value, scale)));
  }
  return fmt::format("{} [{}]", entry.field.help, facts);
}

py::list FieldTable::values(const void* config) const {
  py::list all;
  for (const FieldEntry& entry : entries_) {
    all.append(entry.type->to_python(entry.in(config), 1));
  }
  return all;
}

void FieldTable::set_values(const py::list& values, void* config) const {
  std::size_t index = 0;
  for (const FieldEntry& entry : entries_) {
    entry.type->restore(values[index++], std::string(entry.field.name), entry.in(config));
  }
}

bool FieldTable::equal(const void* one, const void* other) const {
  return std::ranges::all_of(
      entries_, [&](const FieldEntry& entry) { return entry.type->equal(entry.in(one), entry.in(other)); });
}

std::string FieldTable::changes(const void* config, const void* defaults) const {
  std::string text;
  for (const FieldEntry& entry : entries_) {
    const double scale = file_scale_of(entry.field);
    const py::object value = entry.type->to_python(entry.in(config), scale);
    if (!value.equal(entry.type->to_python(entry.in(defaults), scale))) {
      text += (text.empty() ? "" : ", ") + file_name_of(entry.field) + "=" + rounded(value);
    }
  }
  return text;
}

}  // namespace insonify::python

// held.cpp -- parts of configurations as Python objects and back, by the tables of the configurations.

#include "held.h"

#include <fmt/format.h>

namespace insonify::python {
namespace {

// Whether it is a dict, or a frozen object's read-only view of one.
bool is_mapping(py::handle object) {
  return py::isinstance<py::dict>(object) || Py_IS_TYPE(object.ptr(), &PyDictProxy_Type);
}

// The same error about a member of `owner`.
[[noreturn]] void throw_within(const std::string& owner, const std::string& object, const std::string& field,
                               const std::string& text) {
  const std::string own = member_name(object, field);
  if (own.empty() || !text.starts_with(own)) {
    throw Error(owner + ": " + text);
  }
  throw Error(member_name(owner, object), field, text.substr(own.size()));
}

py::object wrap_part(const PartEntry& part, const void* config, const char* frozen) {
  py::list list;
  py::dict dict;
  for (const auto& [suffix, settings] : part.entries(config)) {
    const py::object wrapped = class_of(*part.table).wrap(settings.config, frozen);
    if (part.shape == PartShape::kStruct || part.shape == PartShape::kOptional) {
      return wrapped;
    }
    if (part.shape == PartShape::kList) {
      list.append(wrapped);
    } else {
      dict[py::str(suffix.substr(1))] = wrapped;
    }
  }
  if (part.shape == PartShape::kOptional) {
    return py::none();
  }
  if (part.shape == PartShape::kList) {
    return frozen == nullptr ? py::object(list) : py::object(py::tuple(list));
  }
  return frozen == nullptr ? py::object(dict) : py::reinterpret_steal<py::object>(PyDictProxy_New(dict.ptr()));
}

}  // namespace

HeldClass& class_of(const SettingsTable& table) {
  static std::map<const SettingsTable*, HeldClass> classes;
  return classes[&table];
}

Parts wrap_parts(ConstSettings settings, const char* frozen) {
  Parts parts;
  for (const PartEntry& part : settings.table->parts) {
    parts[std::string(part.name)] = wrap_part(part, settings.config, frozen);
  }
  return parts;
}

void unwrap_part(py::handle object, const std::string& name, const PartEntry& part, void* config) {
  const auto unwrap_entry = [&](py::handle entry, const std::string& its_name, const std::string& key) {
    class_of(*part.table).unwrap(entry, its_name, part.add(config, key).config);
  };
  if (part.shape == PartShape::kStruct || (part.shape == PartShape::kOptional && !object.is_none())) {
    unwrap_entry(object, name, {});
    return;
  }
  part.clear(config);
  if (part.shape == PartShape::kList) {
    if (py::isinstance<py::str>(object) || PySequence_Check(object.ptr()) == 0) {
      throw Error("", name, fmt::format(" = {} must be a list", shown(object)));
    }
    const auto items = py::reinterpret_borrow<py::sequence>(object);
    for (std::size_t i = 0; i < items.size(); ++i) {
      unwrap_entry(items[i], fmt::format("{}[{}]", name, i), {});
    }
  } else if (part.shape == PartShape::kMap) {
    if (!is_mapping(object)) {
      throw Error("", name, fmt::format(" = {} must be a dict", shown(object)));
    }
    for (const std::pair<py::handle, py::handle> item : py::dict(py::reinterpret_borrow<py::object>(object))) {
      if (!py::isinstance<py::str>(item.first)) {
        throw Error("", name, fmt::format(" has the key {}, must be text", shown(item.first)));
      }
      const auto key = item.first.cast<std::string>();
      unwrap_entry(item.second, member_name(name, key), key);
    }
  }
}

py::object as_held(py::handle object, const std::string& name, const HeldClass& held_class) {
  if (!py::isinstance<py::dict>(object)) {
    return py::reinterpret_borrow<py::object>(object);
  }
  try {
    return held_class.make(py::reinterpret_borrow<py::dict>(object));
  } catch (const Error& error) {
    throw_within(name, error.object(), error.field(), error.what());
  } catch (const py::type_error& error) {
    throw Error(name + ": " + error.what());
  } catch (const py::error_already_set& error) {  // Thrown by the setter of a field.
    const py::object raised = error.value();
    const auto text_of = [&](const char* member) {
      return py::getattr(raised, member, py::str("")).cast<std::string>();
    };
    throw_within(name, text_of("object"), text_of("field"), py::str(raised));
  }
}

py::object as_part(const py::object& value, const std::string& name, const PartEntry& part) {
  const HeldClass& held_class = class_of(*part.table);
  if (part.shape == PartShape::kStruct || part.shape == PartShape::kOptional) {
    return as_held(value, name, held_class);
  }
  if (part.shape == PartShape::kList) {
    py::list list;
    for (const py::handle one : value) {
      list.append(as_held(one, fmt::format("{}[{}]", name, list.size()), held_class));
    }
    return list;
  }
  py::dict dict;
  for (const std::pair<py::handle, py::handle> item : py::dict(value)) {
    dict[item.first] = as_held(item.second, member_name(name, item.first.cast<std::string>()), held_class);
  }
  return dict;
}

void unwrap_parts(const Parts& parts, const std::string& name, Settings settings) {
  for (const PartEntry& part : settings.table->parts) {
    unwrap_part(parts.at(std::string(part.name)), member_name(name, part.name), part, settings.config);
  }
}

py::object thawed(const py::object& part) {
  return py::isinstance<py::tuple>(part) ? py::object(py::list(part))
         : is_mapping(part)              ? py::object(py::dict(part))
                                         : part;
}

void refuse_class(py::handle object, const std::string& name, const std::string& expected) {
  throw Error("", name, fmt::format(" = {} must be a {} or a dict of its fields", shown(object), expected));
}

}  // namespace insonify::python

// bind_scene.cpp -- insonify.Scene: from files, or built from arrays.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/numpy.h>

#include "bind.h"
#include "held.h"
#include "insonify/files.h"
#include "insonify/mesh.h"
#include "insonify/printable.h"
#include "insonify/settings_table.h"

namespace insonify::python {
namespace {

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<std::int64_t, py::array::c_style>;

void take_vertices(const Floats& vertices, Mesh& mesh) {
  if (vertices.ndim() != 2 || vertices.shape(1) != 3) {
    throw Error("", "vertices", fmt::format(" must be an array [n, 3], has {} axes", vertices.ndim()));
  }
  const auto from = vertices.unchecked<2>();
  for (py::ssize_t i = 0; i < vertices.shape(0); ++i) {
    mesh.vertices.emplace_back(from(i, 0), from(i, 1), from(i, 2));
  }
}

void take_faces(const py::object& given, Mesh& mesh) {
  const py::array array = py::module_::import("numpy").attr("asarray")(given);
  const bool is_whole = array.dtype().kind() == 'i' || array.dtype().kind() == 'u';
  // Unsigned 64-bit indices that do not fit are beyond any mesh.
  const bool is_wide = array.dtype().kind() == 'u' && array.itemsize() == 8;
  const py::object signed_array = is_wide
                                      ? py::module_::import("numpy")
                                            .attr("minimum")(array, py::int_(std::numeric_limits<std::int64_t>::max()))
                                            .attr("astype")("int64")
                                      : py::object(array);
  const auto faces = is_whole ? Indices::ensure(signed_array) : Indices();
  if (!faces || faces.ndim() != 2 || faces.shape(1) != 3) {
    PyErr_Clear();
    throw Error("", "faces", " must be an array [n, 3] of whole numbers");
  }
  const auto from = faces.unchecked<2>();
  const auto count = static_cast<std::int64_t>(mesh.vertices.size());
  for (py::ssize_t i = 0; i < faces.shape(0); ++i) {
    std::array<std::uint32_t, 3> corners{};
    for (int k = 0; k < 3; ++k) {
      if (from(i, k) < 0 || from(i, k) >= count) {
        throw Error("", "faces",
                    fmt::format("[{}][{}] = {} must be from 0 to {}, the last vertex", i, k, from(i, k), count - 1));
      }
      corners[k] = static_cast<std::uint32_t>(from(i, k));
    }
    mesh.triangles.push_back(corners);
  }
}

// @param material  A name for all faces, or one for each.
void take_materials(const py::object& material, Mesh& mesh) {
  if (py::isinstance<py::str>(material)) {
    mesh.material_names = {material.cast<std::string>()};
    return;
  }
  if (PySequence_Check(material.ptr()) == 0 || py::len(material) != mesh.triangles.size()) {
    throw Error("", "material",
                fmt::format(" must be a name, or a list of {} names, one for each face", mesh.triangles.size()));
  }
  mesh.material_names.clear();
  for (const py::handle& name : material) {
    const std::string word = py::str(name);
    const auto known = std::ranges::find(mesh.material_names, word);
    mesh.material_slots.push_back(static_cast<std::uint16_t>(known - mesh.material_names.begin()));
    if (known == mesh.material_names.end()) {
      mesh.material_names.push_back(word);
    }
  }
}

py::list instance_names(const Scene& scene) {
  py::list names;
  for (const Instance& instance : scene.instances) {
    names.append(instance.present ? instance.name : "");
  }
  return names;
}

[[noreturn]] void throw_missing(const Scene& scene, const std::string& name) {
  std::vector<std::string> names;
  for (const Instance& instance : scene.instances) {
    if (instance.present) {
      names.push_back(instance.name);
    }
  }
  throw Error("", "name",
              fmt::format(" = {} is not in the scene, which has {}", name,
                          names.empty() ? "no objects" : fmt::format("{}", fmt::join(names, ", "))));
}

// Adds an instance of a mesh.
void put(Scene& scene, const std::string& name, Mesh mesh, const py::object& pose) {
  if (std::ranges::any_of(scene.instances, [&](const Instance& one) { return one.name == name; })) {
    throw Error("", "name", fmt::format(" = {} exists already", name));
  }
  mesh.name = name;
  const MeshReport report = clean_mesh(mesh);
  if (const std::string text = report.dropped() > 0 ? report.text() : ""; !text.empty()) {
    warnings_log()(Severity::kWarning, name + ": " + text);
  }
  Instance instance{.name = name, .mesh = std::make_shared<Mesh>(std::move(mesh)), .names_resolve = true};
  if (!pose.is_none()) {
    instance.world_from_mesh = pose_from(pose, "pose");
  }
  check_reach(instance, name);
  scene.instances.push_back(std::move(instance));
}

void add(Scene& scene, const std::string& name, const Floats& vertices, const py::object& faces,
         const py::object& material, const py::object& pose) {
  Mesh mesh;
  take_vertices(vertices, mesh);
  take_faces(faces, mesh);
  take_materials(material, mesh);
  put(scene, name, std::move(mesh), pose);
}

double length_from(py::handle given, const std::string& name) {
  double length = 0;
  from_python(given, name, 1, length);
  check_field("", Field{name, "m", above_to(0, 1e6), ""}, length);
  return length;
}

// A shape as of SDF. `sizes`: the names and values of its lengths.
void add_shape(Scene& scene, const std::string& name, const std::string& shape, const py::dict& sizes,
               const std::string& material, const py::object& pose) {
  std::vector<double> lengths;
  for (const auto& [size_name, value] : sizes) {
    lengths.push_back(length_from(value, size_name.cast<std::string>()));
  }
  Mesh mesh = shape == "box"        ? make_box({lengths[0], lengths[1], lengths[2]})
              : shape == "sphere"   ? make_sphere(lengths[0])
              : shape == "cylinder" ? make_cylinder(lengths[0], lengths[1])
                                    : make_plane(Vec3::UnitZ(), lengths[0], lengths[1]);
  mesh.material_names = {material};
  put(scene, name, std::move(mesh), pose);
}

void add_heights(Scene& scene, const std::string& name, const Floats& heights, const py::object& spacing_x,
                 const py::object& spacing_y, const std::string& material, const py::object& pose) {
  const HeightGrid grid{.columns = static_cast<int>(heights.shape(1)),
                        .rows = static_cast<int>(heights.shape(0)),
                        .spacing_x = length_from(spacing_x, "spacing"),
                        .spacing_y = length_from(spacing_y, "spacing"),
                        .heights = {heights.data(), heights.data() + heights.size()},
                        .name = name};
  Mesh mesh = make_height_field(grid);
  mesh.material_names = {material};
  put(scene, name, std::move(mesh), pose);
}

// Adds the instances of another scene, moved and renamed.
void merge(Scene& scene, const Scene& other, const py::dict& names, const std::string& material, const Pose& pose) {
  const std::vector<Instance> instances = other.instances;  // A scene may be merged with itself.
  for (const Instance& one : instances) {
    if (!one.present) {
      continue;
    }
    Instance added = one;
    added.name = names[py::str(one.name)].cast<std::string>();
    if (std::ranges::any_of(scene.instances, [&](const Instance& known) { return known.name == added.name; })) {
      throw Error("", "name", fmt::format(" = {} exists already", added.name));
    }
    added.world_from_mesh = pose * one.world_from_mesh;
    added.user_material = material.empty() ? one.user_material : material;
    check_reach(added, added.name);
    if (const auto place = other.places.find(one.name); place != other.places.end()) {
      scene.places[added.name] = place->second;
    }
    scene.instances.push_back(std::move(added));
  }
}

// Whether an object is `name`, or a part of it: of "ship::hull::skin" also "hull" and "skin".
bool is_named(const std::string& scoped, const std::string& name) {
  return ("::" + scoped + "::").find("::" + name + "::") != std::string::npos;
}

void set_material(Scene& scene, const std::string& name, const std::string& material) {
  bool found = false;
  for (Instance& instance : scene.instances) {
    if (instance.present && is_named(instance.name, name)) {
      instance.user_material = material;
      found = true;
    }
  }
  if (!found) {
    throw_missing(scene, name);
  }
}

}  // namespace

void bind_scene(py::module_& module) {
  py::class_<Scene>(module, "Scene",
                    "The scene to insonify: instances of meshes, each with a name, a pose and materials.")
      .def(py::init<>(), "An empty scene, to add objects to.")
      .def_static(
          "load",
          [](const py::object& path, bool collisions, bool strict, const py::object& ignore, bool keep_water,
             const py::object& arguments, bool parts) {
            WorldOptions options{.collisions = collisions, .strict = strict, .keep_water = keep_water, .parts = parts};
            from_python(ignore, "ignore", 1, options.ignore);
            from_python(arguments, "arguments", 1, options.arguments);
            return load_scene(path_from(path, "path"), options, warnings_log());
          },
          py::arg("path"), py::arg("collisions") = false, py::arg("strict") = false, py::arg("ignore") = py::tuple(),
          py::arg("keep_water") = false, py::arg("arguments") = py::tuple(), py::arg("parts") = false,
          "Reads an SDF world or model, a mesh (OBJ, STL, DAE, PLY, glTF) or a height grid.\n\n"
          "collisions: take SDF's collision shapes instead of its visuals. strict: raise Error for a model or a file "
          "that is missing, instead of leaving it out with a warning. ignore: patterns of the names of objects to "
          "leave out, such as [\"box_walls*\"]. keep_water: keep what is water by its name or look. arguments: of a "
          "Stonefish scenario, such as [\"px=8\"]. parts: an instance for each named part of a mesh file. Raises Error "
          "with the path.")
      .def("add", &add, py::arg("name"), py::arg("vertices"), py::arg("faces"), py::arg("material") = "sand",
           py::arg("pose") = py::none(),
           "Adds a mesh.\n\nvertices: array [n, 3] in metres. faces: array [m, 3] of indices from 0. material: name of "
           "a library material or of one of the scenario's `materials`, or a list of names, one for each face. pose: "
           "where the mesh is, as of Simulator.ping(). Raises Error for a name that exists already, and for an invalid "
           "mesh; warns of dropped faces. An unknown material is an Error of the Simulator made with the scene.")
      .def("_add_shape", &add_shape, py::arg("name"), py::arg("shape"), py::arg("sizes"), py::arg("material"),
           py::arg("pose"))
      .def("_add_heights", &add_heights, py::arg("name"), py::arg("heights"), py::arg("spacing_x"),
           py::arg("spacing_y"), py::arg("material"), py::arg("pose"))
      .def("_merge", &merge, py::arg("other"), py::arg("names"), py::arg("material"), py::arg("pose"))
      .def("set_material", &set_material, py::arg("object"), py::arg("material"),
           "Gives an object one material for all of it.\n\nobject: its name, in full or a part of it: that of a model, "
           "a link or a visual. material: name of a library material or of one of the scenario's `materials`. Raises "
           "Error for an object that is not there, with those that are; an unknown material is an Error of the "
           "Simulator made with the scene.")
      .def_property_readonly("instance_names", &instance_names,
                             "Names by index in Ping.instance; \"\" where an object was removed.")
      .def_property_readonly(
          "material_names",
          [](const Scene& self) {
            py::list names;
            for (const Material& material : self.materials) {
              names.append(material.name);
            }
            return names;
          },
          "Names by index in Ping.material; empty before materials are assigned.")
      .def_property_readonly(
          "materials",
          [](const Scene& self) {
            py::list all;
            for (const Material& material : self.materials) {
              all.append(wrap(material));
            }
            return all;
          },
          "Copies of the materials by that index.")
      .def(
          "triangles",
          [](const Scene& self, const std::string& name) {
            const auto found = std::ranges::find(self.instances, name, &Instance::name);
            if (found == self.instances.end()) {
              throw_missing(self, name);
            }
            const Mesh& mesh = *found->mesh;
            py::array_t<double> corners(
                {static_cast<py::ssize_t>(mesh.triangles.size()), py::ssize_t{3}, py::ssize_t{3}});
            auto to = corners.mutable_unchecked<3>();
            for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
              for (int k = 0; k < 3; ++k) {
                const Vec3 corner = found->world_from_mesh * mesh.vertices[mesh.triangles[i][k]].cast<double>();
                for (int axis = 0; axis < 3; ++axis) {
                  to(static_cast<py::ssize_t>(i), k, axis) = corner[axis];
                }
              }
            }
            return corners;
          },
          py::arg("name"),
          "Triangles of an instance in the world, float64 [triangles, corners, xyz] in metres. Raises Error for a name "
          "that is not there.")
      .def_property_readonly("triangle_count", &Scene::triangle_count)
      .def_property_readonly(
          "bounds",
          [](const Scene& self) {
            const Box3 box = self.bounds();
            return py::make_tuple(to_python(box.low, 1), to_python(box.high, 1));
          },
          "((x, y, z) of the lowest corner, of the highest) [m].")
      .def("__repr__", [](const Scene& self) {
        return fmt::format("<Scene of {}, {}>", counted(self.instances.size(), "instance"),
                           counted(self.triangle_count(), "triangle"));
      });
  py::class_<SimulatorsScene, Scene>(module, "_SimulatorsScene", "A copy of a simulator's scene.");
}

}  // namespace insonify::python

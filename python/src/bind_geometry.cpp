// bind_geometry.cpp -- insonify.Pose.

#include <fmt/format.h>
#include <pybind11/numpy.h>

#include "bind.h"
#include "convert.h"

namespace insonify::python {

void bind_geometry(py::module_& module) {
  py::class_<Pose>(module, "Pose",
                   "A rigid transform, named after both frames, result first: p_world = world_from_sonar * p_sonar.\n\n"
                   "World: right-handed, z up. Vehicle and sonar: x forward, y to port, z up. Made from a position "
                   "(x, y, z) [m], from a 4 x 4 matrix, from (position, quaternion w x y z), by Pose.rpy() or by "
                   "Pose.look_at().")
      .def(py::init([](const py::object& pose) { return pose.is_none() ? Pose() : pose_from(pose, "pose"); }),
           py::arg("pose") = py::none())
      .def_static(
          "rpy",
          [](const py::object& position, const py::object& angles_deg) {
            Vec3 place, turn;
            from_python(position, "position", 1, place);
            from_python(angles_deg, "angles_deg", degrees_from_radians(1), turn);
            if (!place.allFinite()) {
              throw Error("", "position", fmt::format(" = {} must be finite", shown(position)));
            }
            if (!turn.allFinite()) {
              throw Error("", "angles_deg", fmt::format(" = {} must be finite", shown(angles_deg)));
            }
            return Pose{place, orientation_from_rpy(turn.x(), turn.y(), turn.z())};
          },
          py::arg("position") = py::make_tuple(0, 0, 0), py::arg("angles_deg") = py::make_tuple(0, 0, 0),
          "Position [m], and roll, pitch and yaw about fixed axes as in SDF [deg]: positive pitch looks down.")
      .def_property_readonly(
          "position", [](const Pose& self) { return to_python(self.position, 1); }, "(x, y, z) [m].")
      .def_property_readonly(
          "orientation",
          [](const Pose& self) {
            const Eigen::Quaterniond& turn = self.orientation;
            return py::make_tuple(turn.w(), turn.x(), turn.y(), turn.z());
          },
          "Unit quaternion (w, x, y, z).")
      .def_property_readonly(
          "matrix",
          [](const Pose& self) {
            py::array_t<double> matrix({4, 4});
            auto to = matrix.mutable_unchecked<2>();
            Eigen::Matrix4d values = Eigen::Matrix4d::Identity();
            values.topLeftCorner<3, 3>() = self.orientation.toRotationMatrix();
            values.topRightCorner<3, 1>() = self.position;
            for (int row = 0; row < 4; ++row) {
              for (int column = 0; column < 4; ++column) {
                to(row, column) = values(row, column);
              }
            }
            return matrix;
          },
          "Array [4, 4].")
      .def_property_readonly(
          "angles_deg",
          [](const Pose& self) { return to_python(rpy_from_orientation(self.orientation), degrees_from_radians(1)); },
          "Roll, pitch and yaw about fixed axes, as for rpy() [deg].")
      .def("inverse", &Pose::inverse)
      .def(
          "__mul__", [](const Pose& a, const Pose& b) { return a * b; }, py::is_operator())
      .def(
          "__eq__",
          [](const Pose& a, const Pose& b) {
            return a.position == b.position && a.orientation.coeffs() == b.orientation.coeffs();
          },
          py::is_operator())
      .def(py::pickle(
          [](const Pose& self) {
            const Eigen::Quaterniond& turn = self.orientation;
            return py::make_tuple(to_python(self.position, 1), turn.w(), turn.x(), turn.y(), turn.z());
          },
          [](const py::tuple& state) {
            Pose pose;
            from_python(state[0], "position", 1, pose.position);
            pose.orientation = Eigen::Quaterniond(state[1].cast<double>(), state[2].cast<double>(),
                                                  state[3].cast<double>(), state[4].cast<double>());
            return pose;
          }))
      .def("__repr__", [](const Pose& self) {
        const Vec3& p = self.position;
        const Eigen::Quaterniond& q = self.orientation;
        return fmt::format("Pose((({:.6g}, {:.6g}, {:.6g}), ({:.6g}, {:.6g}, {:.6g}, {:.6g})))", p.x(), p.y(), p.z(),
                           q.w(), q.x(), q.y(), q.z());
      });
}

}  // namespace insonify::python

#include <pybind11/stl.h>

#include "mesh/io.h"
#include "mesh/shapes.h"
#include "mesh/topology.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/call.h"

namespace gsp::python {

namespace {

py::tuple read(const std::string& path, const py::kwargs& keywords) {
  Call call("read", keywords);
  ReadOptions options{.weld = call.take<double>("weld")};
  if (const auto repair = call.take<std::string>("repair")) options.repair = repair_of(*repair);
  SurfaceFile file;
  call.run([&](Progress& progress) {
    file = read_surface(path, options);
    for (const std::string& note : file.notes) progress.note(note);
  });
  return arrays_of(std::move(file.mesh));
}

void write(const std::string& path, const py::object& positions, const py::object& faces,
           const std::vector<std::string>& comments) {
  const Mesh mesh = mesh_of(positions, faces);
  const py::gil_scoped_release unlocked;
  write_mesh(path, mesh, comments);
}

TopologyReport topology(const py::object& positions, const py::object& faces) {
  const Mesh mesh{positions_of(positions), triangles_of(faces, "faces")};  // the report says which are out of range
  const py::gil_scoped_release unlocked;
  return topology_report(mesh);
}

void bind_report(py::module_& module) {
  py::class_<ComponentReport>(module, "Component", "One connected component of a surface.")
      .def_readonly("vertices", &ComponentReport::vertices)
      .def_readonly("edges", &ComponentReport::edges)
      .def_readonly("faces", &ComponentReport::faces)
      .def_readonly("boundary_loops", &ComponentReport::boundary_loops)
      .def_readonly("manifold", &ComponentReport::manifold)
      .def_readonly("orientable", &ComponentReport::orientable)
      .def_readonly("genus", &ComponentReport::genus, "None where it is no orientable manifold")
      .def_readonly("first_face", &ComponentReport::first_face)
      .def_readonly("has_area", &ComponentReport::has_area);
  py::class_<TopologyReport>(module, "Topology", "What a surface is, and why it cannot be used.")
      .def_readonly("vertices", &TopologyReport::vertices)
      .def_readonly("faces", &TopologyReport::faces)
      .def_readonly("components", &TopologyReport::components)
      .def_readonly("boundary_loops", &TopologyReport::boundary_loops)
      .def_readonly("boundary_edges", &TopologyReport::boundary_edges)
      .def_readonly("isolated_vertices", &TopologyReport::isolated_vertices)
      .def_readonly("non_finite_vertices", &TopologyReport::non_finite_vertices)
      .def_readonly("non_manifold_edges", &TopologyReport::non_manifold_edges)
      .def_readonly("non_manifold_vertices", &TopologyReport::non_manifold_vertices)
      .def_readonly("misoriented_edges", &TopologyReport::misoriented_edges)
      .def_readonly("out_of_range_faces", &TopologyReport::out_of_range_faces)
      .def_readonly("repeated_index_faces", &TopologyReport::repeated_index_faces)
      .def_readonly("duplicate_faces", &TopologyReport::duplicate_faces)
      .def_readonly("zero_area_faces", &TopologyReport::zero_area_faces)
      .def_readonly("duplicate_positions", &TopologyReport::duplicate_positions)
      .def_property_readonly("usable", &TopologyReport::usable, "whether parameterize takes it")
      .def_property_readonly(
          "refusal",
          [](const TopologyReport& report) {
            return report.refusal ? py::object(py::str(report.refusal->what())) : py::none();
          },
          "the first reason why not, or None");
}

}  // namespace

void bind_surfaces(py::module_& module) {
  bind_report(module);
  module.def(
      "read", &read, py::arg("path"),
      "read(path, *, weld=None, repair=None, on_note=None) -> (positions, faces)\n\n"
      "A surface from PLY, OBJ, OFF or STL: float64 (n, 3) in the file's unit, int32 (m, 3). Polygons are cut\n"
      "into triangles. weld joins vertices within that share of the bounding box's diagonal, 0 to 0.01; 0 those\n"
      "at the same place. repair=\"cut\" cuts apart edges of more than two faces, or of two that run the same way, "
      "and\n"
      "vertices of more than one fan. Raises gsp.Error with the line or byte.");
  module.def("write", &write, py::arg("path"), py::arg("positions"), py::arg("faces"),
             py::arg("comments") = std::vector<std::string>{},
             "Writes (n, 3) positions and (m, 3) faces as PLY, OBJ, OFF or STL by the ending; whole or not at all.");
  module.def("topology", &topology, py::arg("positions"), py::arg("faces"),
             "Components, boundaries, genus of (n, 3) positions and (m, 3) faces, and the first reason why\n"
             "parameterize would refuse them. Takes any indices and coordinates.");
  module.def(
      "sphere", [](int level) { return arrays_of(shapes::sphere(level)); }, py::arg("level"),
      "The unit sphere: an icosahedron quadrisected `level` times, 0 to 8. Returns (positions, faces).");
  module.def(
      "torus", [](int m, int n, double major, double minor) { return arrays_of(shapes::torus(m, n, major, minor)); },
      py::arg("m"), py::arg("n"), py::arg("major") = 1.0, py::arg("minor") = 0.4,
      "A torus about the z axis, m x n quads, each 3 at least, cut in two. Returns (positions, faces).");
}

}  // namespace gsp::python

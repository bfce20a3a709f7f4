#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "param/map/parameterization.h"
#include "remesh/semiregular.h"

namespace gsp::python {

namespace py = pybind11;

/// gsp.Map: a map, and what making it had to say; empty where it was read from a file.
struct Map {
  Parameterization map;
  py::dict summary;
  py::object omega = py::none();  ///< (k, 5) of the removals, as write_omega_csv has the columns
};

/// gsp.Remesh: a semi-regular mesh and how it was made (`provenance_of`).
struct Remesh {
  SemiregularMesh mesh;
  std::vector<std::string> provenance;
  std::vector<Triangle> faces = {};  ///< of the finest level, once asked for
};

// Each adds one part of the module.
void bind_surfaces(py::module_& module);
void bind_map(py::module_& module);
void bind_code(py::module_& module);
void bind_measures(py::module_& module);
void bind_results(py::module_& module);

}  // namespace gsp::python

#include <pybind11/stl.h>

#include "experiments/base/base_by_rate.h"
#include "metrics/distortion.h"
#include "metrics/smoothness.h"
#include "param/map/param_file.h"
#include "param/parameterize.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/call.h"

namespace gsp::python {

namespace {

py::dict summary_of(const ParameterizeResult& result) {
  py::dict summary;
  summary["flips_before_repair"] = result.flips_before_repair;
  summary["relaxation_rounds"] = result.relaxation_rounds;
  summary["corners_moved"] = result.corners_moved;
  summary["base_edges_flipped"] = result.base_edges_flipped;
  summary["held_vertices"] = result.held_vertices;
  summary["feature_edges"] = result.features.edges.size();
  summary["feature_curves"] = result.features.curves;
  summary["feature_curves_given_way"] = result.features.given_way;
  return summary;
}

py::array omega_of(const std::vector<OmegaRecord>& records) {
  py::array_t<double> rows({static_cast<py::ssize_t>(records.size()), py::ssize_t{5}});
  auto row = rows.mutable_unchecked<2>();
  for (std::size_t i = 0; i < records.size(); ++i) {
    const OmegaRecord& r = records[i];
    const double values[] = {static_cast<double>(r.remaining_vertices), r.shape, r.dispersion, r.metric, r.omega()};
    for (int k = 0; k < 5; ++k) row(static_cast<py::ssize_t>(i), k) = values[k];
  }
  return rows;
}

Map parameterize_arrays(const py::object& positions, const py::object& faces, const py::kwargs& keywords) {
  Call call("parameterize", keywords);
  CellOptions cell;
  cell.parameterize = preset_options(call.take<std::string>("preset").value_or(preset_words().front()));
  call.take_options(option_names(StageKind::Parameterize), cell);
  ParameterizeOptions options = cell.parameterize;
  options.method = method_of(cell.method);
  if (const py::object edges = call.take_object("feature_edges"); !edges.is_none())
    options.features = pairs_of(edges, "feature_edges");
  const Mesh mesh = mesh_of(positions, faces);
  ParameterizeResult result;
  call.run([&](Progress& progress) {
    require_parameterizable(mesh);
    result = parameterize(mesh, with_base_by_rate(mesh, options, progress), progress);
  });
  Map map{{}, summary_of(result), omega_of(result.omega)};
  map.map = std::move(result.map);
  return map;
}

void bind_map_class(py::module_& module) {
  using Map = python::Map;
  const auto part = [](auto member) {
    return [member](const py::object& self) { return view(member(self.cast<const Map&>().map), self); };
  };
  using P = Parameterization;
  py::class_<Map>(module, "Map",
                  "A map of a surface onto its base complex, piecewise linear over the faces. Arrays are views of its\n"
                  "memory and cannot be written. Charts are equilateral triangles with corners 0, 1, exp(i pi/3).")
      .def_property_readonly("positions", part([](const P& m) -> auto& { return m.surface.positions; }),
                             "float64 (n, 3): the input's vertices in its order, then those that the map added")
      .def_property_readonly("faces", part([](const P& m) -> auto& { return m.surface.faces; }), "int32 (m, 3)")
      .def_property_readonly("base_vertices", part([](const P& m) -> auto& { return m.base.vertices; }),
                             "int32 (b,): the surface's vertex of each base vertex")
      .def_property_readonly("base_faces", part([](const P& m) -> auto& { return m.base.faces; }),
                             "int32 (p, 3): of base vertices")
      .def_property_readonly("creases", part([](const P& m) -> auto& { return m.base.creases; }),
                             "int32 (c, 2): base edges on feature curves, by their base vertices")
      .def_property_readonly("patch", part([](const P& m) -> auto& { return m.patch; }),
                             "int32 (n,): base face that holds the vertex; -1 for isolated vertices")
      .def_property_readonly("position", part([](const P& m) -> auto& { return m.position; }),
                             "complex128 (n,): place in the chart of `patch`")
      .def_property_readonly("face_chart", part([](const P& m) -> auto& { return m.face_chart; }),
                             "int32 (m,): base face in whose chart the corners are given")
      .def_property_readonly("face_corners", part([](const P& m) -> auto& { return m.face_corners; }),
                             "complex128 (m, 3): places of the three corners")
      .def_property_readonly(
          "provenance", [](const Map& m) { return m.map.provenance; }, "what made it, one 'key value' each")
      .def_property_readonly(
          "summary", [](const Map& m) { return m.summary; }, "counts of parameterize; empty for a map that was read")
      .def_property_readonly(
          "omega", [](const Map& m) { return m.omega; },
          "float64 (k, 5): remaining vertices, shape, dispersion, metric and their sum for each\n"
          "vertex removal (figure 5d); None for a map that was read")
      .def(
          "save", [](const Map& m, const std::string& path) { write_parameterization(path, m.map); }, py::arg("path"),
          py::call_guard<py::gil_scoped_release>(), "Writes *.param.ply, whole or not at all.");
}

void bind_check(py::module_& module) {
  py::class_<MapCheck>(module, "MapCheck", "What check found.")
      .def_readonly("flipped_faces", &MapCheck::flipped_faces)
      .def_readonly("first_flipped", &MapCheck::first_flipped, "a face; -1 where there is none")
      .def_readonly("area_error", &MapCheck::area_error)
      .def_readonly("wrong_angle_vertices", &MapCheck::wrong_angle_vertices)
      .def_readonly("misplaced_vertices", &MapCheck::misplaced_vertices)
      .def_readonly("mismatched_edges", &MapCheck::mismatched_edges)
      .def_readonly("torn_edges", &MapCheck::torn_edges)
      .def_property_readonly("valid", &MapCheck::valid);
  module.def(
      "check", [](const Map& m) { return check_map(m.map); }, py::arg("map"), py::call_guard<py::gil_scoped_release>(),
      "Checks a map face by face, without trust in how it was made.");
}

void bind_map_measures(py::module_& module) {
  py::class_<Statistics>(module, "Statistics", "Weighted by area on the surface.")
      .def_readonly("minimum", &Statistics::minimum)
      .def_readonly("mean", &Statistics::mean)
      .def_readonly("p05", &Statistics::p05)
      .def_readonly("median", &Statistics::median)
      .def_readonly("p95", &Statistics::p95)
      .def_readonly("p99", &Statistics::p99)
      .def_readonly("maximum", &Statistics::maximum);
  py::class_<Distortion>(module, "Distortion", "By the singular values s1 >= s2 of each face's map.")
      .def_readonly("anisotropy", &Distortion::anisotropy, "s1 / s2; neutral 1")
      .def_readonly("area", &Distortion::area, "s1 s2; neutral 1")
      .def_readonly("stretch_l2", &Distortion::stretch_l2, "sqrt((s1^2 + s2^2) / 2); neutral 1")
      .def_readonly("stretch_linf", &Distortion::stretch_linf, "s1; neutral 1")
      .def_readonly("sorkine", &Distortion::sorkine, "max(s1, 1 / s2); neutral 1")
      .def_readonly("conformal", &Distortion::conformal, "s1 / s2 + s2 / s1; neutral 2")
      .def_readonly("area_symmetric", &Distortion::area_symmetric, "s1 s2 + 1 / (s1 s2); neutral 2")
      .def_readonly("l2_stretch", &Distortion::l2_stretch, "of the whole map")
      .def_readonly("linf_stretch", &Distortion::linf_stretch, "of the whole map")
      .def_readonly("flipped_faces", &Distortion::flipped_faces)
      .def_readonly("degenerate_faces", &Distortion::degenerate_faces);
  py::class_<Smoothness>(module, "Smoothness", "Jumps of the first derivative across edges; 0 is smooth.")
      .def_readonly("inside", &Smoothness::inside)
      .def_readonly("across", &Smoothness::across)
      .def_readonly("at_corner", &Smoothness::at_corner)
      .def_readonly("all", &Smoothness::all)
      .def_readonly("across_over_inside", &Smoothness::across_over_inside,
                    "whether patch edges show: 1 where they do not; None where it has no value")
      .def_property_readonly(
          "faces", [](const Smoothness& s) { return take(s.faces); }, "float64 (m,): mean over a face's edges");
  module.def(
      "distortion", [](const Map& m) { return distortion(m.map); }, py::arg("map"),
      py::call_guard<py::gil_scoped_release>(), "The paper's and others' measures of a map, over area.");
  module.def(
      "face_distortion",
      [](const Map& m) {
        FaceDistortion values;
        {
          const py::gil_scoped_release unlocked;
          values = face_distortion(m.map);
        }
        py::dict columns;
        columns["anisotropy"] = take(std::move(values.anisotropy));
        columns["area"] = take(std::move(values.area));
        columns["stretch_l2"] = take(std::move(values.stretch_l2));
        columns["sorkine"] = take(std::move(values.sorkine));
        return columns;
      },
      py::arg("map"), "The same of each face: a dict of float64 (m,); 0 for faces without area.");
  module.def(
      "smoothness", [](const Map& m) { return smoothness(m.map); }, py::arg("map"),
      py::call_guard<py::gil_scoped_release>(), "How smooth a map is across the edges of its faces.");
}

}  // namespace

void bind_map(py::module_& module) {
  bind_map_class(module);
  bind_check(module);
  bind_map_measures(module);
  const std::string text =
      "parameterize(positions, faces, **options) -> Map\n\n"
      "A globally smooth parameterization of (n, 3) positions and (m, 3) faces. Options with their range and "
      "[default]:\n\n"
      "    preset: default, paper [default]; what the others are where they are not given\n" +
      options_text(option_names(StageKind::Parameterize), {}) +
      "    feature_edges: int (k, 2), edges that become creases instead of those found [None]\n"
      "    threads: at most so many; progress(stage, fraction) and on_note(sentence) are called [None]\n\n"
      "An exception of progress, Ctrl-C too, ends the call. The same bits for any number of threads. Raises gsp.Error\n"
      "with the vertex, edge or face at fault.";
  module.def("parameterize", &parameterize_arrays, py::arg("positions"), py::arg("faces"), text.c_str());
  module.def(
      "read_map",
      [](const std::string& path) {
        Map map;
        const py::gil_scoped_release unlocked;
        map.map = read_parameterization(path);
        return map;
      },
      py::arg("path"), "A map from *.param.ply.");
}

}  // namespace gsp::python

#include <pybind11/stl.h>

#include <limits>

#include "coder/codec.h"
#include "experiments/base/level_by_rate.h"
#include "experiments/curve/targets.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/call.h"
#include "remesh/recover_levels.h"
#include "remesh/remesh_options.h"
#include "remesh/semiregular_file.h"

namespace gsp::python {

namespace {

/// Samples and seed measure a remesh; they do not make one.
std::vector<std::string> remesh_names() {
  std::vector<std::string> names = option_names(StageKind::Remesh);
  std::erase_if(names, [](const std::string& name) { return name == "samples" || name == "seed"; });
  return names;
}

/// What the command takes by default.
CellOptions encode_defaults() {
  CellOptions cell;
  cell.encode.wavelet = Wavelet::ButterflyLifted;
  return cell;
}

Remesh remesh_map(const Map& map, const py::kwargs& keywords) {
  Call call("remesh", keywords);
  CellOptions cell;
  call.take_options(remesh_names(), cell);
  const auto max_error = call.take<double>("max_error");
  Remesh result;
  call.run([&](Progress& progress) {
    result.mesh = max_error ? remesh_to_error(map.map, *max_error, cell.remesh, progress)
                            : remesh_by_rate(map.map, cell.remesh, progress);
  });
  result.provenance = provenance_of(cell.remesh);
  return result;
}

py::bytes encode_mesh(const Remesh& remesh, const py::kwargs& keywords) {
  Call call("encode", keywords);
  CellOptions cell = encode_defaults();
  call.take_options(option_names(StageKind::Encode), cell);
  const StreamMode mode = stream_mode_of(call.take<std::string>("mode").value_or("embedded"));
  const auto size = call.take<std::size_t>("bytes");
  if (mode == StreamMode::Fixed && !size) throw Error(Cause::BadOption, "mode fixed needs bytes");
  Bytes stream;
  call.run([&](Progress& progress) {
    if (mode == StreamMode::Fixed) {
      stream = encode_fixed(remesh.mesh, cell.encode, *size, progress);
      return;
    }
    stream = encode(remesh.mesh, cell.encode, progress);
    if (size && *size < header_bytes(stream))
      throw Error(Cause::BadOption, "the header alone takes " + std::to_string(header_bytes(stream)) + " bytes");
    if (size && *size < stream.size()) stream.resize(*size);
  });
  return to_bytes(stream);
}

Remesh decode_stream(const py::object& stream, const std::optional<std::size_t>& size) {
  const Bytes bytes = bytes_of(stream, size.value_or(std::numeric_limits<std::size_t>::max()));
  const py::gil_scoped_release unlocked;
  return {decode(bytes, bytes.size()), {}};
}

Remesh remesh_of(const py::object& positions, const py::object& base_faces, int level) {
  SemiregularMesh mesh;
  mesh.level = level;
  mesh.positions = positions_of(positions);
  mesh.base_faces = triangles_of(base_faces, "base_faces");
  for (const Triangle& t : mesh.base_faces)
    for (int v : t) mesh.base_vertices = std::max(mesh.base_vertices, v < std::numeric_limits<int>::max() ? v + 1 : v);
  require_well_formed(mesh);
  return {std::move(mesh), {}};
}

py::array faces_of(const py::object& self) {
  Remesh& remesh = self.cast<Remesh&>();
  if (remesh.faces.empty()) remesh.faces = remesh.mesh.mesh().faces;
  return view(remesh.faces, self);
}

void bind_remesh_class(py::module_& module) {
  using Remesh = python::Remesh;
  py::class_<Remesh>(module, "Remesh",
                     "A semi-regular mesh: base faces quadrisected `level` times. Arrays are views of its memory and\n"
                     "cannot be written. Remesh(positions, base_faces, level) takes positions (n, 3), level by level.")
      .def(py::init(&remesh_of), py::arg("positions"), py::arg("base_faces"), py::arg("level"))
      .def_property_readonly(
          "positions", [](const py::object& self) { return view(self.cast<const Remesh&>().mesh.positions, self); },
          "float64 (n, 3): base vertices, then for each level the vertices of its edges")
      .def_property_readonly("faces", &faces_of, "int32 (m, 3) of the finest level")
      .def_property_readonly("level", [](const Remesh& r) { return r.mesh.level; })
      .def_property_readonly("base_vertices", [](const Remesh& r) { return r.mesh.base_vertices; })
      .def_property_readonly(
          "base_faces", [](const py::object& self) { return view(self.cast<const Remesh&>().mesh.base_faces, self); },
          "int32 (p, 3)")
      .def_property_readonly(
          "creases", [](const py::object& self) { return view(self.cast<const Remesh&>().mesh.creases, self); },
          "int32 (c, 2): base edges across which the surface is not smooth")
      .def(
          "save", [](const Remesh& r, const std::string& path) { write_semiregular(path, r.mesh, r.provenance); },
          py::arg("path"), py::call_guard<py::gil_scoped_release>(), "Writes *.sr.ply, whole or not at all.");
  module.def(
      "read_remesh",
      [](const std::string& path) {
        const py::gil_scoped_release unlocked;
        return Remesh{read_or_recover(path), {}};
      },
      py::arg("path"), "A remesh from *.sr.ply, or from any mesh with subdivision connectivity.");
  module.def(
      "recover_levels",
      [](const py::object& positions, const py::object& faces) {
        const Mesh mesh = mesh_of(positions, faces);
        const py::gil_scoped_release unlocked;
        return Remesh{recover_levels(mesh), {}};
      },
      py::arg("positions"), py::arg("faces"), "The base and levels of a mesh with subdivision connectivity.");
}

}  // namespace

void bind_code(py::module_& module) {
  bind_remesh_class(module);
  const std::string remesh_text =
      "remesh(map, **options) -> Remesh\n\nQuadrisects the base through the map. Options with their range and "
      "[default]:\n\n" +
      options_text(remesh_names(), {}) +
      "    max_error: instead of a level, the first whose RMS distance over the diagonal is at most that [None]\n"
      "    threads, progress, on_note: as in parameterize [None]\n";
  module.def("remesh", &remesh_map, py::arg("map"), remesh_text.c_str());
  const std::string encode_text =
      "encode(remesh, **options) -> bytes\n\nAn embedded stream: any prefix that holds the header decodes. Options "
      "with "
      "their range and [default]:\n\n" +
      options_text(option_names(StageKind::Encode), encode_defaults()) +
      "    bytes: cut the stream after so many; needed for mode fixed [None]\n"
      "    mode: embedded, fixed: coded for that size alone, ten times as long [embedded]\n"
      "    threads, progress, on_note: as in parameterize [None]\n";
  module.def("encode", &encode_mesh, py::arg("remesh"), encode_text.c_str());
  module.def(
      "decode", &decode_stream, py::arg("stream"), py::arg("bytes") = py::none(),
      "The remesh of a stream (bytes or what has their buffer), or of its first `bytes` bytes. Base vertices and\n"
      "faces come in the order in which they were coded. Any bytes are safe; raises gsp.Error.");
  module.def(
      "header_bytes",
      [](const py::object& stream) { return header_bytes(bytes_of(stream, std::numeric_limits<std::size_t>::max())); },
      py::arg("stream"), "How many bytes a prefix needs at least.");
}

}  // namespace gsp::python

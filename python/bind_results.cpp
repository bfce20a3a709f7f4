#include <pybind11/stl.h>

#include <limits>
#include <set>

#include "experiments/curve/curve.h"
#include "experiments/curve/curve_csv.h"
#include "experiments/curve/point_fields.h"
#include "experiments/store/store.h"
#include "mesh/topology.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/call.h"

namespace gsp::python {

namespace {

/// A list of words, or an array of numbers, of one value for each row.
template <class Row, class Value>
py::object column(const std::vector<Row>& rows, Value value) {
  using T = std::decay_t<decltype(value(rows.front()))>;
  if constexpr (std::is_same_v<T, std::string>) {
    py::list words;
    for (const Row& row : rows) words.append(value(row));
    return words;
  } else {
    py::array_t<T> numbers(static_cast<py::ssize_t>(rows.size()));
    T* next = numbers.mutable_data();
    for (const Row& row : rows) *next++ = value(row);
    return numbers;
  }
}

/// The columns of curve.csv.
py::dict columns_of(const std::vector<CurvePoint>& points) {
  py::dict columns;
  for (const PointField& field : point_fields())
    columns[field.name] = std::visit(
        [&](auto member) { return column(points, [member](const CurvePoint& point) { return point.*member; }); },
        field.member);
  return columns;
}

template <class Value>
std::vector<Value> values_of(const std::vector<std::string>& words, Value (*inverse)(const std::string&)) {
  std::vector<Value> values;
  for (const std::string& word : words) values.push_back(inverse(word));
  return values;
}

/// Options of the stages that `curve` takes, beside lists in place of method, kind and mode.
std::vector<std::string> curve_names() {
  const std::set<std::string> lists = {"method", "kind", "mode", "replicate"};
  std::vector<std::string> names;
  for (const StageKind stage : kStageKinds)
    for (const std::string& name : option_names(stage))
      if (!lists.contains(name)) names.push_back(name);
  return names;
}

py::dict curve(const py::object& vertices, const py::object& faces, const py::kwargs& keywords) {
  using Words = std::vector<std::string>;
  Call call("curve", keywords);
  CellOptions cell;
  cell.parameterize = preset_options(call.take<std::string>("preset").value_or(preset_words().front()));
  call.take_options(curve_names(), cell);
  CurveOptions options;
  options.parameterize = cell.parameterize;
  options.remesh = cell.remesh;
  options.encode = cell.encode;
  options.samples = cell.samples;
  options.seed = cell.seed;
  if (const auto words = call.take<Words>("methods")) options.methods = values_of(*words, method_of);
  if (const auto words = call.take<Words>("kinds")) options.kinds = values_of(*words, remesh_kind_of);
  if (const auto words = call.take<Words>("modes")) options.modes = values_of(*words, stream_mode_of);
  options.budgets = call.take<std::vector<std::size_t>>("budgets").value_or(options.budgets);
  options.anchors = call.take<bool>("anchors").value_or(options.anchors);
  options.replicates = call.take<int>("replicates").value_or(options.replicates);
  if (options.replicates < 1 || options.replicates > kMostReplicates)
    throw Error(Cause::BadOption, "replicates: not 1 to " + std::to_string(kMostReplicates));
  const std::string model = call.take<std::string>("model").value_or("surface");
  const Mesh mesh = mesh_of(vertices, faces);
  CurveRun result;
  call.run([&](Progress& progress) {
    require_parameterizable(mesh);
    result = rate_distortion_curve(mesh, model, options, progress);
  });
  return columns_of(result.points);
}

/// One row for each cell: what it is, how it ended, and every number that a stage of it measured (NaN where none did).
py::dict cell_columns(const std::vector<StoredCell>& cells) {
  py::dict columns;
  columns["position"] = column(cells, [](const StoredCell& c) { return c.position; });
  columns["model"] = column(cells, [](const StoredCell& c) { return c.model; });
  columns["label"] = column(cells, [](const StoredCell& c) { return c.label; });
  columns["status"] = column(cells, [](const StoredCell& c) { return std::string(status_name(c.status)); });
  columns["cause"] = column(cells, [](const StoredCell& c) { return c.cause; });
  columns["failure"] = column(cells, [](const StoredCell& c) { return c.failure; });
  for (const Axis& axis : axes())
    columns[axis.name] = column(cells, [&](const StoredCell& c) { return to_string(axis.get(c.options)); });
  std::set<std::string> names;
  for (const StoredCell& cell : cells)
    for (const StageResult& stage : cell.stages)
      for (const auto& [name, value] : stage.numbers) names.insert(name);
  for (const std::string& name : names)
    // A base that was asked for and the one that came out have the same name.
    columns[py::str(columns.contains(name) ? "measured_" + name : name)] = column(
        cells, [&](const StoredCell& c) { return c.number(name).value_or(std::numeric_limits<double>::quiet_NaN()); });
  return columns;
}

py::dict read_store(const std::string& folder, const std::string& recipe, const std::string& what) {
  if (what != "points" && what != "cells") throw Error(Cause::BadOption, "what: " + what + " is not points or cells");
  std::vector<StoredCell> cells;
  std::vector<CurvePoint> points;
  std::vector<std::string> labels;
  {
    const py::gil_scoped_release unlocked;
    cells = Store::open(folder).cells(recipe);
    for (const StoredCell& cell : cells)
      for (CurvePoint& point : cell.points()) {
        points.push_back(std::move(point));
        labels.push_back(cell.label);
      }
  }
  if (what == "cells") return cell_columns(cells);
  py::dict columns = columns_of(points);
  columns["label"] = column(labels, [](const std::string& label) { return label; });
  return columns;
}

}  // namespace

void bind_results(py::module_& module) {
  const std::string text =
      "curve(vertices, faces, **options) -> dict of columns\n\n"
      "The rate-distortion curves of a surface, (n, 3) and (m, 3), by every method: rows of curve.csv (README), "
      "numbers as arrays, words "
      "as\n"
      "lists. Options with their range and [default]:\n\n"
      "    methods: any of gsp, maps, maps-smoothed, hybrid [gsp, maps-smoothed]\n"
      "    anchors: also decimation and Draco, and Draco [True]\n"
      "    kinds, modes: lists of the words of remesh and encode [parametric; embedded]\n"
      "    budgets: sizes in bytes [256, 512, 1024, ... and the whole stream]\n"
      "    replicates: how often the maps are made [1]\n"
      "    model: what the column `model` says [surface]\n"
      "    preset: default, paper [default]\n" +
      options_text(curve_names(), {}) + "    threads, progress, on_note: as in parameterize [None]\n";
  module.def("curve", &curve, py::arg("vertices"), py::arg("faces"), text.c_str());
  module.def(
      "read_curve",
      [](const std::string& path) {
        std::vector<CurvePoint> points;
        {
          const py::gil_scoped_release unlocked;
          points = read_curve_csv(path);
        }
        return columns_of(points);
      },
      py::arg("path"), "A curve.csv as a dict of columns.");
  module.def("read_store", &read_store, py::arg("folder"), py::arg("recipe") = "", py::arg("what") = "points",
             "What a sweep of a recipe (the latest, if empty) measured, as a dict of columns: its points (rows of\n"
             "curve.csv, with the cell's label), or its cells with their status and the numbers of all stages.");
}

}  // namespace gsp::python

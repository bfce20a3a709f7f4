#include <pybind11/stl.h>

#include "metrics/bd_rate.h"
#include "metrics/hausdorff.h"
#include "metrics/surface_distance.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/call.h"

namespace gsp::python {

namespace {

SurfaceDistance distance(const py::object& positions_a, const py::object& faces_a, const py::object& positions_b,
                         const py::object& faces_b, const py::kwargs& keywords) {
  Call call("surface_distance", keywords);
  DistanceOptions options;
  options.samples = call.take<std::size_t>("samples").value_or(options.samples);
  options.seed = call.take<std::uint64_t>("seed").value_or(options.seed);
  options.tolerance_db = call.take<double>("tolerance_db").value_or(options.tolerance_db);
  const Mesh a = mesh_of(positions_a, faces_a), b = mesh_of(positions_b, faces_b);
  SurfaceDistance result;
  call.run([&](Progress& progress) { result = surface_distance(a, b, options, progress); });
  return result;
}

HausdorffBounds hausdorff(const py::object& positions_a, const py::object& faces_a, const py::object& positions_b,
                          const py::object& faces_b, const py::kwargs& keywords) {
  Call call("hausdorff_bounds", keywords);
  HausdorffOptions options;
  options.tolerance = call.take<double>("tolerance").value_or(options.tolerance);
  const Mesh a = mesh_of(positions_a, faces_a), b = mesh_of(positions_b, faces_b);
  HausdorffBounds result;
  call.run([&](Progress& progress) { result = hausdorff_bounds(a, b, options, progress); });
  return result;
}

BdCurve curve_of(const py::object& rates, const py::object& psnr_db, const std::optional<double>& ceiling_db) {
  const std::vector<double> rate = numbers_of(rates, "rate"), psnr = numbers_of(psnr_db, "psnr_db");
  if (rate.size() != psnr.size()) throw py::value_error("rate and psnr_db differ in length");
  BdCurve curve;
  for (std::size_t i = 0; i < rate.size(); ++i) curve.points.push_back({rate[i], psnr[i]});
  if (ceiling_db) curve.ceiling_db = *ceiling_db;
  return curve;
}

BdInterpolation interpolation_of(const std::string& word) {
  for (BdInterpolation known : {BdInterpolation::Pchip, BdInterpolation::Akima, BdInterpolation::Cubic})
    if (word == interpolation_name(known)) return known;
  throw Error(Cause::BadOption, "interpolation: " + word + " is not pchip, akima or cubic");
}

BdResult bd_rate(const py::object& anchor_rate, const py::object& anchor_psnr, const py::object& test_rate,
                 const py::object& test_psnr, const py::kwargs& keywords) {
  Call call("bd_rate", keywords);
  BdOptions options;
  if (const auto word = call.take<std::string>("interpolation")) options.interpolation = interpolation_of(*word);
  options.ceiling_margin_db = call.take<double>("ceiling_margin_db").value_or(options.ceiling_margin_db);
  const BdCurve anchor = curve_of(anchor_rate, anchor_psnr, call.take<double>("anchor_ceiling_db"));
  const BdCurve test = curve_of(test_rate, test_psnr, call.take<double>("test_ceiling_db"));
  BdResult result;
  call.run([&](Progress&) { result = bd_compare(anchor, test, options); });
  return result;
}

void bind_distance_classes(py::module_& module) {
  py::class_<OneWayDistance>(module, "OneWayDistance", "From samples on one surface to the nearest point of the other.")
      .def_readonly("mean", &OneWayDistance::mean)
      .def_readonly("rms", &OneWayDistance::rms)
      .def_readonly("quantile95", &OneWayDistance::quantile95)
      .def_readonly("hausdorff", &OneWayDistance::hausdorff, "largest over the samples: a lower bound")
      .def_readonly("rms_standard_error", &OneWayDistance::rms_standard_error)
      .def_readonly("samples", &OneWayDistance::samples);
  py::class_<SurfaceDistance>(module, "SurfaceDistance", "Both ways, in the coordinates' unit.")
      .def_readonly("forward", &SurfaceDistance::forward, "from a to b")
      .def_readonly("backward", &SurfaceDistance::backward, "from b to a")
      .def_readonly("diagonal", &SurfaceDistance::diagonal, "of a's bounding box: the peak of PSNR")
      .def_property_readonly("rms", &SurfaceDistance::rms, "the larger of the two directions")
      .def_property_readonly("mean", &SurfaceDistance::mean)
      .def_property_readonly("quantile95", &SurfaceDistance::quantile95)
      .def_property_readonly("hausdorff", &SurfaceDistance::hausdorff)
      .def_property_readonly("exact", &SurfaceDistance::exact, "the surfaces are the same, up to rounding")
      .def_property_readonly("psnr_db", &SurfaceDistance::psnr_db, "20 log10(diagonal / rms); inf where it is exact")
      .def_property_readonly("standard_error_db", &SurfaceDistance::standard_error_db);
  py::class_<DistanceBounds>(module, "DistanceBounds", "A distance that is certainly in [lower, upper].")
      .def_readonly("lower", &DistanceBounds::lower)
      .def_readonly("upper", &DistanceBounds::upper);
  py::class_<HausdorffBounds>(module, "HausdorffBounds", "In the coordinates' unit.")
      .def_readonly("forward", &HausdorffBounds::forward, "largest distance of a point of a from b")
      .def_readonly("backward", &HausdorffBounds::backward, "largest distance of a point of b from a")
      .def_property_readonly("both", &HausdorffBounds::both);
}

void bind_bd_classes(py::module_& module) {
  py::class_<BdAverage>(module, "BdAverage", "One average over the range where both curves are known.")
      .def_readonly("value", &BdAverage::value)
      .def_property_readonly("range", [](const BdAverage& a) { return py::make_tuple(a.from, a.to); })
      .def_readonly("overlap_share", &BdAverage::overlap_share)
      .def_readonly("small_overlap", &BdAverage::small_overlap)
      .def_readonly("warning", &BdAverage::warning, "a sentence where the overlap is small, else empty");
  py::class_<BdResult>(module, "BdResult", "Bjontegaard deltas of test against anchor.")
      .def_readonly("rate", &BdResult::rate, "per cent of bytes at equal PSNR; negative is better")
      .def_readonly("psnr", &BdResult::psnr, "dB at equal bytes; positive is better")
      .def_readonly("dropped_points", &BdResult::dropped_points);
}

}  // namespace

void bind_measures(py::module_& module) {
  bind_distance_classes(module);
  bind_bd_classes(module);
  module.def(
      "surface_distance", &distance, py::arg("positions_a"), py::arg("faces_a"), py::arg("positions_b"),
      py::arg("faces_b"),
      "surface_distance(Va, Fa, Vb, Fb, *, samples=1000000, seed=1, tolerance_db=0) -> SurfaceDistance\n\n"
      "Distance between surfaces of (n, 3) positions and (m, 3) faces from samples over area, both ways; a is the\n"
      "reference. samples: per direction. tolerance_db: samples are added until the standard error is that\n"
      "small. Also threads, progress, on_note, as in parameterize.");
  module.def("hausdorff_bounds", &hausdorff, py::arg("positions_a"), py::arg("faces_a"), py::arg("positions_b"),
             py::arg("faces_b"),
             "hausdorff_bounds(Va, Fa, Vb, Fb, *, tolerance=0.01) -> HausdorffBounds\n\n"
             "Encloses the Hausdorff distance: upper is at most (1 + tolerance) times lower, 1e-6 to 1, unless memory\n"
             "runs out. Also threads, progress, on_note, as in parameterize.");
  module.def("bd_rate", &bd_rate, py::arg("anchor_rate"), py::arg("anchor_psnr_db"), py::arg("test_rate"),
             py::arg("test_psnr_db"),
             "bd_rate(anchor_rate, anchor_psnr_db, test_rate, test_psnr_db, *, interpolation='pchip',\n"
             "        ceiling_margin_db=10, anchor_ceiling_db=None, test_ceiling_db=None) -> BdResult\n\n"
             "Bjontegaard deltas of curves given by (n,) rates and PSNR. interpolation: pchip, akima, cubic. Curves\n"
             "count up to their ceiling less the margin. Raises gsp.Error where they do not overlap.");
}

}  // namespace gsp::python

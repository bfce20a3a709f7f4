#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/input.h"
#include "cli/options.h"
#include "cli/print.h"
#include "experiments/output/decibels.h"
#include "mesh/error.h"
#include "metrics/hausdorff.h"
#include "metrics/metro.h"
#include "metrics/picture.h"
#include "metrics/psnr.h"
#include "metrics/surface_distance.h"

namespace gsp::cli {

namespace {

struct DistanceArguments {
  std::string a, b, per_vertex;
  ReadOptions read;
  DistanceOptions distance;
  double hausdorff_tolerance = 0.0;
  bool metro = false, mpeg = false;
};

SurfaceTree tree_of(const SurfaceFile& file, const std::string& path) {
  try {
    return in_places_of(file, [&] { return SurfaceTree(file.mesh); });
  } catch (const Error& error) {
    throw error.within(path);
  }
}

/// Both surfaces and their trees, each built once for all that is measured.
struct Pair {
  Pair(const Pair&) = delete;
  Pair(const DistanceArguments& options, Context& context)
      : file_a(read_input(options.a, options.read, context)),
        file_b(read_input(options.b, options.read, context)),
        a(file_a.mesh),
        b(file_b.mesh),
        tree_a(tree_of(file_a, options.a)),
        tree_b(tree_of(file_b, options.b)) {}
  SurfaceFile file_a, file_b;
  const Mesh &a, &b;
  SurfaceTree tree_a, tree_b;
};

Json direction(const OneWayDistance& d) {
  return {{"mean", d.mean},
          {"rms", d.rms},
          {"rms_standard_error", d.rms_standard_error},
          {"standard_error_db", d.standard_error_db()},
          {"quantile95", d.quantile95},
          {"hausdorff", d.hausdorff},
          {"samples", d.samples}};
}

Json direction(const MetroDistance& d) {
  return {{"mean", d.mean},
          {"rms", d.rms},
          {"maximum", d.maximum},
          {"vertex_samples", d.vertex_samples},
          {"edge_samples", d.edge_samples},
          {"face_samples", d.face_samples}};
}

Json report_of(const DistanceBounds& bounds) {
  return {{"lower", bounds.lower}, {"upper", bounds.upper}, {"relative_width", bounds.relative_width()}};
}

Json report_of(const Psnr& psnr) {
  Json report = {{"name", psnr.name}};
  put_db(report, "db", psnr.db);
  report.update({{"peak", psnr.peak}, {"formula", psnr.formula}});
  return report;
}

Json metro_report(const Pair& pair, Progress& progress) {
  constexpr std::size_t kAsMetro = 0;
  const MetroDistances d = metro_distances(pair.a, pair.tree_a, pair.b, pair.tree_b, kAsMetro, progress);
  return {
      {"forward", direction(d.forward)},
      {"backward", direction(d.backward)},
      {"inflated_diagonal", d.diagonal},
      {"rule", "as Metro 4.07: vertex, edge and face samples weigh the same; diagonal of the joint box widened by 2%"}};
}

void write_per_vertex(const std::string& path, const Pair& pair, const SurfaceDistance& distance) {
  write_vertex_picture(path, pair.a, {{"distance", vertex_distances(pair.a, pair.tree_b)}},
                       {0.0, distance.forward.quantile95});
}

int run_distance(const DistanceArguments& options, Context& context) {
  Progress progress = context.console.progress();
  const Pair pair(options, context);
  const SurfaceDistance d = surface_distance(pair.a, pair.tree_a, pair.b, pair.tree_b, options.distance, progress);
  Json report = {
      {"forward", direction(d.forward)}, {"backward", direction(d.backward)}, {"mean", d.mean()},      {"rms", d.rms()},
      {"quantile95", d.quantile95()},    {"hausdorff", d.hausdorff()},        {"diagonal", d.diagonal}};
  put_db(report, "psnr_db", d.psnr_db());
  report.update({{"psnr_formula", diagonal_psnr(d).formula}, {"standard_error_db", d.standard_error_db()}});
  report["mpeg_d1"] = report_of(mpeg_d1_psnr(pair.a, d));
  if (options.mpeg)
    report["mpeg_d2"] = report_of(mpeg_d2_psnr(pair.a, pair.tree_a, pair.b, pair.tree_b, options.distance, progress));
  if (options.hausdorff_tolerance > 0.0) {
    HausdorffOptions bounds;
    bounds.tolerance = options.hausdorff_tolerance;
    const HausdorffBounds h = hausdorff_bounds(pair.a, pair.tree_a, pair.b, pair.tree_b, bounds, progress);
    report["hausdorff_bounds"] = {
        {"forward", report_of(h.forward)}, {"backward", report_of(h.backward)}, {"both", report_of(h.both())}};
  }
  if (options.metro) report["metro"] = metro_report(pair, progress);
  if (!options.per_vertex.empty()) write_per_vertex(options.per_vertex, pair, d);
  report["samples"] = std::max(d.forward.samples, d.backward.samples);
  report["seed"] = options.distance.seed;
  const double tolerance = options.distance.tolerance_db;
  if (tolerance > 0.0 && std::max(d.forward.standard_error_db(), d.backward.standard_error_db()) > tolerance)
    context.console.say("the standard error is over the tolerance: the most samples that are taken are not enough");
  print_report(context, report);
  return 0;
}

}  // namespace

void add_distance(CLI::App& app, Context& context) {
  Command command(app, context, "distance", "how far two surfaces are apart, both ways");
  auto options = std::make_shared<DistanceArguments>();
  command.argument("A", options->a, "reference surface; distances are in its units");
  command.argument("B", options->b, "the other surface");
  command.read_options(options->read);
  command.sampling_options(options->distance.samples, options->distance.seed);
  command.number("--tolerance-db", options->distance.tolerance_db, 0.0, 10.0,
                 "add samples until the RMS's standard error is at most this, 0 for no more than --samples");
  command.number_or_none("--hausdorff-tolerance", options->hausdorff_tolerance, HausdorffOptions::kLeastTolerance, 1.0,
                         "also enclose the Hausdorff distance in certain bounds, this much apart; 0 for samples alone");
  command.flag("--metro", options->metro, "also what Metro 4.07 computes, with its samples and averages");
  command.flag("--mpeg", options->mpeg, "also MPEG's D2 PSNR (point to plane)");
  command.optional_output("--per-vertex", options->per_vertex, Content::Ply,
                          "also write A as PLY with each vertex's distance and a colour");
  command.footer(
      "Forward is from A to B, and beneath both directions stands the larger number of the two. Mean, RMS and the 95%\n"
      "quantile are over area; Hausdorff is the largest over the samples, which --hausdorff-tolerance encloses from "
      "both\n"
      "sides. The standard error is that of the RMS. PSNR is 20 log10(diagonal of A's bounding box / larger RMS); "
      "MPEG's D1\n"
      "and D2 use another peak and formula and are other numbers. Metro's averages mix vertex, edge and face samples "
      "without\n"
      "weights: only for comparison with papers.");
  command.on_run([options, &context] { return run_distance(*options, context); });
}

}  // namespace gsp::cli

#include "metrics/distortion.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/check_report.h"
#include "cli/options.h"
#include "cli/report.h"
#include "mesh/atomic_file.h"
#include "param/param_file.h"

namespace gsp::cli {

namespace {

struct Options {
  std::string map, per_face;
};

Json statistics(const Statistics& s) {
  return {{"mean", s.mean}, {"median", s.median}, {"p95", s.p95}, {"maximum", s.maximum}};
}

void write_per_face(const std::string& path, const FaceDistortion& faces) {
  AtomicFile file(path);
  file.stream() << "face,anisotropy,area\n";
  for (std::size_t f = 0; f < faces.anisotropy.size(); ++f)
    file.stream() << fmt::format("{},{:.9g},{:.9g}\n", f, faces.anisotropy[f], faces.area[f]);
  file.commit();
}

int run_distortion(const Options& options, Context& context) {
  const Parameterization map = read_parameterization(options.map);
  const Distortion d = distortion(map);
  if (!options.per_face.empty()) write_per_face(options.per_face, face_distortion(map));
  const MapCheck check = check_map(map);
  print_report(context, {{"anisotropy", statistics(d.anisotropy)},
                         {"anisotropy_eigenvalues", statistics(d.anisotropy_eigenvalues)},
                         {"area", statistics(d.area)},
                         {"area_eigenvalues", statistics(d.area_eigenvalues)},
                         {"degenerate_faces", d.degenerate_faces},
                         {"check", check_report(check)}});
  return 0;
}

}  // namespace

void add_distortion(CLI::App& app, Context& context) {
  Command command(app, context, "distortion", "how much a map stretches, and whether it folds");
  auto options = std::make_shared<Options>();
  command.argument("MAP", options->map, "map: *.param.ply");
  command.optional_file("--per-face", options->per_face, "also write both measures for every face as CSV");
  command.footer(
      "anisotropy is the paper's Gamma_a, the larger over the smaller singular value of the map from chart to surface\n"
      "(1 is isotropic); area is Gamma_d, their product over its mean (1 is neutral). The lines with eigenvalues give "
      "the\n"
      "same from the metric tensor's eigenvalues, which are the squares. Weights are areas on the surface.");
  command.on_run([options, &context] { return run_distortion(*options, context); });
}

}  // namespace gsp::cli

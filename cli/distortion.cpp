#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/check_report.h"
#include "cli/options.h"
#include "cli/print.h"
#include "experiments/figures/map_measures.h"
#include "mesh/atomic_file.h"
#include "param/map/param_file.h"

namespace gsp::cli {

namespace {

struct DistortionArguments {
  std::string map, per_face, picture;
  std::string colour = "anisotropy";
};

Json statistics(const Statistics& s) {
  return {{"minimum", s.minimum}, {"mean", s.mean}, {"p05", s.p05},        {"median", s.median},
          {"p95", s.p95},         {"p99", s.p99},   {"maximum", s.maximum}};
}

Json measure(const Statistics& s, double neutral) {
  Json report = {{"neutral", neutral}};
  report.update(statistics(s));
  return report;
}

Json edges(const Statistics& s, int count) {
  Json report = {{"edges", count}};
  report.update(measure(s, 0.0));
  return report;
}

void write_csv(const std::string& path, const std::vector<MapMeasure>& measures) {
  AtomicFile file(path);
  file.stream() << "face";
  for (const MapMeasure& measure : measures) file.stream() << ',' << measure.column.name;
  file.stream() << '\n';
  for (std::size_t f = 0; f < measures.front().column.values.size(); ++f) {
    file.stream() << f;
    for (const MapMeasure& measure : measures) file.stream() << fmt::format(",{:.9g}", measure.column.values[f]);
    file.stream() << '\n';
  }
  file.commit();
}

/// The chosen measure first, since that is the one that colours.
void write_picture(const DistortionArguments& options, const Mesh& surface, std::vector<MapMeasure> measures) {
  const auto chosen =
      std::find_if(measures.begin(), measures.end(), [&](const auto& m) { return m.column.name == options.colour; });
  std::rotate(measures.begin(), chosen, chosen + 1);
  std::vector<PictureColumn> columns;
  for (MapMeasure& measure : measures) columns.push_back(std::move(measure.column));
  write_face_picture(options.picture, surface, columns, measures.front().scale);
}

int run_distortion(const DistortionArguments& options, Context& context) {
  const Parameterization map = read_parameterization(options.map);
  const Distortion d = distortion(map);
  const Smoothness s = smoothness(map);
  const std::vector<MapMeasure> measures = map_measures(map, d, s);
  if (!options.per_face.empty()) write_csv(options.per_face, measures);
  if (!options.picture.empty()) write_picture(options, map.surface, measures);
  print_report(context, {{"anisotropy", measure(d.anisotropy, 1.0)},
                         {"anisotropy_eigenvalues", measure(d.anisotropy_eigenvalues, 1.0)},
                         {"area", measure(d.area, 1.0)},
                         {"area_eigenvalues", measure(d.area_eigenvalues, 1.0)},
                         {"stretch_l2", measure(d.stretch_l2, 1.0)},
                         {"stretch_linf", measure(d.stretch_linf, 1.0)},
                         {"sorkine", measure(d.sorkine, 1.0)},
                         {"conformal", measure(d.conformal, 2.0)},
                         {"area_symmetric", measure(d.area_symmetric, 2.0)},
                         {"l2_stretch_of_map", d.l2_stretch},
                         {"linf_stretch_of_map", d.linf_stretch},
                         {"smoothness",
                          {{"inside_patches", edges(s.inside, s.inside_edges)},
                           {"across_patch_edges", edges(s.across, s.across_edges)},
                           {"at_corners", edges(s.at_corner, s.corner_edges)},
                           {"across_over_inside", s.across_over_inside ? Json(*s.across_over_inside) : Json()}}},
                         {"degenerate_faces", d.degenerate_faces},
                         {"check", check_report(check_map(map))}});
  return 0;
}

}  // namespace

void add_distortion(CLI::App& app, Context& context) {
  Command command(app, context, "distortion", "how much a map stretches, how smooth it is, and whether it folds");
  auto options = std::make_shared<DistortionArguments>();
  command.argument("MAP", options->map, "map: *.param.ply");
  command.optional_output("--per-face", options->per_face, Content::Csv, "also write every face's measures as CSV");
  command.optional_output("--picture", options->picture, Content::Ply,
                          "also write the surface as PLY with every face's measures and a colour");
  command.choice("--colour", options->colour, map_measure_names(),
                 "what colours the picture: gray is neutral, red the worst 5% of the area");
  command.footer(
      "With singular values s1 >= s2 of the map from chart to surface, in units in which both have the same area:\n"
      "anisotropy is the paper's Gamma_a = s1/s2, area its Gamma_d = s1*s2; the lines with eigenvalues give the same "
      "from\n"
      "the metric tensor's eigenvalues, which are the squares. stretch l2 is sqrt((s1^2 + s2^2)/2) and stretch linf "
      "s1\n"
      "(Sander 2001; of the map: RMS and maximum), sorkine max(s1, 1/s2), conformal s1/s2 + s2/s1, area symmetric\n"
      "s1*s2 + 1/(s1*s2). Each is printed with the value it has without distortion. Weights are areas on the surface.\n"
      "smoothness is the difference of the first derivatives of neighbouring faces, unfolded into one plane (figure "
      "1).\n"
      "across over inside is 1 where patch edges do not show: second derivatives across them over those inside patches "
      "at\n"
      "the same distance from a corner.");
  command.on_run([options, &context] { return run_distortion(*options, context); });
}

}  // namespace gsp::cli

#include "experiments/report/run_pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/figures/map_measures.h"
#include "experiments/figures/paint.h"
#include "experiments/figures/picture.h"
#include "experiments/figures/remesh_map.h"
#include "experiments/figures/sector_disc.h"
#include "experiments/output/quoting.h"
#include "param/map/param_file.h"
#include "remesh/semiregular_file.h"

namespace gsp {

namespace {

constexpr int kPanelSize = 640;

void add_picture(std::vector<RunFigure>& figures, const std::string& folder, const std::string& name,
                 const std::vector<Image>& panels, const std::string& caption) {
  write_png(folder + "/figures/" + name + ".png", side_by_side(panels));
  figures.push_back({"figures/" + name + ".png", "", caption});
}

Image measure_image(const Parameterization& map, const Camera& camera, const std::vector<double>& values,
                    const ColourScale& scale) {
  return render(map.surface, camera, with_patch_edges(face_value_paint(values, scale), map), {.size = kPanelSize});
}

const MapMeasure& named(const std::vector<MapMeasure>& measures, const std::string& name) {
  return *std::find_if(measures.begin(), measures.end(), [&](const MapMeasure& m) { return m.column.name == name; });
}

/// A coarse remesh shows its structure; the finest would be gray.
Image remesh_image(const SemiregularMesh& mesh, const Camera& camera) {
  constexpr int kMostFaces = 12'000;
  const int level = last_level_with(static_cast<std::int64_t>(mesh.base_faces.size()), kMostFaces, mesh.level);
  const Parameterization map = remesh_as_map(at_level(mesh, level));
  return render(map.surface, camera, with_patch_edges(with_wireframe(plain_paint()), map),
                {.size = kPanelSize, .smooth = false});
}

void reference_figures(const StoredCell& cell, const std::string& folder, std::vector<RunFigure>& figures) {
  const Parameterization map = read_parameterization(cell.artefact("map"));
  const Camera camera = make_camera(map.surface, {});
  const RenderOptions size = {.size = kPanelSize};
  std::vector<Image> layout = {
      render(map.surface, camera, with_patch_edges(patch_paint(map), map), size),
      render(map.surface, camera, with_patch_edges(with_isolines(plain_paint(), map, 4), map), size)};
  const std::string remesh = cell.artefact("remesh");
  if (!remesh.empty()) layout.push_back(remesh_image(read_semiregular(remesh), camera));
  add_picture(figures, folder, "layout-" + file_stem(cell.model), layout,
              "Patches, iso-lines and remesh of " + cell.model + " by " + cell.label + " (the paper's figure 8).");
  const std::vector<MapMeasure> measures = map_measures(map, distortion(map), smoothness(map));
  std::vector<Image> panels;
  for (const char* name : {"anisotropy", "area"})
    panels.push_back(measure_image(map, camera, named(measures, name).column.values, named(measures, name).scale));
  add_picture(figures, folder, "distortion-" + file_stem(cell.model), panels,
              "Anisotropy and area distortion of " + cell.model + " by " + cell.label +
                  ", red from the worst 5% on (the paper's figure 2).");
}

/// One map of each method, the reference's first, all on its scale.
void smoothness_figure(const std::vector<const StoredCell*>& cells, const std::string& folder,
                       std::vector<RunFigure>& figures) {
  std::vector<Image> panels;
  std::string names;
  ColourScale scale;
  for (const StoredCell* cell : cells) {
    const Parameterization map = read_parameterization(cell->artefact("map"));
    const Smoothness s = smoothness(map);
    if (panels.empty()) scale = {0.0, s.all.p95};
    panels.push_back(measure_image(map, make_camera(map.surface, {}), s.faces, scale));
    names += (names.empty() ? "" : ", ") + cell->label;
  }
  add_picture(figures, folder, "smoothness-" + file_stem(cells.front()->model), panels,
              "Jumps of the first derivatives on " + cells.front()->model + ": " + names +
                  "; one scale, red from the worst 5% of the first on (the paper's figure 1).");
}

std::vector<const StoredCell*> mapped_cells(const Run& run, const Findings& found, const std::string& model) {
  std::vector<const StoredCell*> cells;
  for (const StoredCell& cell : run.cells) {
    if (cell.model != model || cell.artefact("map").empty()) continue;
    const auto same = [&](const StoredCell* other) { return other->options.method == cell.options.method; };
    const auto taken = std::find_if(cells.begin(), cells.end(), same);
    if (taken == cells.end())
      cells.push_back(&cell);
    else if (cell.label == found.reference && (*taken)->label != found.reference)
      *taken = &cell;
  }
  std::stable_partition(cells.begin(), cells.end(), [&](const StoredCell* c) { return c->label == found.reference; });
  return cells;
}

}  // namespace

void map_figures(const Run& run, const Findings& found, const std::string& folder, int most,
                 std::vector<RunFigure>& figures, Progress& progress) {
  int mapped = 0;
  for (const StoredModel& model : run.models) {
    const std::vector<const StoredCell*> cells = mapped_cells(run, found, model.name);
    if (cells.empty() || ++mapped > most) continue;
    progress.report("draw " + model.name, 0.0);
    reference_figures(*cells.front(), folder, figures);
    smoothness_figure(cells, folder, figures);
  }
  if (mapped > most) progress.note(fmt::format("the maps of {} of {} models are drawn (--map-models)", most, mapped));
}

void disc_figure(const Run& run, const std::string& folder, std::vector<RunFigure>& figures) {
  const bool maps = std::any_of(run.cells.begin(), run.cells.end(),
                                [](const StoredCell& cell) { return !cell.artefact("map").empty(); });
  if (!maps) return;
  constexpr int kLevel = 5, kLines = 8;
  const Camera above = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  std::vector<Image> panels;
  for (int sectors : {5, 9})
    for (const Parameterization& map : {loop_sector_disc(sectors, kLevel), relaxed_sector_disc(sectors, kLevel)})
      panels.push_back(render(map.surface, above, with_patch_edges(with_isolines(plain_paint(), map, kLines), map),
                              {.size = kPanelSize}));
  add_picture(
      figures, folder, "discs", panels,
      "Discs of 5 and 9 sectors, by Loop subdivision and by the global system with mean value weights (the paper's "
      "figure 9).");
}

}  // namespace gsp

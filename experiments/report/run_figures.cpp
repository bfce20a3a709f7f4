#include "experiments/report/run_figures.h"

#include "experiments/report/run_pictures.h"
#include "experiments/report/run_plots.h"
#include "mesh/atomic_file.h"

namespace gsp {

namespace {

void draw(const RunPlots& plots, const std::string& folder, Progress& progress) {
  for (const std::vector<FigureProgram>& figures : plots.runs) {
    progress.report("draw " + figures.front().name, 0.0);
    draw_figures(folder + "/figures", figures);
  }
}

}  // namespace

std::vector<RunFigure> run_figures(const Run& run, const Findings& found, const std::string& folder, int maps,
                                   Progress& progress) {
  make_folder(folder + "/figures");
  RunPlots plots;
  heat_figure(run, found, plots);
  curve_figures(run, plots);
  bar_figure(run, found, plots);
  error_figure(run, plots);
  const auto before_maps = static_cast<std::ptrdiff_t>(plots.figures.size());
  cost_figures(run, found, plots);
  draw(plots, folder, progress);
  std::vector<RunFigure> pictures;
  map_figures(run, found, folder, maps, pictures, progress);
  disc_figure(run, folder, pictures);
  plots.figures.insert(plots.figures.begin() + before_maps, pictures.begin(), pictures.end());
  return plots.figures;
}

}  // namespace gsp

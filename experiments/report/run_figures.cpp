#include "experiments/report/run_figures.h"

#include "experiments/report/run_pictures.h"
#include "experiments/report/run_plots.h"
#include "mesh/atomic_file.h"

namespace gsp {

std::vector<RunFigure> run_figures(const Run& run, const Findings& found, const std::string& folder,
                                   Progress& progress) {
  std::vector<RunFigure> figures;
  make_folder(folder + "/figures");
  progress.report("draw curves", 0.0);
  heat_figure(run, found, folder, figures);
  curve_figures(run, folder, figures);
  bar_figure(run, found, folder, figures);
  error_figure(run, folder, figures);
  map_figures(run, found, folder, figures, progress);
  disc_figure(run, folder, figures);
  cost_figures(run, found, folder, figures);
  return figures;
}

}  // namespace gsp

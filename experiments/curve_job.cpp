#include "experiments/curve_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <set>

#include "experiments/cells/models.h"
#include "experiments/curve/curve_csv.h"
#include "experiments/output/earlier_run.h"
#include "experiments/output/quoting.h"
#include "experiments/plot/gnuplot.h"
#include "experiments/plot/plot.h"
#include "mesh/atomic_file.h"

namespace gsp {

namespace {

namespace fs = std::filesystem;

// Runs a step; where it fails, the cause becomes part of the model's summary. Only a cancellation goes further.
void attempt(CurveSummary& summary, const std::function<void()>& step) {
  const auto record = [&](const std::string& cause, const std::string& sentence) {
    if (!summary.failure.empty()) return;
    summary.cause = cause;
    summary.failure = sentence;
  };
  try {
    step();
  } catch (const Error& error) {
    if (error.cause() == Cause::Cancelled) throw;
    record(cause_name(error.cause()), error.what());
  } catch (const std::bad_alloc&) {
    record(cause_name(Cause::OutOfMemory), "not enough memory");
  } catch (const std::exception& error) {
    record(cause_name(Cause::Internal), error.what());
  }
}

class Job {
 public:
  Job(std::string folder, const ReadOptions& read, const CurveOptions& options, Progress& progress)
      : folder_(std::move(folder)), read_(read), options_(options), progress_(progress) {
    make_folder(folder_);
    earlier_ = stems_of_earlier_run(folder_);
  }

  void add(const std::string& surface, const std::string& model) {
    const auto start = std::chrono::steady_clock::now();
    Progress progress = progress_.within(model);
    CurveRun run;
    CurveSummary summary;
    attempt(summary, [&] {
      CurveOptions options = options_;
      options.on_progress = [&](const CurveRun& so_far) {
        run.points = so_far.points;
        save_points(run.points);
      };
      const SurfaceFile file = read_model(surface, read_);
      for (const std::string& note : file.notes) progress.note(note);
      run = in_places_of(file, [&] { return rate_distortion_curve(file.mesh, model, options, progress); });
    });
    finished_.insert(finished_.end(), run.points.begin(), run.points.end());
    std::vector<CurveSeries> curves = curves_of(run.points);
    const CurveSummary numbers = summarize(model, curves);
    summary.model = model;
    summary.methods = numbers.methods;
    const std::string stem = file_stem(model);
    earlier_.erase(stem);
    remove_stale(folder_, files_of(stem), {});  // before its own: a figure's program stays where gnuplot is missing
    if (!run.omega.empty())
      attempt(summary, [&] {
        const std::string name = stem + "-omega.csv";
        write_omega_csv(folder_ + "/" + name, run.omega);
        made(name);
      });
    draw(summary, stem, {{model, curves}});
    if (!curves.empty()) panels_.emplace_back(model, std::move(curves));
    result_.models.push_back(std::move(summary));
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    progress.note(fmt::format("{:.1f} s", seconds.count()));
  }

  CurveJobResult finish() {
    save_points({});
    made("curve.csv");
    remove_stale(folder_, figure_files("overview"), {});
    if (panels_.size() > kMostPlotPanels)
      progress_.note(fmt::format("no overview is drawn of {} surfaces, more than {}", panels_.size(), kMostPlotPanels));
    else if (panels_.size() > 1)
      draw(result_.models.back(), "overview", panels_);
    for (const std::string& stem : earlier_) remove_stale(folder_, files_of(stem), result_.files);
    return std::move(result_);
  }

 private:
  static std::vector<std::string> files_of(const std::string& stem) {
    std::vector<std::string> files = figure_files(stem);
    files.push_back(stem + "-omega.csv");
    return files;
  }

  void made(const std::string& name) { result_.files.push_back(folder_ + "/" + name); }

  void save_points(const std::vector<CurvePoint>& unfinished) {
    std::vector<CurvePoint> all = finished_;
    all.insert(all.end(), unfinished.begin(), unfinished.end());
    write_curve_csv(folder_ + "/curve.csv", all);
  }

  void draw(CurveSummary& summary, const std::string& name, const std::vector<PlotPanel>& panels) {
    if (panels.front().second.empty()) return;
    attempt(summary, [&] {
      for (const std::string& file : plot(folder_, name, panels)) made(file);
    });
  }

  std::string folder_;
  const ReadOptions& read_;
  const CurveOptions& options_;
  Progress& progress_;
  std::vector<CurvePoint> finished_;
  std::vector<PlotPanel> panels_;
  CurveJobResult result_;
  std::set<std::string> earlier_;  ///< stems of an earlier run in the folder that this one has not come to
};

}  // namespace

bool CurveJobResult::failed() const {
  return std::any_of(models.begin(), models.end(), [](const CurveSummary& model) { return !model.failure.empty(); });
}

CurveJobResult curve_job(const std::vector<std::string>& surfaces, const std::string& folder, const ReadOptions& read,
                         const CurveOptions& options, Progress& progress) {
  Job job(folder, read, options, progress);
  for (const ModelSource& model : named_models(surfaces)) job.add(model.source, model.name);
  return job.finish();
}

}  // namespace gsp

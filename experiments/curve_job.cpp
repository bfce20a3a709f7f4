#include "experiments/curve_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <map>

#include "experiments/curve_csv.h"
#include "experiments/plot.h"
#include "mesh/io.h"

namespace gsp {

namespace {

namespace fs = std::filesystem;

bool surface_ending(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".ply" || ending == ".obj" || ending == ".off" || ending == ".stl";
}

// File names without folder and ending; numbered where two surfaces would share one.
std::vector<std::string> model_names(const std::vector<std::string>& surfaces) {
  std::vector<std::string> names;
  std::map<std::string, int> uses;
  for (const std::string& surface : surfaces) {
    const std::string stem = fs::path(surface).stem().string();
    const int use = ++uses[stem];
    names.push_back(use == 1 ? stem : stem + "-" + std::to_string(use));
  }
  return names;
}

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
    record("out-of-memory", "not enough memory");
  } catch (const std::exception& error) {
    record(cause_name(Cause::Internal), error.what());
  }
}

class Job {
 public:
  Job(std::string folder, const CurveOptions& options, Progress& progress)
      : folder_(std::move(folder)), options_(options), progress_(progress) {
    fs::create_directories(folder_);
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
      const Mesh mesh = read_mesh(surface);
      run = rate_distortion_curve(mesh, model, options, progress);
    });
    finished_.insert(finished_.end(), run.points.begin(), run.points.end());
    const CurveSummary numbers = summarize(model, run.points);
    summary.model = model;
    summary.methods = numbers.methods;
    if (!run.omega.empty())
      attempt(summary, [&] {
        write_omega_csv(folder_ + "/" + model + "-omega.csv", run.omega);
        made(model + "-omega.csv");
      });
    draw(summary, model, {{model, run.points}});
    if (!run.points.empty()) panels_.emplace_back(model, std::move(run.points));
    result_.models.push_back(std::move(summary));
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    progress.note(fmt::format("{:.1f} s", seconds.count()));
  }

  CurveJobResult finish() {
    save_points({});
    made("curve.csv");
    if (panels_.size() > 1) draw(result_.models.back(), "overview", panels_);
    return std::move(result_);
  }

 private:
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
  const CurveOptions& options_;
  Progress& progress_;
  std::vector<CurvePoint> finished_;
  std::vector<PlotPanel> panels_;
  CurveJobResult result_;
};

}  // namespace

bool CurveJobResult::failed() const {
  return std::any_of(models.begin(), models.end(), [](const CurveSummary& model) { return !model.failure.empty(); });
}

std::vector<std::string> surface_files(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    std::vector<std::string> inside;
    for (const fs::directory_entry& entry : fs::directory_iterator(path))
      if (entry.is_regular_file() && surface_ending(entry.path())) inside.push_back(entry.path().string());
    if (inside.empty()) throw Error(Cause::CannotOpen, "no PLY, OBJ, OFF or STL file in " + path);
    std::sort(inside.begin(), inside.end());
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

CurveJobResult curve_job(const std::vector<std::string>& surfaces, const std::string& folder,
                         const CurveOptions& options, Progress& progress) {
  Job job(folder, options, progress);
  const std::vector<std::string> models = model_names(surfaces);
  for (std::size_t i = 0; i < surfaces.size(); ++i) job.add(surfaces[i], models[i]);
  return job.finish();
}

}  // namespace gsp

#include "experiments/sweep/stage_runner.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "experiments/base/base_by_rate.h"
#include "experiments/curve/external_curves.h"
#include "experiments/curve/map_numbers.h"
#include "experiments/curve/stages.h"
#include "experiments/external/run_tool.h"
#include "experiments/output/stream_file.h"
#include "experiments/store/artefacts.h"
#include "experiments/sweep/reference_task.h"
#include "experiments/version.h"
#include "mesh/io.h"
#include "param/map/param_file.h"
#include "remesh/semiregular_file.h"

namespace gsp {

namespace {

std::vector<std::string> provenance(const CellOptions& options) {
  return options.external ? std::vector<std::string>{"external " + options.method} : provenance_of(options.remesh);
}

// The methods whose maps are made together, on one simplification.
struct MapBatch {
  ParameterizeOptions options;
  std::vector<const PlannedCell*> cells;  ///< one per map
};

class Runner {
 public:
  Runner(const std::string& store, const Task& task, const std::function<void(const std::string&)>& begin,
         Progress& progress)
      : store_(store), task_(task), begin_(begin), progress_(progress), done_(task.done) {
    make_folder(inbox_folder(store));
    forget_lost_artefacts();
  }

  void run() {
    const bool waiting = std::any_of(task_.cells.begin(), task_.cells.end(), [&](const PlannedCell& cell) {
      return !done_.count(cell.keys.at(StageKind::Measure));
    });
    if (!waiting) return;
    reference_seconds_ = reference_task_seconds();
    surface_ = read_mesh(store_ + '/' + task_.surface);
    for (const MapBatch& batch : missing_maps()) make_maps(batch);
    for (const PlannedCell& cell : task_.cells) run_cell(cell);
  }

 private:
  // A stage whose files were deleted or damaged runs again where something still waits for them.
  void forget_lost_artefacts() {
    std::erase_if(done_, [&](const auto& item) {
      const auto& artefacts = item.second.artefacts;
      return std::any_of(artefacts.begin(), artefacts.end(),
                         [&](const auto& artefact) { return !artefact_intact(store_, artefact.second); });
    });
  }

  const StageResult* succeeded(const PlannedCell& cell, StageKind kind) const {
    const auto found = done_.find(cell.keys.at(kind));
    return found == done_.end() || found->second.failed() ? nullptr : &found->second;
  }

  std::string artefact(const PlannedCell& cell, StageKind kind, const char* role) const {
    return store_ + '/' + succeeded(cell, kind)->artefacts.at(role);
  }

  std::vector<MapBatch> missing_maps() const {
    std::vector<MapBatch> batches;
    std::map<std::string, bool> seen;
    for (const PlannedCell& cell : task_.cells) {
      if (!has_map(cell.options) || done_.count(cell.keys.at(StageKind::Measure))) continue;
      if (done_.count(cell.keys.at(StageKind::Parameterize)) || seen[cell.keys.at(StageKind::Parameterize)]) continue;
      seen[cell.keys.at(StageKind::Parameterize)] = true;
      // A baseline goes along with any map whose options are the baseline's own, as far as those count for it.
      const auto goes_with = [&](const MapBatch& batch) {
        return same_map_options(cell.options, batch.cells.front()->options);
      };
      const bool own = cell.options.method == method_name(Method::Gsp);
      auto batch = own ? batches.end() : std::find_if(batches.begin(), batches.end(), goes_with);
      if (batch == batches.end()) batch = batches.insert(batches.end(), MapBatch{cell.options.parameterize, {}});
      batch->cells.push_back(&cell);
    }
    return batches;
  }

  void make_maps(const MapBatch& batch) {
    std::vector<Method> methods;
    for (const PlannedCell* cell : batch.cells) methods.push_back(method_of(cell->options.method));
    if (!begin(*batch.cells.front(), StageKind::Parameterize)) return;
    const Clock clock;
    std::vector<StageResult> results(methods.size());
    ParameterizeOptions options = batch.options;
    Profile profile;
    Progress timed = progress_;
    timed.set_profile(&profile);
    const bool failed = !attempt(results.front(), [&] {
      options = with_base_by_rate(surface_, options, timed);
      const std::vector<ParameterizeResult> maps = parameterize_all(surface_, methods, options, timed);
      for (std::size_t i = 0; i < maps.size(); ++i) describe_map(maps[i], results[i]);
    });
    // Together they fail together, so each is tried alone to learn which one it is.
    if (failed && methods.size() > 1) {
      for (const PlannedCell* cell : batch.cells) make_maps({options, {cell}});
      return;
    }
    for (std::size_t i = 0; i < results.size(); ++i) {
      results[i].steps = profile.steps();
      finish(*batch.cells[i], StageKind::Parameterize, results[i], clock);
    }
  }

  void describe_map(const ParameterizeResult& map, StageResult& result) {
    result.numbers = map_numbers(map, surface_.vertex_count());
    result.artefacts["map"] =
        keep_artefact(store_, ".param.ply", [&](const std::string& path) { write_parameterization(path, map.map); });
    result.artefacts["omega"] =
        keep_artefact(store_, ".csv", [&](const std::string& path) { write_omega_csv(path, map.omega); });
  }

  void run_cell(const PlannedCell& cell) {
    if (done_.count(cell.keys.at(StageKind::Measure))) return;
    if (!has_remesh(cell.options)) {
      run_stage(cell, StageKind::Measure, [&](StageResult& result) { result.points = whole_curve(cell); });
      return;
    }
    // Every stage starts from files, so that its result is the same whether or not those before it were at hand.
    if (has_map(cell.options) && !succeeded(cell, StageKind::Parameterize)) return;
    if (!run_stage(cell, StageKind::Remesh, [&](StageResult& result) { remesh_stage(cell, result); })) return;
    if (!run_stage(cell, StageKind::Encode, [&](StageResult& result) { encode_stage(cell, result); })) return;
    run_stage(cell, StageKind::Measure, [&](StageResult& result) { measure_stage(cell, result); });
  }

  // Of methods that have no remesh.
  std::vector<CurvePoint> whole_curve(const PlannedCell& cell) {
    const CellOptions& options = cell.options;
    return options.external ? external_curve(*options.external, meter(cell), options.samples, scratch(), progress_)
                            : anchor_curve(options.method, meter(cell), options.samples, progress_);
  }

  std::string scratch() const { return store_ + "/scratch"; }

  MeasuredRemesh measured_remesh_of(const PlannedCell& cell) {
    const CellOptions& options = cell.options;
    if (options.external)
      return measured(run_remesher(*options.external, surface_, scratch(), progress_), meter(cell), options.samples,
                      progress_);
    const Parameterization map = read_parameterization(artefact(cell, StageKind::Parameterize, "map"));
    return measured_remesh(map, options.remesh, meter(cell), options.samples, progress_);
  }

  void remesh_stage(const PlannedCell& cell, StageResult& result) {
    const MeasuredRemesh remesh = measured_remesh_of(cell);
    result.numbers = {{"level", remesh.shape.level},
                      {"remesh_faces", remesh.distance.faces},
                      {"remesh_error", remesh.distance.rms},
                      {"remesh_forward", remesh.distance.rms_forward},
                      {"remesh_backward", remesh.distance.rms_backward},
                      {"remesh_hausdorff", remesh.distance.hausdorff},
                      {"ceiling_db", remesh.distance.psnr_db}};
    // Of a map, they are its own numbers.
    if (cell.options.external) {
      result.numbers["base_vertices"] = remesh.shape.base_vertices;
      result.numbers["base_faces"] = remesh.shape.base_faces;
    }
    result.artefacts["remesh"] = keep_artefact(store_, ".sr.ply", [&](const std::string& path) {
      write_semiregular(path, remesh.mesh, provenance(cell.options));
    });
  }

  void encode_stage(const PlannedCell& cell, StageResult& result) {
    const SemiregularMesh mesh = read_semiregular(artefact(cell, StageKind::Remesh, "remesh"));
    StreamParts parts;
    const Bytes stream = encode(mesh, cell.options.encode, progress_, &parts);
    result.numbers = {{"stream_bytes", static_cast<double>(stream.size())},
                      {"header_bytes", static_cast<double>(parts.header_bytes)},
                      {"connectivity_bytes", static_cast<double>(parts.connectivity_bytes)}};
    result.artefacts["stream"] =
        keep_artefact(store_, ".pgc", [&](const std::string& path) { write_stream(path, stream); });
  }

  void measure_stage(const PlannedCell& cell, StageResult& result) {
    const CellOptions& options = cell.options;
    const Bytes embedded = read_stream(artefact(cell, StageKind::Encode, "stream"));
    if (options.mode == StreamMode::Embedded) {
      result.points = decoded_curve(embedded, options.budgets, meter(cell), options.samples, progress_);
      return;
    }
    const SemiregularMesh mesh = read_semiregular(artefact(cell, StageKind::Remesh, "remesh"));
    const std::vector<Bytes> streams = fixed_streams(mesh, options.encode, embedded, options.budgets, progress_);
    result.points = decoded_streams(streams, meter(cell), options.samples, progress_);
    for (const Bytes& stream : streams)
      result.artefacts[fixed_stream_role(stream.size())] =
          keep_artefact(store_, ".pgc", [&](const std::string& path) { write_stream(path, stream); });
  }

  const Meter& meter(const PlannedCell& cell) {
    std::unique_ptr<Meter>& meter = meters_[cell.options.seed];
    if (!meter) meter = std::make_unique<Meter>(surface_, cell.model, cell.options.seed);
    return *meter;
  }

  struct Clock {
    std::chrono::steady_clock::time_point wall = std::chrono::steady_clock::now();
    double cpu = process_cpu_seconds();
  };

  // True where the stage has still to run.
  bool begin(const PlannedCell& cell, StageKind kind) {
    const std::string& key = cell.keys.at(kind);
    if (done_.count(key)) return false;
    begin_(key);
    return true;
  }

  // True where the stage's result is at hand afterwards.
  bool run_stage(const PlannedCell& cell, StageKind kind, const std::function<void(StageResult&)>& stage) {
    if (begin(cell, kind)) {
      const Clock clock;
      StageResult result;
      attempt(result, [&] { stage(result); });
      finish(cell, kind, result, clock);
    }
    return succeeded(cell, kind) != nullptr;
  }

  static bool attempt(StageResult& result, const std::function<void()>& work) {
    std::string cause, failure;
    try {
      work();
      return true;
    } catch (const Error& error) {
      // A full disk is no property of the cell: the sweep ends, and resumes when there is room.
      if (error.cause() == Cause::Cancelled || error.cause() == Cause::CannotWrite) throw;
      cause = cause_name(error.cause());
      failure = error.what();
    } catch (const std::bad_alloc&) {
      cause = cause_name(Cause::OutOfMemory);
      failure = "not enough memory";
    } catch (const std::exception& error) {
      cause = cause_name(Cause::Internal);
      failure = error.what();
    }
    result = {};
    result.cause = cause;
    result.failure = failure;
    return false;
  }

  void finish(const PlannedCell& cell, StageKind kind, StageResult& result, const Clock& clock) {
    result.kind = kind;
    result.key = cell.keys.at(kind);
    const auto input = cell.keys.find(static_cast<StageKind>(static_cast<int>(kind) - 1));
    result.input = kind == StageKind::Parameterize || input == cell.keys.end() ? task_.surface_key : input->second;
    result.options = options_json(cell.options, kind);
    result.version = version();
    std::erase_if(result.numbers, [](const auto& number) { return !std::isfinite(number.second); });
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock.wall).count();
    result.cpu_seconds = process_cpu_seconds() - clock.cpu;
    result.reference_seconds = reference_seconds_;
    write_result(inbox_folder(store_) + '/' + result.key + ".json", result);
    done_[result.key] = std::move(result);
  }

  const std::string& store_;
  const Task& task_;
  const std::function<void(const std::string&)>& begin_;
  Progress& progress_;
  std::map<std::string, StageResult> done_;
  Mesh surface_;
  std::map<std::uint64_t, std::unique_ptr<Meter>> meters_;
  double reference_seconds_ = 0.0;
};

}  // namespace

void run_task(const std::string& store, const Task& task, const std::function<void(const std::string& key)>& begin,
              Progress& progress) {
  Runner(store, task, begin, progress).run();
}

}  // namespace gsp

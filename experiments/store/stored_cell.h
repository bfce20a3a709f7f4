#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/cells/cell_options.h"
#include "experiments/curve/curve.h"

namespace gsp {

/// What one stage made: a row of the store, and the JSON file that a worker hands over.
struct StageResult {
  std::string key;  ///< hash of the stage's name, its algorithm's version, its options and its input's key
  StageKind kind = StageKind::Parameterize;
  std::string input;    ///< key of the stage before it; of the surface for the first
  std::string options;  ///< `options_json` of the stage
  std::string version;  ///< of the program that ran it
  std::string cause;    ///< `cause_name` of what went wrong, or "crashed", "out-of-memory"; empty where all is well
  std::string failure;  ///< the same as a sentence
  /// Measured numbers by name; none is infinite or NaN.
  /// Parameterize: base_vertices, base_faces, flipped_faces, wrong_angle_vertices, flips_before_repair, vertices_added,
  /// held_vertices, corners_moved, base_edges_flipped, relaxation_rounds; of distortion.h anisotropy_mean,
  /// anisotropy_p95, area_symmetric_mean, sorkine_mean, l2_stretch; of smoothness.h smoothness_inside,
  /// smoothness_across, smoothness_at_corner (means) and, where it has a value, smoothness_across_over_inside. Remesh:
  /// level, remesh_faces, remesh_error (larger RMS over the input's diagonal), remesh_forward, remesh_backward,
  /// remesh_hausdorff, ceiling_db (-20 log10 of remesh_error; none where that is 0).
  /// Encode: stream_bytes, header_bytes, connectivity_bytes.
  std::map<std::string, double> numbers;
  /// Files by role, relative to the store's folder: "map" (*.param.ply), "omega" (*.csv, figure 5d), "remesh"
  /// (*.sr.ply), "stream" (*.pgc, the embedded one), `fixed_stream_role` of each size (*.pgc, of StreamMode::Fixed).
  std::map<std::string, std::string> artefacts;
  std::vector<CurvePoint>
      points;                ///< of Measure, by ascending bytes; only what a `Meter` fills in, and the coder of anchors
  double seconds = 0.0;      ///< wall
  double cpu_seconds = 0.0;  ///< of all threads
  std::vector<ProfileStep>
      steps;  ///< of Parameterize, where those seconds went, with what maps made along with it took
  double reference_seconds = 0.0;  ///< CPU time of the reference task in the same process (reference_task.h)

  bool failed() const { return !cause.empty(); }
};

/// "stream of 1024 bytes".
std::string fixed_stream_role(std::size_t bytes);

/// One surface of a recipe.
struct StoredModel {
  std::string name;         ///< unique in its recipe
  std::string source;       ///< file as the recipe's pattern found it, or "shape:NAME"
  std::string surface_key;  ///< hash of positions and faces; empty where it could not be read
  std::string path;         ///< of the surface as binary PLY, with the store's folder; empty where it could not be read
  int vertices = 0, faces = 0;
  std::string cause, failure;  ///< why it could not be read
};

/// One cell as the planner wants it: which stages it consists of.
struct PlannedCell {
  std::string model;
  std::string label;
  CellOptions options;
  std::map<StageKind, std::string> keys;  ///< of its stages; empty where the model could not be read
};

/// What a sweep of one recipe consists of.
struct Plan {
  std::string recipe;
  std::vector<StoredModel> models;
  std::vector<PlannedCell> cells;
  std::vector<std::string> notes;  ///< what reading the models had to say, for people; not stored
};

enum class CellStatus { Waiting, Done, Failed };
const char* status_name(CellStatus status);

/// One cell of a sweep with everything that is known about it.
struct StoredCell {
  int position = 0;     ///< in the recipe's order, from 0
  std::string model;    ///< name of its StoredModel
  std::string surface;  ///< hash of that surface; empty for a generated one and for one that could not be read
  /// The method, and the values of those options that vary within it: "gsp gamma=0 mu=1". Replicates share one.
  std::string label;
  CellOptions options;
  CellStatus status = CellStatus::Waiting;
  std::string cause, failure;  ///< of the first stage that failed
  std::vector<StageResult>
      stages;  ///< those that have run, in the order of StageKind; artefacts with the store's folder

  /// The label, and the replicate where it is not the first: "gsp, replicate 3".
  std::string title() const;
  /// The stage, or null where it has not run or the method has none.
  const StageResult* stage(StageKind kind) const;
  /// A number of whichever stage has it.
  std::optional<double> number(const std::string& name) const;
  /// Path of an artefact, with the store's folder; empty where there is none.
  std::string artefact(const std::string& role) const;
  /// The file of which a row decodes the first `bytes` bytes: of its own for StreamMode::Fixed, else the embedded
  /// stream.
  std::string stream_file(std::size_t bytes) const;
  /// The rows of curve.csv: points with the cell's columns filled in. Empty unless done.
  std::vector<CurvePoint> points() const;
};

/// A path of a store with its folder put before; an empty one stays.
std::string in_store(const std::string& folder, const std::string& path);

/// The plan's cells with those of the results that are theirs; paths get the folder put before.
std::vector<StoredCell> stored_cells(const Plan& plan, const std::map<std::string, StageResult>& results,
                                     const std::string& folder);

}  // namespace gsp

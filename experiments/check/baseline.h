#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/curve/rate_curve.h"
#include "experiments/store/store.h"

namespace gsp {

/// How far a quantity may move: the larger of an absolute amount and a share of the value before.
struct Tolerance {
  double absolute = 0.0;
  double relative = 0.0;
};

/// What one cell is held to.
struct BaselineRow {
  std::string model, label;
  std::map<std::string, std::string> options;  ///< name and value of every option that applies
  std::string cause;                           ///< of its failure; empty where it is well
  /// Machine-independent numbers by quantity: those of `quantities()`, and "psnr_db at N bytes" for each rate.
  std::map<std::string, double> numbers;
  /// CPU time of each stage, by "time parameterize" and so on, in units of the reference task of its session.
  std::map<std::string, double> times;
  RateCurve curve;                   ///< upper envelope of its points
  std::optional<double> ceiling_db;  ///< infinite where the remesh is exact
  std::string surface;               ///< hash of the file's surface; empty for a generated one, which is the program's
};

struct Baseline {
  std::string recipe, version;
  std::map<std::string, Tolerance> tolerances;  ///< by quantity without " at ...", "time" for all times, and "bd_rate"
  std::vector<BaselineRow> rows;
};

/// Which way a quantity gets worse.
enum class Direction { HigherIsBetter, LowerIsBetter, MayNotChange };

/// What is known about the quantities that are compared.
struct Quantity {
  const char* name;
  Direction direction;
  Tolerance tolerance;  ///< that a new baseline gets
};
const std::vector<Quantity>& quantities();

/// The quantity of a number's name ("psnr_db at 512 bytes" is psnr_db).
const Quantity& quantity_of(const std::string& number);

/// The baseline that a run makes. Cells that wait are left out.
Baseline baseline_of(const std::string& recipe, const std::vector<StoredCell>& cells);

/// As JSON, for people to review and edit. Throw Error: CannotWrite; CannotOpen, Malformed.
void write_baseline(const std::string& path, const Baseline& baseline);
Baseline read_baseline(const std::string& path);

}  // namespace gsp

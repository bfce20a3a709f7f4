#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/curve/rate_curve.h"
#include "experiments/store/store.h"
#include "metrics/bd_rate.h"

namespace gsp {

/// How far a quantity may move whatever chance does, such as by the rounding of another machine's library: the larger
/// of an absolute amount and a share of the value before.
struct Tolerance {
  double absolute = 0.0;
  double relative = 0.0;
};

/// The quantity of a curve over the baseline's.
inline constexpr const char* kBdRate = "bd_rate";

/// What one setting on one model is held to: the means of its replicates, and how far these lie apart.
struct BaselineRow {
  std::string model, label;
  std::map<std::string, std::string> options;  ///< name and value of every option that applies
  std::string cause;                           ///< of the first failure of a replicate; empty where all are well
  int replicates = 1;
  /// Machine-independent numbers by quantity: those of `quantities()`, and "psnr_db at N bytes" for each rate.
  std::map<std::string, double> numbers;
  /// Standard deviations of replicates, of those numbers that differ between them; "bd_rate" is that of the
  /// logarithm (`log_rate`) of a replicate's curve over the mean one, times 100.
  std::map<std::string, double> deviations;
  /// CPU time of each stage, by "time parameterize" and so on, in units of the reference task of its session.
  std::map<std::string, double> times;
  RateCurve curve;                   ///< upper envelope of its points; of replicates the mean PSNR at each size
  std::optional<double> ceiling_db;  ///< infinite where the remesh is exact
  std::string surface;               ///< hash of the file's surface; empty for a generated one, which is the program's
};

/// Its curve as `bd_compare` takes it.
BdCurve bd_curve(const BaselineRow& row);

struct Baseline {
  std::string recipe, version;
  std::map<std::string, Tolerance>
      tolerances;  ///< least ones, by quantity without " at ...", "time" for all times, and "bd_rate"
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

/// The baseline that a run makes: a row for cells that differ in the replicate alone. Cells that wait are left out.
Baseline baseline_of(const std::string& recipe, const std::vector<StoredCell>& cells);

/// As JSON, for people to review and edit. Throw Error: CannotWrite; CannotOpen, Malformed.
void write_baseline(const std::string& path, const Baseline& baseline);
Baseline read_baseline(const std::string& path);

}  // namespace gsp

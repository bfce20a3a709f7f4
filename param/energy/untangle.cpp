#include "param/energy/untangle.h"

#include <algorithm>
#include <cmath>

#include <lbfgs.h>

#include "param/atlas/folds.h"
#include "param/energy/distortion_energy.h"

namespace gsp {

namespace {

constexpr double kAreaWeight = 0.02;
constexpr std::size_t kLargestDisc = 500;  // vertices
constexpr int kOuterSteps = 12;
constexpr double kSharpening = 0.5;       // of ε, from one step to the next
constexpr double kDeterminantGain = 0.9;  // of the least determinant, below which a step has gained nothing;
constexpr int kIdleSteps = 3;             // so often in a row it gives up
constexpr int kInnerSteps = 50;
constexpr int kLastSteps = 30;

void minimise(const DistortionEnergy& energy, double epsilon, int steps, std::vector<double>& x) {
  lbfgs_parameter_t parameters;
  lbfgs_parameter_init(&parameters);
  parameters.max_iterations = steps;
  parameters.epsilon = 1e-7;
  parameters.past = 10;
  parameters.delta = 1e-5;
  parameters.linesearch = LBFGS_LINESEARCH_BACKTRACKING_ARMIJO;
  parameters.max_linesearch = 60;
  struct Call {
    const DistortionEnergy& energy;
    double epsilon;
  } call{energy, epsilon};
  const auto evaluate = [](void* self, const double* at, double* gradient, const int, const double) {
    const Call& c = *static_cast<const Call*>(self);
    return c.energy.evaluate(at, gradient, c.epsilon);
  };
  double least = 0.0;
  std::vector<double> moved = x;
  lbfgs(static_cast<int>(moved.size()), moved.data(), &least, evaluate, nullptr, &call, &parameters);
  if (std::all_of(moved.begin(), moved.end(), [](double v) { return std::isfinite(v); })) x = moved;
}

class Repair {
 public:
  Repair(Atlas& atlas, int most_rings, UntangleToward toward, Progress& progress)
      : atlas_(atlas), surface_(*atlas.surface), most_rings_(most_rings), toward_(toward), progress_(progress) {}

  Folds run() {
    Folds folds = find_folds(atlas_);
    for (int rings = 1; rings <= most_rings_ && !folds.none(); rings *= 2) {
      untangle_all(folds, rings);
      folds = find_folds(atlas_);
    }
    return folds;
  }

 private:
  void untangle_all(const Folds& folds, int rings) {
    // Those that meet form one disc.
    const auto& [reached, distance] = rings_around(surface_, folds, rings);
    std::vector<char> taken(distance.size(), 0);
    for (int seed : reached) {
      if (taken[seed]) continue;
      std::vector<int> region{seed};
      taken[seed] = 1;
      for (std::size_t i = 0; i < region.size(); ++i)
        surface_.for_each_neighbour(region[i], [&](int w, int, bool) {
          if (distance[w] < 0 || taken[w]) return;
          taken[w] = 1;
          region.push_back(w);
        });
      untangle(region);
      progress_.report("repair", 0.5);
    }
  }

  std::vector<ReferenceShape> shapes(const std::vector<int>& faces) const {
    return toward_ == UntangleToward::Surface ? reference_shapes(atlas_, faces) : equilateral_shapes(atlas_, faces);
  }

  void untangle(const std::vector<int>& region) {
    std::vector<int> vertices;
    for (int v : region)
      if (atlas_.is_free(v)) vertices.push_back(v);
    if (vertices.empty() || vertices.size() > kLargestDisc) return;
    const std::vector<int> faces = faces_around(surface_, vertices);
    std::vector<Complex> before;
    for (int v : vertices) before.push_back(atlas_.position[v]);
    const DistortionEnergy energy(atlas_, vertices, faces, shapes(faces), kAreaWeight);
    std::vector<double> x = energy.positions(atlas_);
    if (!drive_apart(energy, x, kInnerSteps)) return;
    const std::vector<double> valid = x;
    minimise(energy, 1e-9, kLastSteps, x);
    if (!energy.upright(x)) x = valid;
    energy.write_back(x, atlas_);
    const std::vector<int> touched = vertices_of(surface_.mesh.faces, faces);
    // Beyond the rim faces may still be folded.
    const bool miswound =
        std::any_of(touched.begin(), touched.end(), [&](int v) { return local_map(atlas_, v) == LocalMap::Miswound; });
    if (!miswound) return;
    for (std::size_t i = 0; i < vertices.size(); ++i) atlas_.position[vertices[i]] = before[i];
  }

  Atlas& atlas_;
  const Surface& surface_;
  const int most_rings_;
  const UntangleToward toward_;
  Progress& progress_;
};

}  // namespace

bool drive_apart(const DistortionEnergy& energy, std::vector<double>& x, int inner_steps) {
  double least = energy.least_determinant(x), epsilon = 1.0;
  int idle = 0;
  for (int step = 0; step < kOuterSteps && idle < kIdleSteps && !(least > 0.0); ++step) {
    const double before = least;
    // As Garanzha et al. choose it, but never slower than geometrically: a step that gains nothing sharpens the
    // barrier.
    epsilon = std::max(std::min(kSharpening * epsilon, std::sqrt(1e-18 + 0.04 * least * least)), 1e-7);
    minimise(energy, epsilon, inner_steps, x);
    least = energy.least_determinant(x);
    idle = least > kDeterminantGain * before ? 0 : idle + 1;
  }
  return least > 0.0 && energy.upright(x);
}

Folds repair_folds(Atlas& atlas, int most_rings, Progress& progress, UntangleToward toward) {
  return Repair(atlas, most_rings, toward, progress).run();
}

}  // namespace gsp

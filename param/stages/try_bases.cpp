#include "param/stages/try_bases.h"

#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "param/energy/distortion_energy.h"
#include "param/stages/smooth_levels.h"

namespace gsp {

namespace {

constexpr int kChanceBits = 24;  // of the replicates, above which a try has its own; 64 tries stay within an int

/// Of the whole map by area; 2 for an isometry.
double energy_of(const Atlas& atlas) {
  std::vector<int> faces(atlas.surface->mesh.faces.size()), vertices;
  std::iota(faces.begin(), faces.end(), 0);
  for (int v = 0; v < atlas.surface->mesh.vertex_count(); ++v)
    if (atlas.is_free(v)) vertices.push_back(v);
  const DistortionEnergy energy(atlas, vertices, faces, reference_shapes(atlas, faces), kMapAreaWeight);
  const std::vector<double> x = energy.positions(atlas);
  double sum = 0.0;
  for (int f = 0; f < energy.face_count(); ++f) sum += energy.weight(f) * energy.density(f, x.data());
  return sum;
}

double smoothed_energy(const SimplifyResult& simplified, Progress& progress) {
  const std::optional<SmoothedMap> map = smooth_coarsest_level(simplified, ParameterizeOptions{}, progress);
  return map ? energy_of(map->atlas) : std::numeric_limits<double>::infinity();
}

}  // namespace

TriedBase best_base(const std::shared_ptr<const Surface>& surface, const ParameterizeOptions& options, int coarsest,
                    Progress& progress) {
  std::optional<TriedBase> best(TriedBase{options, simplify(surface, options, coarsest, progress)});
  if (options.tries <= 1) return std::move(*best);
  ParameterizeOptions other = options;
  if (options.base_vertices == kBaseByOmega)
    other.base_vertices = surface->seams.count_whole(remaining_vertices(*surface, best->simplified.removals));
  const double first = smoothed_energy(best->simplified, progress);
  double least = first;
  for (int number = 1; number < options.tries; ++number) {
    const auto step = progress.step("try another base");
    other.replicate = options.replicate ^ (number << kChanceBits);
    SimplifyResult simplified = simplify(surface, other, coarsest, progress);
    const double energy = smoothed_energy(simplified, progress);
    if (!(energy < least)) continue;
    least = energy;
    best.emplace(TriedBase{other, std::move(simplified)});
  }
  progress.note("of " + std::to_string(options.tries) + " bases the best has an energy of distortion of " +
                std::to_string(least) + ", the first " + std::to_string(first));
  return std::move(*best);
}

}  // namespace gsp

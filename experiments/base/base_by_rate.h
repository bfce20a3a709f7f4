#pragma once

#include <vector>

#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "param/options.h"

namespace gsp {

/// A size of the base that was looked at.
struct BaseTried {
  int asked = 0;          ///< vertices
  int base_vertices = 0;  ///< of the map: more where the simplification could not go on
  double psnr_db = 0.0;   ///< mean over the budgets, of a stand-in for the surface
};

struct BaseByRate {
  /// The size to ask for; `kBaseByOmega` where no size of the ladder has a map, or a vertex has more than 256 faces.
  int base_vertices = kBaseByOmega;
  std::vector<BaseTried> tried;  ///< in the order in which they were
};

/// The size of base whose streams are best at equal bytes. Sizes 15, 21, 30, ... (steps of √2) are judged on a stand-in
/// of about 10,000 faces, the surface after decimation: parameterized without flips of base edges, remeshed, encoded
/// with lifted Butterfly, decoded at 1, 2, 4, 8 and 16 KB and measured (map_worth.h). From 30, 60 and 120 the search
/// climbs in octaves and takes the step nearest to the peak of the parabola through the best and its neighbours, for a
/// single size is better or worse by chance; at the ladder's ends it climbs in steps. Sizes at which the simplification
/// cannot arrive are passed over. How far the choice is behind the best size of whole curves: bench/README.md, "The
/// base by rate". Of `options` gamma, mu, weights and feature_degrees count. The same result for any number of threads.
/// About 1 CPU s a size below 200, three to five sizes, and the decimation. Throws Error: Cancelled, what
/// `require_parameterizable` throws.
BaseByRate base_by_rate(const Mesh& mesh, const ParameterizeOptions& options, Progress& progress);

/// Where feature curves give way in a base of the size asked for, the size and the features that are worth the most:
/// with `kAutoFeatures` that size without features; that size with them; and unless it is 2 dB behind, twice as many
/// vertices and so on as long as that is better, and one with room for all curves, but at most a quarter of the
/// surface's vertices and 1,600. Judged at 1 to 16 KB on the surface itself (map_worth.h), a map each. Of more than
/// 100,000 faces, whose maps take too long for that, the next size with room for all curves, if there is one. The
/// options as they are where none gives way. `progress` notes where features are given up. Throws what
/// `choose_features` throws, Error(Cancelled).
ParameterizeOptions with_features_by_rate(const Mesh& mesh, const ParameterizeOptions& options, Progress& progress);

/// The options as they are, but with the size chosen, and with it the features by `with_features_by_rate`, where
/// `base_vertices` is `kBaseByRate`; `progress` notes it.
ParameterizeOptions with_base_by_rate(const Mesh& mesh, ParameterizeOptions options, Progress& progress);

}  // namespace gsp

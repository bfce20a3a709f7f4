#include <benchmark/benchmark.h>

#include "mesh/parallel.h"
#include "mesh/shapes.h"
#include "metrics/hausdorff.h"
#include "metrics/surface_distance.h"

namespace {

using namespace gsp;

void build_tree(benchmark::State& state) {
  const Mesh sphere = shapes::sphere(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(SurfaceTree(sphere));
  state.SetItemsProcessed(state.iterations() * sphere.face_count());
}
BENCHMARK(build_tree)->Arg(4)->Arg(6)->Arg(7)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Two tessellations of nearly the same surface, the case of every point of a curve. Argument: threads.
void both_directions(benchmark::State& state) {
  set_thread_count(static_cast<int>(state.range(0)));
  const Mesh fine = shapes::torus(400, 200), coarse = shapes::torus(150, 90);
  const SurfaceTree tree(fine);
  const DistanceOptions options{1000000, 1};
  Progress silent;
  for (auto _ : state) benchmark::DoNotOptimize(surface_distance(fine, tree, coarse, options, silent));
  state.SetItemsProcessed(state.iterations() * 2 * static_cast<std::int64_t>(options.samples));
  set_thread_count(0);
}
BENCHMARK(both_directions)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Certain bounds for two offset surfaces that are far from each other in one place, the usual case, and for two tori
/// whose distance is largest along whole circles, the hard one.
void hausdorff(benchmark::State& state) {
  const bool hard = state.range(0) != 0;
  Mesh a = hard ? shapes::torus(80, 40) : shapes::sphere(6), b = hard ? shapes::torus(61, 33) : shapes::sphere(5);
  if (!hard)
    for (Vec3& p : a.positions) p *= 1.0 + 0.01 * p.x() + 0.003 * p.y() * p.z();
  const SurfaceTree tree_a(a), tree_b(b);
  Progress silent;
  for (auto _ : state) benchmark::DoNotOptimize(hausdorff_bounds(a, tree_a, b, tree_b, {}, silent));
}
BENCHMARK(hausdorff)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

#include <benchmark/benchmark.h>

#include "mesh/parallel.h"
#include "mesh/shapes.h"
#include "remesh/remesh.h"
#include "tests/support/exact_maps.h"

namespace {

using namespace gsp;

/// A jittered map of 20·4^level faces, remeshed at its own level. Linear: items per second stay as the level grows.
void remesh_sphere(benchmark::State& state) {
  const int level = static_cast<int>(state.range(0));
  set_thread_count(static_cast<int>(state.range(1)));
  Parameterization map = exact_maps::quadrisected(shapes::icosahedron(), level);
  exact_maps::jitter(map, 0.19, level, 1);
  Progress silent;
  for (auto _ : state) benchmark::DoNotOptimize(remesh(map, {level}, silent));
  state.SetItemsProcessed(state.iterations() * map.surface.face_count());
  set_thread_count(0);
}
BENCHMARK(remesh_sphere)->ArgsProduct({{4, 6, 7}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

#include <benchmark/benchmark.h>

#include "mesh/parallel.h"
#include "mesh/shapes.h"
#include "param/baselines/maps.h"
#include "param/parameterize.h"
#include "param/simplify/simplify.h"
#include "param/stages/smooth_levels.h"

namespace {

using namespace gsp;

constexpr int kBase = 40;

std::shared_ptr<const Surface> surface(const benchmark::State& state) {
  return std::make_shared<const Surface>(shapes::bumpy_sphere(static_cast<int>(state.range(0))));
}

ParameterizeOptions options() {
  ParameterizeOptions options;
  options.base_vertices = kBase;
  return options;
}

/// Items are vertices, here and below: per item the cost grows with the logarithm of the size at most.
void simplify_sphere(benchmark::State& state) {
  const auto sphere = surface(state);
  set_thread_count(static_cast<int>(state.range(1)));
  Progress silent;
  for (auto _ : state)
    benchmark::DoNotOptimize(simplify(sphere, options(), coarsest_level(*sphere, options()), silent));
  state.SetItemsProcessed(state.iterations() * sphere->mesh.vertex_count());
  set_thread_count(0);
}
BENCHMARK(simplify_sphere)->ArgsProduct({{5, 6, 7}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();

void smooth_sphere(benchmark::State& state) {
  const auto sphere = surface(state);
  set_thread_count(static_cast<int>(state.range(1)));
  Progress silent;
  for (auto _ : state) {
    state.PauseTiming();
    const SimplifyResult simplified = simplify(sphere, options(), coarsest_level(*sphere, options()), silent);
    state.ResumeTiming();
    benchmark::DoNotOptimize(smooth_levels(simplified, options(), silent));
  }
  state.SetItemsProcessed(state.iterations() * sphere->mesh.vertex_count());
  set_thread_count(0);
}
BENCHMARK(smooth_sphere)->ArgsProduct({{5, 6, 7}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();

void replay_as_maps(benchmark::State& state) {
  const auto sphere = surface(state);
  Progress silent;
  const SimplifyResult simplified = simplify(sphere, options(), coarsest_level(*sphere, options()), silent);
  for (auto _ : state) benchmark::DoNotOptimize(maps_overlay(simplified));
  state.SetItemsProcessed(state.iterations() * sphere->mesh.vertex_count());
}
BENCHMARK(replay_as_maps)->Arg(5)->Arg(6)->Arg(7)->Unit(benchmark::kMillisecond);

}  // namespace

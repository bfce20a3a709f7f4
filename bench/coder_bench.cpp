#include <benchmark/benchmark.h>

#include "coder/anchors.h"
#include "coder/codec.h"
#include "coder/wavelet_transform.h"
#include "tests/coder/sample_meshes.h"

using namespace gsp;

namespace {

Progress silent;

void vertices_per_second(benchmark::State& state, std::size_t vertices) {
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * vertices));
}

WaveletTransform transform_of(const SemiregularMesh& mesh) {
  return WaveletTransform(subdivision_levels(mesh.base_vertices, mesh.base_faces, mesh.level - 1));
}

void BM_WaveletAnalysisFinestLevel(benchmark::State& state) {
  const SemiregularMesh mesh = samples::bumpy_sphere(static_cast<int>(state.range(0)));
  const WaveletTransform transform = transform_of(mesh);
  int iterations = 0;
  for (auto _ : state) iterations = transform.analysis(mesh.level - 1, mesh.positions).iterations;
  state.counters["solver_iterations"] = iterations;
  vertices_per_second(state, mesh.positions.size());
}
BENCHMARK(BM_WaveletAnalysisFinestLevel)->Arg(5)->Arg(7)->Unit(benchmark::kMillisecond);

void BM_WaveletSynthesisFinestLevel(benchmark::State& state) {
  const SemiregularMesh mesh = samples::bumpy_sphere(static_cast<int>(state.range(0)));
  const WaveletTransform transform = transform_of(mesh);
  const WaveletTransform::Split split = transform.analysis(mesh.level - 1, mesh.positions);
  for (auto _ : state) benchmark::DoNotOptimize(transform.synthesis(mesh.level - 1, split.coarse, split.details));
  vertices_per_second(state, mesh.positions.size());
}
BENCHMARK(BM_WaveletSynthesisFinestLevel)->Arg(7)->Unit(benchmark::kMillisecond);

void BM_Encode(benchmark::State& state) {
  const SemiregularMesh mesh = samples::bumpy_sphere(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(encode(mesh, {}, silent));
  vertices_per_second(state, mesh.positions.size());
}
BENCHMARK(BM_Encode)->Arg(5)->Arg(7)->Unit(benchmark::kMillisecond);

/// Argument: budget in bytes.
void BM_Decode(benchmark::State& state) {
  const SemiregularMesh mesh = samples::bumpy_sphere(7);
  const Bytes stream = encode(mesh, {}, silent);
  for (auto _ : state) benchmark::DoNotOptimize(decode(stream, static_cast<std::size_t>(state.range(0))));
  vertices_per_second(state, mesh.positions.size());
}
BENCHMARK(BM_Decode)->Arg(1 << 10)->Arg(1 << 14)->Arg(1 << 30)->Unit(benchmark::kMillisecond);

void BM_DracoRoundTrip(benchmark::State& state) {
  const Mesh mesh = samples::bumpy_sphere(6).mesh();
  for (auto _ : state) benchmark::DoNotOptimize(draco_round_trip(mesh, 11));
  vertices_per_second(state, mesh.positions.size());
}
BENCHMARK(BM_DracoRoundTrip)->Unit(benchmark::kMillisecond);

void BM_DecimateToATenth(benchmark::State& state) {
  const Mesh mesh = samples::bumpy_sphere(6).mesh();
  for (auto _ : state) benchmark::DoNotOptimize(decimate(mesh, {mesh.face_count() / 10}, Decimation::Quadrics, silent));
  vertices_per_second(state, mesh.positions.size());
}
BENCHMARK(BM_DecimateToATenth)->Unit(benchmark::kMillisecond);

}  // namespace

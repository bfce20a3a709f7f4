#include <benchmark/benchmark.h>
#include <unistd.h>
#include <filesystem>
#include <map>
#include <string>

#include "mesh/io.h"
#include "mesh/shapes.h"
#include "mesh/topology.h"

namespace {

using namespace gsp;

/// About as many vertices as the Stanford dragon: 450,000 vertices, 900,000 faces.
const Mesh& surface() {
  static const Mesh mesh = shapes::torus(900, 500);
  return mesh;
}

/// The surface in a file of the format, written once and removed at exit.
class Files {
 public:
  ~Files() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  std::string path(const std::string& ending) const { return (folder_ / ("surface." + ending)).string(); }
  const std::string& written(const std::string& ending) {
    auto [it, inserted] = written_.try_emplace(ending, path(ending));
    if (inserted) {
      std::filesystem::create_directories(folder_);
      write_mesh(it->second, surface());
    }
    return it->second;
  }

 private:
  std::filesystem::path folder_ = std::filesystem::temp_directory_path() / ("gsp-bench-" + std::to_string(::getpid()));
  std::map<std::string, std::string> written_;
};

Files& files() {
  static Files files;
  return files;
}

void count(benchmark::State& state, const std::string& path) {
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(std::filesystem::file_size(path)));
  state.counters["faces"] = surface().face_count();
}

void read(benchmark::State& state, const std::string& ending) {
  const std::string& path = files().written(ending);
  for (auto _ : state) benchmark::DoNotOptimize(read_mesh(path));
  count(state, path);
}

void write(benchmark::State& state, const std::string& ending) {
  const std::string& path = files().written(ending);
  for (auto _ : state) write_mesh(path, surface());
  count(state, path);
}

void report(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(topology_report(surface()));
  state.SetItemsProcessed(state.iterations() * surface().face_count());
}

BENCHMARK_CAPTURE(read, ply, "ply")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read, obj, "obj")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read, off, "off")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read, stl, "stl")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write, ply, "ply")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write, obj, "obj")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write, off, "off")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write, stl, "stl")->Unit(benchmark::kMillisecond);
BENCHMARK(report)->Name("topology_report")->Unit(benchmark::kMillisecond);

}  // namespace

#include "experiments/report/view_data.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "coder/codec.h"
#include "mesh/io.h"
#include "mesh/shapes.h"
#include "remesh/recover_levels.h"
#include "temporary_folder.h"

using namespace gsp;

namespace {

/// The 3D view of a small stream that was measured at such sizes.
nlohmann::json view_of(const std::vector<std::size_t>& measured, bool with_streams) {
  const TemporaryFolder folder;
  const Mesh mesh = shapes::sphere(2);
  write_mesh(folder.file("s.ply"), mesh);
  Progress silent;
  const Bytes stream = encode(recover_levels(mesh), {}, silent);
  std::ofstream(folder.file("s.pgc"), std::ios::binary)
      .write(reinterpret_cast<const char*>(stream.data()), static_cast<std::streamsize>(stream.size()));
  StoredModel model;
  model.name = "s";
  model.path = folder.file("s.ply");
  StoredCell cell;
  cell.status = CellStatus::Done;
  StageResult measure;
  measure.kind = StageKind::Measure;
  measure.artefacts["stream"] = folder.file("s.pgc");
  for (std::size_t bytes : measured) measure.points.emplace_back().bytes = bytes;
  cell.stages.push_back(measure);
  return nlohmann::json::parse(view_json(model, cell, with_streams, silent));
}

std::vector<std::size_t> shown_sizes(const std::vector<std::size_t>& measured) {
  std::vector<std::size_t> sizes;
  const nlohmann::json view = view_of(measured, false);
  for (const auto& size : view["sizes"]) sizes.push_back(size["bytes"].get<std::size_t>());
  return sizes;
}

}  // namespace

TEST_CASE("the 3D view leaves sizes under 512 bytes out, but not where there are no others") {
  CHECK(shown_sizes({200, 300, 600, 700}) == std::vector<std::size_t>{600, 700});
  CHECK(shown_sizes({200, 300}) == std::vector<std::size_t>{200, 300});
  CHECK(shown_sizes({300}) == std::vector<std::size_t>{300});
}

TEST_CASE("a view holds the stream once where the page decodes it, else the connectivity and positions of each size") {
  const nlohmann::json streams = view_of({600, 700}, true), stored = view_of({600, 700}, false);
  CHECK(streams["streams"].size() == 1);
  CHECK(streams["sizes"][1]["stream"] == 0);
  CHECK_FALSE(streams.contains("grid"));
  CHECK_FALSE(streams["sizes"][0].contains("positions"));
  CHECK_FALSE(stored.contains("streams"));
  CHECK(stored.contains("grid"));
  CHECK(stored["sizes"][0].contains("positions"));
  for (const char* name : {"level", "low", "high", "camera", "patch_colours", "measures", "outward"})
    CHECK(streams[name] == stored[name]);
  CHECK(streams["sizes"][0]["distance"] == stored["sizes"][0]["distance"]);
}

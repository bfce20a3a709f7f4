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

/// The sizes that the 3D view of a small stream shows, of those that were measured.
std::vector<std::size_t> shown_sizes(const std::vector<std::size_t>& measured) {
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
  std::vector<std::size_t> sizes;
  const nlohmann::json view = nlohmann::json::parse(view_json(model, cell, silent));
  for (const auto& size : view["sizes"]) sizes.push_back(size["bytes"].get<std::size_t>());
  return sizes;
}

}  // namespace

TEST_CASE("the 3D view leaves sizes under 512 bytes out, but not where there are no others") {
  CHECK(shown_sizes({200, 300, 600, 700}) == std::vector<std::size_t>{600, 700});
  CHECK(shown_sizes({200, 300}) == std::vector<std::size_t>{200, 300});
  CHECK(shown_sizes({300}) == std::vector<std::size_t>{300});
}

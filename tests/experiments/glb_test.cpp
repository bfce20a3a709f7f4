#include "experiments/output/glb.h"

#include <catch2/catch.hpp>
#include <filesystem>

#include "mesh/error.h"
#include "mesh/shapes.h"
#include "remesh/recover_levels.h"
#include "temporary_folder.h"

using namespace gsp;

// That the files are right is tests/cli/glb_test.py's to say.
TEST_CASE("coordinates that single precision cannot hold are refused by the vertex, and no file is left") {
  const TemporaryFolder folder;
  const std::string path = folder.file("x.glb");
  const auto refused = [&](const SemiregularMesh& mesh) {
    try {
      write_glb(path, mesh, false);
    } catch (const Error& error) {
      CHECK_FALSE(std::filesystem::exists(path));
      return error;
    }
    return Error(Cause::Internal, "it was written");
  };
  const SemiregularMesh sphere = recover_levels(shapes::sphere(2));
  SemiregularMesh mesh = sphere;
  mesh.positions[7].y() = -1e39;
  CHECK(refused(mesh).cause() == Cause::NonFinite);
  CHECK(refused(mesh).index() == 7);
  for (Vec3& p : (mesh = sphere).positions) p *= 1e-50;
  CHECK(refused(mesh).cause() == Cause::TooSmall);
  CHECK_FALSE(std::filesystem::exists(path));
  write_glb(path, sphere, true);
  CHECK(std::filesystem::exists(path));
}

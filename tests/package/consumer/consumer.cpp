// Calls something of every public header, so that a symbol that is not exported fails to link. Exit status 1, and a
// line on standard error, where an answer is wrong.
#include <gsp/gsp.h>
#include <cstdio>

namespace {

int failures = 0;

void check(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "consumer: %s\n", what);
  ++failures;
}

/// A caller's arrays are looked at before they are used: the error names the row.
template <class Call>
void check_names_face(int face, Call call) {
  try {
    call();
    check(false, "a face of a vertex that does not exist was taken");
  } catch (const gsp::Error& error) {
    check(
        error.cause() == gsp::Cause::IndexOutOfRange && error.element() == gsp::Element::Face && error.index() == face,
        error.what());
  }
}

void check_refusals(const gsp::Mesh& good) {
  gsp::Progress silent;
  gsp::Mesh bad = good;
  bad.faces[5][1] = bad.vertex_count();
  check(!gsp::topology_report(bad).usable(), "a bad face is usable");
  check_names_face(5, [&] { gsp::parameterize(bad, {}, silent); });
  check_names_face(5, [&] { gsp::surface_distance(good, bad, {}, silent); });
  check_names_face(5, [&] { gsp::hausdorff_bounds(bad, good, {}, silent); });
  check_names_face(5, [&] { gsp::bounding_box_diagonal(bad); });
  check_names_face(5, [&] { gsp::surface_area(bad); });
  check_names_face(5, [&] { gsp::write_mesh("bad.stl", bad); });
  check_names_face(5, [&] { gsp::detect_features(bad); });
  check_names_face(5, [&] { gsp::edges_sharper_than(bad, 30.0); });
  check_names_face(5, [&] { gsp::weld(bad, 0.0); });
  check_names_face(5, [&] { gsp::recover_levels(bad); });
  check_names_face(5, [&] { gsp::shapes::quadrisect(bad); });

  gsp::Parameterization map = gsp::parameterize(good, {}, silent).map;
  map.surface.faces[5][1] = map.surface.vertex_count();
  check_names_face(5, [&] { gsp::check_map(map); });
  check_names_face(5, [&] { gsp::distortion(map); });
  check_names_face(5, [&] { gsp::face_distortion(map); });
  check_names_face(5, [&] { gsp::smoothness(map); });
  check_names_face(5, [&] { gsp::remesh(map, {}, silent); });
  check_names_face(5, [&] { gsp::write_parameterization("bad.param.ply", map); });

  gsp::SemiregularMesh remesh;
  remesh.base_vertices = 4;
  remesh.positions = gsp::shapes::tetrahedron().positions;
  remesh.base_faces = gsp::shapes::tetrahedron().faces;
  remesh.base_faces[3][2] = 4;
  check_names_face(3, [&] { gsp::encode(remesh, {}, silent); });
  check_names_face(3, [&] { remesh.mesh(); });
  check_names_face(3, [&] { gsp::write_semiregular("bad.sr.ply", remesh); });
}

void check_chain(const gsp::Mesh& mesh) {
  gsp::Progress silent;
  gsp::write_mesh("torus.ply", mesh, {"of the consumer test"});
  check(gsp::read_mesh("torus.ply").faces == mesh.faces, "a mesh does not read back");
  const gsp::ParameterizeResult result = gsp::parameterize(mesh, gsp::paper_options(), silent);
  check(gsp::check_map(result.map).valid(), "the map is not valid");
  gsp::write_parameterization("torus.param.ply", result.map);
  const gsp::Parameterization map = gsp::read_parameterization("torus.param.ply");
  check(gsp::distortion(map).flipped_faces == 0, "a face is flipped");
  check(gsp::smoothness(map).all.maximum >= 0.0, "smoothness");
  const gsp::SemiregularMesh remesh = gsp::remesh(map, {}, silent);
  gsp::write_semiregular("torus.sr.ply", remesh, gsp::provenance_of({}));
  check(gsp::read_or_recover("torus.sr.ply").base_faces == remesh.base_faces, "a remesh does not read back");
  check(gsp::recover_levels(remesh.mesh()).level >= remesh.level, "levels are lost");
  const gsp::Bytes stream = gsp::encode(remesh, {}, silent);
  const gsp::Mesh decoded = gsp::decode(stream, stream.size()).mesh();
  gsp::DistanceOptions few;
  few.samples = 20000;
  const gsp::SurfaceTree tree(mesh), other(decoded);
  const gsp::SurfaceDistance distance = gsp::surface_distance(mesh, tree, decoded, other, few, silent);
  check(distance.psnr_db() > 40.0, "the whole stream is far from the surface");
  check(gsp::diagonal_psnr(distance).db == distance.psnr_db(), "PSNR");
  check(gsp::metro_distances(mesh, tree, decoded, other, 1000, silent).forward.maximum > 0.0, "Metro");
  check(gsp::hausdorff_bounds(mesh, decoded, {}, silent).both().upper >= distance.hausdorff(), "the bounds");
}

}  // namespace

int main() {
  const gsp::Mesh torus = gsp::shapes::torus(24, 12);
  check_refusals(torus);
  check_chain(torus);
  const gsp::BdCurve curve{{{1000.0, 50.0}, {2000.0, 56.0}, {4000.0, 62.0}}};
  check(gsp::bd_compare(curve, curve, {}).rate.value == 0.0, "a curve gains over itself");
  check(gsp::thread_count() > 0, "threads");
  return failures == 0 ? 0 : 1;
}

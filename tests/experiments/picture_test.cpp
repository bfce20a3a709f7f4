#include "experiments/figures/picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "experiments/figures/paint.h"
#include "experiments/figures/remesh_map.h"
#include "mesh/edge.h"
#include "mesh/io.h"
#include "mesh/shapes.h"
#include "metrics/distortion.h"
#include "param/map/param_file.h"
#include "remesh/semiregular_file.h"
#include "temporary_folder.h"
#include "tests/by_threads.h"
#include "tests/support/exact_maps.h"

using namespace gsp;

namespace {

const Camera kFromZ = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
const Paint kRedPaint = [](const Fragment&) { return Colour(1.0, 0.0, 0.0); };

bool is_white(const Image& image, int x, int y) {
  const std::uint8_t* p = &image.rgb[3 * (static_cast<std::size_t>(y) * image.width + x)];
  return p[0] == 255 && p[1] == 255 && p[2] == 255;
}

Image draw(const Mesh& mesh, const Paint& paint, int size, bool smooth = true) {
  return render(mesh, kFromZ, paint, {.size = size, .smooth = smooth});
}

/// A square in the plane z = height, facing +z, with side `size` around the origin.
Mesh square(double height, double size) {
  Mesh mesh;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    mesh.positions.emplace_back(0.5 * size * x, 0.5 * size * y, height);
  mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// A fragment on the edge of corners 0 and 1 of face 0; the first weight grows by `slope` a pixel to the right, the
/// third down.
Fragment fragment_at(double w0, double slope) {
  Fragment fragment;
  fragment.weights = {w0, 1.0 - w0, 0.0};
  fragment.slopes = {Eigen::Vector2d(slope, 0.0), Eigen::Vector2d(-slope, -slope), Eigen::Vector2d(0.0, slope)};
  return fragment;
}

}  // namespace

TEST_CASE("the picture of a sphere is a disc with the border around it") {
  constexpr int kSize = 200;
  const Image image = draw(shapes::sphere(5), kRedPaint, kSize);
  CHECK(image.width == Approx(kSize).margin(1));
  CHECK(image.height == Approx(kSize).margin(1));
  int painted = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) painted += !is_white(image, x, y);
  const double radius = 0.5 * kSize * 0.94;
  // The pixels that the rim cuts count in full.
  CHECK(painted == Approx(3.14159 * (radius + 0.5) * (radius + 0.5)).epsilon(0.01));
  CHECK(is_white(image, 0, 0));
}

TEST_CASE("of two surfaces the nearer one is seen, whatever the order of the faces") {
  for (const bool swapped : {false, true}) {
    Mesh mesh = square(swapped ? 0.0 : 1.0, swapped ? 2.0 : 1.0);
    const Mesh other = square(swapped ? 1.0 : 0.0, swapped ? 1.0 : 2.0);
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    for (const Triangle& t : other.faces) mesh.faces.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
    const int near_face = swapped ? 2 : 0;
    const Image image = draw(
        mesh,
        [near_face](const Fragment& fragment) {
          return fragment.face / 2 == near_face / 2 ? Colour(1.0, 0.0, 0.0) : Colour(0.0, 1.0, 0.0);
        },
        64);
    const auto pixel = [&](int x, int y) { return &image.rgb[3 * (static_cast<std::size_t>(y) * image.width + x)]; };
    CHECK(pixel(32, 32)[0] > pixel(32, 32)[1]);
    CHECK(pixel(8, 8)[1] > pixel(8, 8)[0]);
  }
}

TEST_CASE("an inside-out surface looks like the same one turned out") {
  const Mesh out = shapes::sphere(2);
  Mesh in = out;
  for (Triangle& t : in.faces) std::swap(t[1], t[2]);
  const Image a = draw(out, kRedPaint, 50, false), b = draw(in, kRedPaint, 50, false);
  int most = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) most = std::max(most, std::abs(a.rgb[i] - b.rgb[i]));
  CHECK(most <= 1);
}

TEST_CASE("a picture has the same bytes for any number of threads") {
  const Mesh mesh = shapes::torus(40, 20);
  const auto [one, two] = by_one_and_two_threads([&] { return draw(mesh, with_wireframe(plain_paint()), 150); });
  CHECK(one.rgb == two.rgb);
}

TEST_CASE("lines have their width in pixels, and fade into their mean where they crowd") {
  constexpr double kWidth = 2.0, kSlope = 0.01;
  const std::array<double, 3> values = {1.0, 0.0, 0.0};
  CHECK(line_ink(values, fragment_at(0.0, kSlope), kWidth) == Approx(1.0));
  CHECK(line_ink(values, fragment_at(0.005, kSlope), kWidth) == Approx(1.0));
  CHECK(line_ink(values, fragment_at(0.010, kSlope), kWidth) == Approx(0.5));
  CHECK(line_ink(values, fragment_at(0.030, kSlope), kWidth) == Approx(0.0));
  CHECK(line_ink(values, fragment_at(0.998, kSlope), kWidth) == Approx(1.0));
  CHECK(line_ink(values, fragment_at(0.25, 0.5), 1.0) == Approx(0.375).margin(0.2));
  CHECK(line_ink(values, fragment_at(0.25, 0.0), kWidth) == 0.0);
  // Lines as wide as their spacing cover everything, those wider than that of full ink keep their width.
  CHECK(line_ink(values, fragment_at(0.5, 0.2), 5.0) == Approx(1.0));
  CHECK(line_ink(values, fragment_at(0.1, 0.02), 10.0) == Approx(0.5));
}

TEST_CASE("patches are coloured where the map has them, in whatever chart a face is given") {
  const Mesh base = shapes::icosahedron();
  Parameterization map = exact_maps::quadrisected(base, 2);
  const Paint before = patch_paint(map);
  exact_maps::rechart(map, 5);
  const Paint after = patch_paint(map);
  for (int f = 0; f < map.surface.face_count(); ++f) {
    Fragment fragment = fragment_at(0.4, 0.0);
    fragment.weights = {0.4, 0.35, 0.25};
    fragment.face = f;
    CHECK((before(fragment) == after(fragment)).all());
    fragment.face = f / 16 * 16;
    CHECK((before(fragment) == after(fragment)).all());
  }
  // Neighbours across an edge differ.
  for (int h = 0; h < 3 * map.base.face_count(); ++h) {
    Fragment here = fragment_at(0.4, 0.0), there = here;
    here.face = 16 * (h / 3) + 15;
    there.face = 16 * (map.base.twins[h] / 3) + 15;
    here.weights = there.weights = {0.4, 0.3, 0.3};
    CHECK((before(here) != before(there)).any());
  }
}

TEST_CASE("iso-lines and patch edges lie where the lattice has them") {
  const Parameterization map = exact_maps::quadrisected(shapes::octahedron(), 1);
  const Paint paint = with_isolines(plain_paint(), map, 2);
  const Colour plain = plain_paint()(Fragment{});
  // Face 3 of a base face joins the midpoints, so all its edges are lines of density 2, and none is of density 1.
  Fragment middle = fragment_at(0.5, 0.01);
  middle.face = 3;
  CHECK((paint(middle) != plain).any());
  CHECK((with_patch_edges(plain_paint(), map)(middle) == plain).all());
  Fragment edge = fragment_at(0.5, 0.01);
  edge.face = 0;
  CHECK((with_patch_edges(plain_paint(), map)(edge) != plain).any());
}

TEST_CASE("creases are wide lines along their base edge on both sides, and nowhere else") {
  Parameterization map = exact_maps::quadrisected(shapes::octahedron(), 2);
  map.base.creases = {ascending(map.base.faces[0][0], map.base.faces[0][1])};
  REQUIRE_NOTHROW(require_well_formed(map));
  const std::vector<char> creased = map.base.crease_halfedges();
  for (const bool other_charts : {false, true}) {
    if (other_charts) exact_maps::rechart(map, 5);
    const Paint paint = with_creases(plain_paint(), map);
    const Colour plain = plain_paint()(Fragment{});
    for (int p = 0; p < map.base.face_count(); ++p)
      for (int corner = 0; corner < 3; ++corner) {
        // Of the sixteen faces of a patch the first at each corner, at the edge to the next corner.
        CAPTURE(other_charts, p, corner);
        Fragment fragment;
        fragment.face = -1;
        for (int f = 16 * p; f < 16 * p + 16; ++f)
          for (int k = 0; k < 3; ++k)
            if (map.surface.faces[f][k] == map.base.vertices[map.base.faces[p][corner]]) {
              fragment.face = f;
              fragment.weights[k] = fragment.weights[(k + 1) % 3] = 0.49;
              fragment.weights[(k + 2) % 3] = 0.02;
              fragment.slopes[k] = Eigen::Vector2d(0.01, 0.0);
              fragment.slopes[(k + 1) % 3] = Eigen::Vector2d(-0.01, -0.02);
              fragment.slopes[(k + 2) % 3] = Eigen::Vector2d(0.0, 0.02);
            }
        REQUIRE(fragment.face >= 0);
        CHECK((paint(fragment) != plain).any() == static_cast<bool>(creased[3 * p + corner]));
      }
  }
}

TEST_CASE("pictures of patches and wires show creases, and are what they were where there are none") {
  const TemporaryFolder folder;
  const std::string map_file = folder.file("m.ply"), remesh_file = folder.file("r.sr.ply");
  Parameterization map = exact_maps::quadrisected(shapes::octahedron(), 2);
  SemiregularMesh mesh;
  mesh.level = 2;
  mesh.base_vertices = map.base.vertex_count();
  mesh.base_faces = map.base.faces;
  mesh.positions = shapes::quadrisect(shapes::quadrisect(shapes::octahedron())).positions;
  Progress silent;
  PictureOptions options;
  options.view = {.toward = Vec3(1.0, 2.0, 3.0), .up = {}};
  options.render.size = 100;
  // The paints as they were before creases.
  const auto expected = [&](const Parameterization& shown) {
    const bool wires = options.subject == Subject::Wireframe;
    const Paint paint = wires ? with_wireframe(plain_paint()) : with_patch_edges(patch_paint(shown), shown);
    return render(shown.surface, make_camera(shown.surface, options.view), paint, {.size = 100, .smooth = !wires});
  };
  for (const bool creased : {false, true}) {
    if (creased)
      for (int k = 0; k < 3; ++k)
        map.base.creases.push_back(ascending(map.base.faces[0][k], map.base.faces[0][(k + 1) % 3]));
    std::sort(map.base.creases.begin(), map.base.creases.end());
    mesh.creases = map.base.creases;
    write_parameterization(map_file, map);
    write_semiregular(remesh_file, mesh);
    for (const Subject subject : {Subject::Patches, Subject::Wireframe}) {
      options.subject = subject;
      CAPTURE(creased, subject_name(options.subject));
      CHECK((file_picture(map_file, options, silent).image.rgb == expected(map).rgb) != creased);
      CHECK((file_picture(remesh_file, options, silent).image.rgb == expected(remesh_as_map(mesh)).rgb) != creased);
    }
  }
}

TEST_CASE("wires of another tool's file with an element called crease are drawn as of any surface") {
  const TemporaryFolder folder;
  const std::string path = folder.file("s.ply");
  std::ofstream(path)
      << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 1\nproperty list uchar int vertex_indices\nelement crease 1\nproperty int a\n"
         "property int b\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n0 1\n";
  Progress silent;
  PictureOptions options;
  options.subject = Subject::Wireframe;
  options.render.size = 32;
  CHECK(file_picture(path, options, silent).image.rgb == mesh_picture(read_mesh(path), options).image.rgb);
}

TEST_CASE("a semi-regular mesh is a valid map of itself") {
  SemiregularMesh mesh;
  const Mesh base = shapes::octahedron();
  mesh.level = 2;
  mesh.base_vertices = base.vertex_count();
  mesh.base_faces = base.faces;
  mesh.positions = shapes::quadrisect(shapes::quadrisect(base)).positions;
  const Parameterization map = remesh_as_map(mesh);
  CHECK_NOTHROW(require_well_formed(map));
  CHECK(check_map(map).valid());
  CHECK(distortion(map).anisotropy.maximum == Approx(1.0));
}

TEST_CASE("the automatic view has what stands on its widest side upright") {
  // A plate with a mast along -z: it stands on its plate, so up is -z.
  Mesh mesh = shapes::grid(10, 10);
  mesh.positions.emplace_back(5.0, 5.0, -20.0);
  const int top = mesh.vertex_count() - 1;
  mesh.faces.push_back({0, 1, top});
  const Camera camera = make_camera(mesh, {});
  CHECK(camera.up.z() < -0.5);
  CHECK(camera.right.dot(camera.up) == Approx(0.0).margin(1e-12));
  CHECK(camera.right.cross(camera.up).dot(camera.toward) == Approx(1.0));
  const Camera given = make_camera(mesh, {.toward = Vec3(0, 2, 0), .up = Vec3(0, 1, 5)});
  CHECK((given.up - Vec3::UnitZ()).norm() < 1e-12);
  CHECK_THROWS_AS(make_camera(mesh, {.toward = Vec3(0, 0, 0), .up = {}}), Error);
  CHECK_THROWS_AS(make_camera(mesh, {.toward = Vec3(0, 1, 0), .up = Vec3(0, -2, 0)}), Error);
}

TEST_CASE("every subject is drawn from a file, and those of a map refuse a plain surface") {
  const TemporaryFolder folder;
  const Parameterization map = exact_maps::quadrisected(shapes::octahedron(), 2);
  const std::string map_file = folder.file("m.ply"), surface = folder.file("s.off");
  write_parameterization(map_file, map);
  write_mesh(surface, shapes::sphere(2));
  Progress silent;
  PictureOptions options;
  options.render.size = 32;
  options.other = surface;
  for (Subject subject : kSubjects) {
    CAPTURE(subject_name(subject));
    options.subject = subject;
    const Picture picture = file_picture(map_file, options, silent);
    CHECK(std::max(picture.image.width, picture.image.height) == 32);
    const bool by_value =
        subject == Subject::Distortion || subject == Subject::Smoothness || subject == Subject::Distance;
    CHECK(picture.scale.has_value() == by_value);
    const bool any_surface =
        subject == Subject::Wireframe || subject == Subject::Surface || subject == Subject::Distance;
    if (any_surface)
      CHECK_NOTHROW(file_picture(surface, options, silent));
    else
      CHECK_THROWS_AS(file_picture(surface, options, silent), Error);
  }
}

TEST_CASE("a PNG has its signature and size, and a bad size of picture is refused") {
  const TemporaryFolder folder;
  const std::string path = folder.file("p.png");
  const Image image = draw(shapes::tetrahedron(), kRedPaint, 40);
  write_png(path, image);
  std::ifstream in(path, std::ios::binary);
  std::stringstream bytes;
  bytes << in.rdbuf();
  REQUIRE(bytes.str().size() > 24);
  CHECK(bytes.str().substr(1, 3) == "PNG");
  CHECK(static_cast<unsigned char>(bytes.str()[19]) == image.width);
  CHECK(static_cast<unsigned char>(bytes.str()[23]) == image.height);
  CHECK_THROWS_AS(draw(shapes::tetrahedron(), kRedPaint, 15), Error);
  CHECK_THROWS_AS(draw(Mesh{}, kRedPaint, 40), Error);
}

#include "mesh/files/polygon_cutter.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "mesh/files/formats.h"
#include "mesh/io.h"
#include "mesh/random.h"
#include "mesh_files.h"
#include "test_meshes.h"

using namespace gsp;

namespace {

using Outcome = PolygonCutter::Outcome;
using Polygon = std::vector<Vec3>;

Outcome outcome(const Polygon& polygon) { return PolygonCutter().cut(polygon); }

double cross(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Twice the signed area, seen along z.
double shoelace(const Polygon& polygon) {
  double area = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    area += cross(Vec3::Zero(), polygon[i], polygon[(i + 1) % polygon.size()]);
  return area;
}

/// The triangles tile a polygon that runs counter-clockwise seen along z: none is turned over, each side of the polygon
/// is a side of one, any other side is one of two that run opposite ways, and the areas add up.
void check_tiling(const Polygon& polygon) {
  PolygonCutter cutter;
  REQUIRE(cutter.cut(polygon) == Outcome::Cut);
  const int n = static_cast<int>(polygon.size());
  REQUIRE(cutter.triangles().size() == polygon.size() - 2);
  std::map<std::pair<int, int>, int> sides;
  double area = 0.0;
  for (const Triangle& t : cutter.triangles()) {
    const double part = cross(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
    CHECK(part > 0.0);
    area += part;
    for (int k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
  }
  CHECK(area == Approx(shoelace(polygon)).epsilon(1e-9));
  for (const auto& [side, uses] : sides) {
    CHECK(uses == 1);
    const bool border = side.second == (side.first + 1) % n;
    CHECK(sides.count({side.second, side.first}) == (border ? 0U : 1U));
  }
}

/// A corner on the grid. Plain numbers: a build with sanitizers takes twenty times as long for vectors.
struct GridPoint {
  int x, y;
};

int cross(GridPoint a, GridPoint b, GridPoint c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// The product of the ways from p to a and to b.
int dot_from(GridPoint p, GridPoint a, GridPoint b) { return (a.x - p.x) * (b.x - p.x) + (a.y - p.y) * (b.y - p.y); }

bool segments_meet(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  const int abc = cross(a, b, c), abd = cross(a, b, d), cda = cross(c, d, a), cdb = cross(c, d, b);
  if ((abc == 0 && dot_from(c, a, b) <= 0) || (abd == 0 && dot_from(d, a, b) <= 0) ||
      (cda == 0 && dot_from(a, c, d) <= 0) || (cdb == 0 && dot_from(b, c, d) <= 0))
    return true;
  return (abc > 0) != (abd > 0) && (cda > 0) != (cdb > 0);
}

/// Two sides that meet though they are not neighbours; nothing for a simple polygon.
std::optional<std::pair<int, int>> meeting_sides(const std::vector<GridPoint>& p) {
  const int n = static_cast<int>(p.size());
  for (int i = 0; i < n; ++i)
    for (int j = i + 2; j < n; ++j)
      if (!(i == 0 && j == n - 1) && segments_meet(p[i], p[i + 1], p[j], p[(j + 1) % n])) return {{i, j}};
  return std::nullopt;
}

/// Random points of a grid, so that many are collinear, in an order without crossings where turning parts round finds
/// one.
std::optional<Polygon> random_polygon(Random& random, int corners, int grid) {
  std::vector<GridPoint> p;
  for (int i = 0; i < corners; ++i) {
    const auto at = [&] { return static_cast<int>(random.next() % static_cast<std::uint64_t>(grid)); };
    const int x = at(), y = at();
    p.push_back({x, y});
  }
  for (int tries = 0; tries < 40 * corners; ++tries) {
    const auto meeting = meeting_sides(p);
    if (!meeting) break;
    std::reverse(p.begin() + meeting->first + 1, p.begin() + meeting->second + 1);
  }
  const int n = corners;
  for (int i = 0; i < n; ++i) {  // neighbours may still fold back onto each other
    const GridPoint before = p[i], here = p[(i + 1) % n], after = p[(i + 2) % n];
    if (cross(before, here, after) == 0 && dot_from(here, before, after) >= 0) return std::nullopt;
  }
  if (meeting_sides(p)) return std::nullopt;
  Polygon polygon;
  for (const GridPoint& corner : p) polygon.push_back(Vec3(corner.x, corner.y, 0.0));
  if (shoelace(polygon) < 0.0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

/// Teeth along x, each of four corners, on a bar.
Polygon comb(int teeth) {
  Polygon p;
  for (int i = 0; i < teeth; ++i) {
    const double x = 2.0 * i;
    p.insert(p.end(), {{x, 4, 0}, {x, 0, 0}, {x + 1, 0, 0}, {x + 1, 4, 0}});
  }
  p.push_back({2.0 * teeth - 1.0, 5, 0});
  p.push_back({0, 5, 0});
  return p;
}

double area_of(MeshFormat format, const std::string& bytes) { return surface_area(parse_surface(format, bytes).mesh); }

}  // namespace

TEST_CASE("random simple polygons are tiled, with many corners on a line", "[slow]") {
  Random random(14);
  int made = 0, concave = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const int corners = 4 + static_cast<int>(random.next() % 30), grid = 4 + static_cast<int>(random.next() % 20);
    const std::optional<Polygon> polygon = random_polygon(random, corners, grid);
    if (!polygon) continue;
    ++made;
    for (std::size_t k = 2; k < polygon->size(); ++k)
      if (cross((*polygon)[0], (*polygon)[k - 1], (*polygon)[k]) < 0.0) {
        ++concave;
        break;
      }
    check_tiling(*polygon);
  }
  CHECK(made > 500);
  CHECK(concave > 300);
}

TEST_CASE("a polygon in any plane, bent or of any size is cut as the flat one below it") {
  Random random(6);
  int made = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const std::optional<Polygon> polygon = random_polygon(random, 12, 30);
    if (!polygon) continue;
    ++made;
    const double a = 3.0 * random.uniform(), b = 3.0 * random.uniform();
    Eigen::Matrix3d turned;
    turned << std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1;
    Eigen::Matrix3d tilted;
    tilted << 1, 0, 0, 0, std::cos(b), -std::sin(b), 0, std::sin(b), std::cos(b);
    const Eigen::Matrix3d motion = tilted * turned;
    Polygon bent = *polygon;
    for (Vec3& p : bent) {
      p.z() = 0.3 * random.uniform();
      p = motion * p + Vec3(100, -50, 20);
    }
    PolygonCutter cutter;
    REQUIRE(cutter.cut(bent) == Outcome::Cut);
    const std::vector<Triangle> triangles = cutter.triangles();
    for (const Triangle& t : triangles) {
      const Vec3 normal = (bent[t[1]] - bent[t[0]]).cross(bent[t[2]] - bent[t[0]]);
      CHECK(normal.dot(motion * Vec3::UnitZ()) > -1e-2 * normal.norm());
    }
    for (const int exponent : {-990, 900}) {
      Polygon scaled = bent;
      for (Vec3& p : scaled) p = p.unaryExpr([&](double x) { return std::scalbn(x, exponent); });
      REQUIRE(cutter.cut(scaled) == Outcome::Cut);
      CHECK(cutter.triangles() == triangles);
    }
  }
  CHECK(made > 100);
}

TEST_CASE("a polygon that joins a hole to its border by a bridge loses the hole") {
  const Polygon frame = {{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {0, 6, 0}, {0, 0, 0},
                         {2, 2, 0}, {2, 4, 0}, {4, 4, 0}, {4, 2, 0}, {2, 2, 0}};
  PolygonCutter cutter;
  REQUIRE(cutter.cut(frame) == Outcome::Cut);
  double area = 0.0;
  for (const Triangle& t : cutter.triangles()) {
    const double part = cross(frame[t[0]], frame[t[1]], frame[t[2]]);
    CHECK(part > 0.0);
    area += part;
  }
  CHECK(area == Approx(2.0 * (36.0 - 4.0)));
  const std::string root = shared_meshes();
  if (!root.empty()) CHECK(surface_area(read_mesh(root + "/bad/assimp_concave_polygon.obj")) > 0.0);
}

TEST_CASE("what is not simple is told from what is") {
  const Vec3 a(0, 0, 0), b(4, 0, 0), c(4, 3, 0), d(0, 3, 0);
  CHECK(outcome({a, b, c, d}) == Outcome::Cut);
  CHECK(outcome({a, c, b, d}) == Outcome::NotSimple);                             // bow tie of no area
  CHECK(outcome({a, {4, 1, 0}, {4, 0, 0}, d}) == Outcome::NotSimple);             // bow tie of some
  CHECK(outcome({a, b, c, {4, 5, 0}, c, d}) == Outcome::NotSimple);               // spike
  CHECK(outcome({a, b, {4, 1, 0}, {2, 0, 0}, {0, 1, 0}}) == Outcome::NotSimple);  // a corner on a side
  CHECK(outcome({a, {2, 2, 0}, b, c, {2, 2, 0}, d}) == Outcome::NotSimple);       // falls apart at a corner
  CHECK(outcome({a, b, {2, 1.5, 0}, d, c, {2, 1.5, 0}}) == Outcome::NotSimple);   // crosses at a corner
  CHECK(outcome({a, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}}) == Outcome::Cut);           // a line
  CHECK(outcome({a, a, a, a}) == Outcome::Cut);                                   // a point
  CHECK(outcome({a, b, b, c, c, d}) == Outcome::Cut);                             // sides of no length
  CHECK(outcome({a, b, c, Vec3::Constant(NAN)}) == Outcome::Cut);                 // for a report to name
  Polygon star;
  for (int k = 0; k < 5; ++k) star.push_back({std::cos(0.8 * k * M_PI), std::sin(0.8 * k * M_PI), 0});
  CHECK(outcome(star) == Outcome::NotSimple);  // goes round twice
  const Polygon twice = {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {0, 0, 0}, {3, 1, 0}, {4, 4, 0}, {1, 3, 0}};
  CHECK(outcome(twice) == Outcome::NotSimple);  // the same, touching itself at a corner
}

TEST_CASE("polygons of many corners are cut or refused within bounds") {
  check_tiling(comb(300));
  CHECK(outcome(comb(PolygonCutter::kMostCorners / 4 - 1)) == Outcome::Cut);
  CHECK(outcome(comb(PolygonCutter::kMostCorners / 4 + 1)) == Outcome::TooManyCorners);
  Polygon lying = comb(PolygonCutter::kMostCorners / 4 - 1);
  for (Vec3& p : lying) std::swap(p.x(), p.y());
  CHECK(outcome(lying) == Outcome::Cut);
  Polygon disc;
  for (int k = 0; k < 200000; ++k) disc.push_back({std::cos(1e-5 * k * M_PI), std::sin(1e-5 * k * M_PI), 0});
  CHECK(outcome(disc) == Outcome::Cut);
}

TEST_CASE("concave polygons have their area in every format") {
  const std::string corners = "0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n";
  std::string obj;
  for (const char* v : {"0 0 0", "2 0 0", "2 1 0", "1 1 0", "1 2 0", "0 2 0"}) obj += "v " + std::string(v) + "\n";
  CHECK(area_of(MeshFormat::Obj, obj + "f 3 4 5 6 1 2\n") == Approx(3.0));
  CHECK(area_of(MeshFormat::Off, "OFF\n6 1 0\n" + corners + "6 2 3 4 5 0 1\n") == Approx(3.0));
  CHECK(area_of(MeshFormat::Ply,
                "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
                "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
                    corners + "6 2 3 4 5 0 1\n") == Approx(3.0));
}

TEST_CASE("faults: concave polygons of public reports") {
  const std::string root = shared_meshes();
  if (root.empty()) return;
  CHECK(surface_area(read_mesh(root + "/faults/L_fold.obj")) == Approx(3.0));
  CHECK(surface_area(read_mesh(root + "/faults/dart_fold.obj")) == Approx(0.5));
  for (const char* name : {"obj_comb.obj", "off_comb.off"}) {
    INFO(name);
    // Two combs of six teeth 1 x 4 on a bar 11 x 1, and walls of height 1 along an outline of 72.
    CHECK(surface_area(read_mesh(root + "/faults/" + name)) == Approx(2.0 * (11.0 + 24.0) + 72.0));
  }
}

TEST_CASE("a polygon that cannot be cut is named by its number in the file") {
  const auto place = [](MeshFormat format, const std::string& bytes) {
    try {
      parse_surface(format, bytes);
    } catch (const Error& error) {
      CHECK(error.cause() == Cause::PolygonNotSimple);
      CHECK(error.element() == Element::Face);
      return error.index().value_or(-1);
    }
    FAIL("no error");
    return -1LL;
  };
  CHECK(place(MeshFormat::Obj, "v 0 0 0\nv 4 1 0\nv 4 0 0\nv 0 3 0\nf 1 2 3\nf 1 3 4\nf 1 2 3 4\n") == 3);
  CHECK(place(MeshFormat::Off, "OFF\n4 2 0\n0 0 0\n4 1 0\n4 0 0\n0 3 0\n3 0 1 2\n4 0 1 2 3\n") == 1);
}

#include "experiments/report/paper.h"

#include <cmath>

#include "mesh/io.h"

namespace gsp {

namespace {

struct Published {
  int vertices, faces;
  double spread;  // measured on the models that have these counts
  double remesh_error;
};

constexpr Published kTable1[] = {{50002, 100000, 0.0751068, 3.55e-5},  // Venus
                                 {34835, 69473, 0.0738837, 4.22e-5},   // bunny
                                 {48485, 96966, 0.1107699, 5.16e-5},   // horse
                                 {49864, 99732, 0.0808165, 3.54e-5}};  // feline

// Coordinates in single precision change the spread by 1e-7 of itself. The bunny before its loose vertices and small
// faults are taken away differs by 1.3e-3.
constexpr double kSpreadTolerance = 1e-4;

const Published* with_counts(int vertices, int faces) {
  for (const Published& row : kTable1)
    if (row.vertices == vertices && row.faces == faces) return &row;
  return nullptr;
}

}  // namespace

std::optional<double> relative_spread(const Mesh& surface) {
  double area = 0.0;
  Vec3 first = Vec3::Zero();
  for (int f = 0; f < surface.face_count(); ++f) {
    const Triangle& t = surface.faces[f];
    const double a = face_area(surface, f);
    area += a;
    first += a / 3.0 * (surface.positions[t[0]] + surface.positions[t[1]] + surface.positions[t[2]]);
  }
  if (!(area > 0.0)) return std::nullopt;
  const Vec3 centroid = first / area;
  double second = 0.0;
  for (int f = 0; f < surface.face_count(); ++f) {
    Vec3 sum = Vec3::Zero();
    double squares = 0.0;
    for (int v : surface.faces[f]) {
      const Vec3 p = surface.positions[v] - centroid;
      sum += p;
      squares += p.squaredNorm();
    }
    // The integral of a squared length over a triangle from its corners and their sum.
    second += face_area(surface, f) / 12.0 * (squares + sum.squaredNorm());
  }
  return second / (area * area);
}

std::optional<double> paper_remesh_error(const Mesh& surface) {
  const Published* row = with_counts(surface.vertex_count(), surface.face_count());
  if (!row) return std::nullopt;
  const std::optional<double> spread = relative_spread(surface);
  if (!spread || std::abs(*spread / row->spread - 1.0) > kSpreadTolerance) return std::nullopt;
  return row->remesh_error;
}

std::optional<double> paper_remesh_error(const StoredModel& model) {
  if (model.path.empty() || !with_counts(model.vertices, model.faces)) return std::nullopt;
  return paper_remesh_error(read_mesh(model.path));
}

}  // namespace gsp

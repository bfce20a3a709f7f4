#include "param/repair.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <lbfgs.h>

#include "mesh/error.h"
#include "param/folds.h"

namespace gsp {

namespace {

constexpr double kFlattestReference = 0.05; // height over longest side of a reference triangle
constexpr double kAreaWeight = 0.02;        // λ
constexpr int kRings[] = {1, 2, 4, 8};
constexpr int kOuterSteps = 12;
constexpr double kSharpening = 0.5;  // of ε, from one step to the next
constexpr int kInnerSteps = 50;
constexpr int kPolishSteps = 30;

bool positive(const std::array<Complex, 3>& z) { return upright(z[0], z[1], z[2]); }

/// The triangle laid into the plane, kept away from degenerate shapes.
Eigen::Matrix2d reference_shape(const Mesh& mesh, const Triangle& t, double mean_length) {
  const Vec3 a = mesh.positions[t[1]] - mesh.positions[t[0]], b = mesh.positions[t[2]] - mesh.positions[t[0]];
  const double longest = std::max({a.norm(), b.norm(), (b - a).norm(), 1e-3 * mean_length});
  const double floor = kFlattestReference * longest;
  const double base = std::max(a.norm(), floor);
  Eigen::Matrix2d shape;
  const double along = a.norm() > 0.0 ? a.dot(b) / a.norm() : 0.0;
  const double height = a.norm() > 0.0 ? a.cross(b).norm() / a.norm() : b.norm();
  shape << base, along, 0.0, std::max(height, floor);
  return shape;
}

/// The energy over one disc, as the optimiser sees it.
class Disc {
 public:
  Disc(Atlas& atlas, std::vector<int> vertices, std::vector<int> faces, double area_weight = kAreaWeight)
      : atlas_(atlas), vertices_(std::move(vertices)), area_weight_(area_weight) {
    std::vector<std::pair<int, int>> sorted;
    for (std::size_t i = 0; i < vertices_.size(); ++i) sorted.emplace_back(vertices_[i], static_cast<int>(i));
    std::sort(sorted.begin(), sorted.end());
    const auto variable = [&](int v) {
      const auto at = std::lower_bound(sorted.begin(), sorted.end(), std::make_pair(v, 0));
      return at != sorted.end() && at->first == v ? at->second : -1;
    };
    const Mesh& mesh = atlas.surface->mesh;
    double length = 0.0, chart = 0.0, area = 0.0;
    for (int f : faces) {
      length += (mesh.positions[mesh.faces[f][1]] - mesh.positions[mesh.faces[f][0]]).norm() / faces.size();
    }
    for (int f : faces) {
      Face face;
      const Atlas::FaceFrame frame = atlas.face_frame(f);
      for (int k = 0; k < 3; ++k) {
        face.variable[k] = variable(mesh.faces[f][k]);
        face.turn[k] = omega_power(frame.to_chart[k].rotation);
        face.shift[k] = frame.to_chart[k].translation.value();
        face.held[k] = frame.to_chart[k].apply(atlas.position[mesh.faces[f][k]]);
      }
      const Eigen::Matrix2d shape = reference_shape(mesh, mesh.faces[f], length);
      face.inverse = shape.inverse();
      face.weight = 0.5 * shape.determinant();
      area += face.weight;
      chart += chart_area(face.held[0], face.held[1], face.held[2]);
      faces_.push_back(face);
    }
    const double scale = std::sqrt(std::max(chart, 1e-12) / area);  // the reference as large as the disc's image
    for (Face& face : faces_) {
      face.inverse /= scale;
      face.weight /= area;
    }
  }

  bool untangle() {
    load();
    double least = least_determinant();
    epsilon_ = 1.0;
    for (int step = 0; step < kOuterSteps && !(least > 0.0); ++step) {
      // As Garanzha et al. choose it, but never slower than geometrically: a step that gains nothing sharpens the barrier.
      epsilon_ = std::max(std::min(kSharpening * epsilon_, std::sqrt(1e-18 + 0.04 * least * least)), 1e-7);
      minimise(kInnerSteps);
      least = least_determinant();
    }
    if (!(least > 0.0)) return false;
    epsilon_ = 1e-9;
    const std::vector<double> valid = x_;
    minimise(kPolishSteps);
    if (!all_positive()) x_ = valid;
    return all_positive();
  }

  /// From a map free of folds to one of less energy.
  bool polish(int steps) {
    load();
    epsilon_ = 1e-9;
    minimise(steps);
    return all_positive();
  }

  void write_back() {
    for (std::size_t i = 0; i < vertices_.size(); ++i) atlas_.position[vertices_[i]] = {x_[2 * i], x_[2 * i + 1]};
  }

 private:
  struct Face {
    int variable[3];          ///< -1 where held
    Complex turn[3], shift[3];  ///< from the vertex's chart to the face's
    Complex held[3];
    Eigen::Matrix2d inverse;  ///< of the reference's edge matrix
    double weight;
  };

  std::array<Complex, 3> corners(const Face& face, const double* x) const {
    std::array<Complex, 3> z;
    for (int k = 0; k < 3; ++k)
      z[k] = face.variable[k] < 0
                 ? face.held[k]
                 : face.turn[k] * Complex(x[2 * face.variable[k]], x[2 * face.variable[k] + 1]) + face.shift[k];
    return z;
  }

  static Eigen::Matrix2d jacobian(const Face& face, const std::array<Complex, 3>& z) {
    Eigen::Matrix2d edges;
    edges << z[1].real() - z[0].real(), z[2].real() - z[0].real(), z[1].imag() - z[0].imag(), z[2].imag() - z[0].imag();
    return edges * face.inverse;
  }

  double least_determinant() const {
    double least = 1e300;
    for (const Face& face : faces_) least = std::min(least, jacobian(face, corners(face, x_.data())).determinant());
    return least;
  }

  bool all_positive() const {
    return std::all_of(faces_.begin(), faces_.end(), [&](const Face& f) { return positive(corners(f, x_.data())); });
  }

  double evaluate(const double* x, double* gradient) const {
    std::fill(gradient, gradient + x_.size(), 0.0);
    double energy = 0.0;
    for (const Face& face : faces_) {
      const auto z = corners(face, x);
      const Complex e1 = z[1] - z[0], e2 = z[2] - z[0];
      // J = [e1 e2]·inverse, whose lower left entry is 0.
      const double i00 = face.inverse(0, 0), i01 = face.inverse(0, 1), i11 = face.inverse(1, 1);
      const Complex j1 = i00 * e1, j2 = i01 * e1 + i11 * e2;
      const double det = cross(j1, j2), square = std::norm(j1) + std::norm(j2);
      const double root = std::sqrt(epsilon_ * epsilon_ + det * det);
      const double chi = det > 0.0 ? 0.5 * (det + root) : 0.5 * epsilon_ * epsilon_ / (root - det);
      const double shape = 0.5 * square / chi, area = 0.5 * area_weight_ * (det * det + 1.0) / chi;
      energy += face.weight * (shape + area);
      // dχ/d det = χ / root, and d det / dJ is the cofactor matrix (-i·j2, i·j1).
      const double by_det = area_weight_ * det / chi - (shape + area) / root;
      const Complex g1 = face.weight * (j1 / chi + by_det * Complex(j2.imag(), -j2.real()));
      const Complex g2 = face.weight * (j2 / chi + by_det * Complex(-j1.imag(), j1.real()));
      const Complex d1 = i00 * g1 + i01 * g2, d2 = i11 * g2;
      const Complex by_corner[3] = {-d1 - d2, d1, d2};
      for (int k = 0; k < 3; ++k) {
        if (face.variable[k] < 0) continue;
        const Complex g = std::conj(face.turn[k]) * by_corner[k];
        gradient[2 * face.variable[k]] += g.real();
        gradient[2 * face.variable[k] + 1] += g.imag();
      }
    }
    return energy;
  }

  void load() {
    x_.resize(2 * vertices_.size());
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      x_[2 * i] = atlas_.position[vertices_[i]].real();
      x_[2 * i + 1] = atlas_.position[vertices_[i]].imag();
    }
  }

  void minimise(int steps) {
    lbfgs_parameter_t parameters;
    lbfgs_parameter_init(&parameters);
    parameters.max_iterations = steps;
    parameters.epsilon = 1e-7;
    parameters.past = 10;
    parameters.delta = 1e-5;
    parameters.linesearch = LBFGS_LINESEARCH_BACKTRACKING_ARMIJO;
    parameters.max_linesearch = 60;
    double energy = 0.0;
    const auto call = [](void* self, const double* x, double* g, const int, const double) {
      return static_cast<const Disc*>(self)->evaluate(x, g);
    };
    std::vector<double> x = x_;
    lbfgs(static_cast<int>(x.size()), x.data(), &energy, call, nullptr, this, &parameters);
    if (std::all_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); })) x_ = x;
  }

  Atlas& atlas_;
  std::vector<int> vertices_;
  std::vector<Face> faces_;
  double area_weight_;
  std::vector<double> x_;
  double epsilon_ = 1.0;
};

class Repair {
 public:
  Repair(Atlas& atlas, Progress& progress) : atlas_(atlas), surface_(*atlas.surface), progress_(progress) {}

  RepairReport run() {
    RepairReport report;
    Folds folds = find_folds(atlas_);
    report.flipped_before = static_cast<int>(folds.faces.size());
    for (int rings : kRings) {
      if (folds.none()) break;
      untangle_all(folds, rings, report);
      folds = find_folds(atlas_);
    }
    std::sort(report.moved.begin(), report.moved.end());
    report.moved.erase(std::unique(report.moved.begin(), report.moved.end()), report.moved.end());
    return report;
  }

 private:
  bool is_free(int v) const { return atlas_.corner[v] < 0 && !surface_.halfedges.boundary_vertex(v); }

  void untangle_all(const Folds& folds, int rings, RepairReport& report) {
    // Rings of vertices around the folded faces; those that meet form one disc.
    std::vector<int> distance(surface_.mesh.positions.size(), -1);
    std::vector<int> reached;
    const auto start = [&](int v) {
      if (distance[v] >= 0) return;
      distance[v] = 0;
      reached.push_back(v);
    };
    for (int f : folds.faces)
      for (int v : surface_.mesh.faces[f]) start(v);
    for (int v : folds.vertices) start(v);
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const int v = reached[i];
      if (distance[v] >= rings) continue;
      surface_.for_each_neighbour(v, [&](int w, int, bool) {
        if (distance[w] >= 0) return;
        distance[w] = distance[v] + 1;
        reached.push_back(w);
      });
    }
    std::vector<char> taken(distance.size(), 0);
    for (int seed : reached) {
      if (taken[seed]) continue;
      std::vector<int> region{seed};
      taken[seed] = 1;
      for (std::size_t i = 0; i < region.size(); ++i)
        surface_.for_each_neighbour(region[i], [&](int w, int, bool) {
          if (distance[w] < 0 || taken[w]) return;
          taken[w] = 1;
          region.push_back(w);
        });
      untangle(region, report);
      progress_.report("repair", 0.5);
    }
  }

  void untangle(const std::vector<int>& region, RepairReport& report) {
    std::vector<int> vertices, faces;
    for (int v : region) {
      if (!is_free(v)) continue;
      vertices.push_back(v);
      const int start = surface_.halfedges.outgoing[v];
      int h = start;
      do {
        faces.push_back(Halfedges::face(h));
        h = surface_.halfedges.rotate_ccw(h);
      } while (h != start);
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    if (vertices.empty()) return;
    std::vector<Complex> before;
    for (int v : vertices) before.push_back(atlas_.position[v]);
    Disc disc(atlas_, vertices, faces);
    if (!disc.untangle()) return;
    disc.write_back();
    std::vector<int> touched;
    for (int f : faces)
      for (int v : surface_.mesh.faces[f]) touched.push_back(v);
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    // Beyond the rim faces may still be folded.
    const bool miswound = std::any_of(touched.begin(), touched.end(),
                                      [&](int v) { return local_map(atlas_, v) == LocalMap::Miswound; });
    if (miswound) {
      for (std::size_t i = 0; i < vertices.size(); ++i) atlas_.position[vertices[i]] = before[i];
      return;
    }
    ++report.regions;
    report.moved.insert(report.moved.end(), vertices.begin(), vertices.end());
  }

  Atlas& atlas_;
  const Surface& surface_;
  Progress& progress_;
};

}  // namespace

RepairReport repair_folds(Atlas& atlas, Progress& progress) { return Repair(atlas, progress).run(); }

bool lower_distortion(Atlas& atlas, int steps) {
  std::vector<int> vertices, faces(atlas.surface->mesh.faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) faces[f] = static_cast<int>(f);
  for (std::size_t v = 0; v < atlas.patch.size(); ++v)
    if (atlas.patch[v] >= 0 && atlas.corner[v] < 0 && !atlas.surface->halfedges.boundary_vertex(static_cast<int>(v))) vertices.push_back(v);
  const std::vector<Complex> before = atlas.position;
  Disc disc(atlas, vertices, faces, getenv("LAM") ? atof(getenv("LAM")) : 0.5);
  bool good = disc.polish(steps);
  if (good) { disc.write_back(); good = find_folds(atlas).none(); if (!good) atlas.position = before; }
  if (good) for (int v : vertices) atlas.reassign(v);
  return good;
}

}  // namespace gsp

#include "coder/wavelet_transform.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "coder/codec.h"
#include "coder/loop_high_pass.h"
#include "remesh/filters/butterfly_low_pass.h"
#include "remesh/filters/loop_low_pass.h"
#include "tests/coder/sample_meshes.h"

using namespace gsp;

namespace {

std::vector<SubdivisionLevel> levels_of(const Mesh& base, int level) {
  return subdivision_levels(base.vertex_count(), base.faces, level);
}

/// From the vertices of a level to those of the next, and from its edges.
SparseMatrix low_pass_matrix(const Filter& filter) {
  const int vertices = filter.level().vertex_count;
  return filter.matrix(vertices + filter.level().edge_count(), vertices);
}
SparseMatrix high_pass_matrix(const Filter& filter) {
  const int edges = filter.level().edge_count();
  return filter.matrix(filter.level().vertex_count + edges, edges);
}

/// Two cones over a ring of k vertices: closed, with two vertices of valence k and k of valence 4.
Mesh bipyramid(int k) {
  Mesh mesh;
  mesh.positions.resize(k + 2, Vec3::Zero());
  for (int i = 0; i < k; ++i) {
    mesh.faces.push_back({i, (i + 1) % k, k});
    mesh.faces.push_back({(i + 1) % k, i, k + 1});
  }
  return mesh;
}

/// Of the synthesis of one step, its columns made equally long.
double condition(const std::vector<SubdivisionLevel>& levels, Wavelet wavelet) {
  const WaveletTransform transform(levels, wavelet);
  const int last = static_cast<int>(levels.size()) - 1;
  const int size = levels[last].vertex_count + levels[last].edge_count();
  Eigen::MatrixXd both(size, size);
  // Three columns at a time, one in each coordinate.
  for (int i = 0; i < size; i += 3) {
    std::vector<Vec3> units(size, Vec3::Zero());
    for (int k = 0; k < 3 && i + k < size; ++k) units[i + k][k] = 1.0;
    const auto middle = units.begin() + levels[last].vertex_count;
    const std::vector<Vec3> columns = transform.synthesis(last, {units.begin(), middle}, {middle, units.end()});
    for (int k = 0; k < 3 && i + k < size; ++k)
      for (int r = 0; r < size; ++r) both(r, i + k) = columns[r][k];
  }
  both.colwise().normalize();
  const Eigen::MatrixXd gram = both.transpose() * both;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram, Eigen::EigenvaluesOnly);
  const Eigen::VectorXd squares = solver.eigenvalues();
  return std::sqrt(squares(size - 1) / squares(0));
}

double rms(const std::vector<Vec3>& values) {
  double sum = 0.0;
  for (const Vec3& v : values) sum += v.squaredNorm();
  return std::sqrt(sum / values.size());
}

/// RMS of the details of each level, coarse to fine.
std::vector<double> detail_sizes(const SemiregularMesh& mesh) {
  const WaveletTransform transform(subdivision_levels(mesh.base_vertices, mesh.base_faces, mesh.level - 1));
  std::vector<double> sizes(mesh.level);
  std::vector<Vec3> positions = mesh.positions;
  for (int l = mesh.level - 1; l >= 0; --l) {
    WaveletTransform::Split split = transform.analysis(l, positions);
    sizes[l] = rms(split.details);
    positions = std::move(split.coarse);
  }
  return sizes;
}

}  // namespace

TEST_CASE("filters sum to one and to zero on every base, boundaries and odd valences included") {
  for (const Mesh& base : {shapes::tetrahedron(), shapes::grid(2, 3), shapes::lattice_torus(5, 4), bipyramid(9),
                           shapes::sector_disc(5, 1)})
    for (const SubdivisionLevel& level : levels_of(base, 2)) {
      const SparseMatrix low = low_pass_matrix(*loop_low_pass(level)), high = high_pass_matrix(*loop_high_pass(level));
      CHECK((low * Eigen::VectorXd::Ones(low.cols()) - Eigen::VectorXd::Ones(low.rows())).cwiseAbs().maxCoeff() <
            1e-14);
      CHECK((high.transpose() * Eigen::VectorXd::Ones(high.rows())).cwiseAbs().maxCoeff() < 1e-14);
    }
}

TEST_CASE(
    "the regular high-pass is the 19-tap quadrature mirror of Loop's mask, nearly orthogonal to the coarse space") {
  const SubdivisionLevel level = levels_of(shapes::lattice_torus(8, 8), 0)[0];
  const SparseMatrix low = low_pass_matrix(*loop_low_pass(level)), high = high_pass_matrix(*loop_high_pass(level));
  for (int e = 0; e < high.cols(); ++e) {
    std::vector<double> taps;
    for (int r = 0; r < high.rows(); ++r)
      if (high.coeff(r, e) != 0.0) taps.push_back(16 * high.coeff(r, e));
    std::sort(taps.begin(), taps.end());
    CHECK(taps == std::vector<double>{-6, -6, -6, -6, -2, -2, -2, -2, 1, 1, 1, 1, 1, 1, 2, 2, 6, 6, 10});
  }
}

TEST_CASE("the synthesis of every wavelet is well conditioned at every valence and beside boundaries", "[slow]") {
  struct Bound {
    Wavelet wavelet;
    double lattice, anywhere;
  };
  for (const Bound& bound : {Bound{Wavelet::Loop, 4.2, 6.0}, Bound{Wavelet::Loop11, 5.7, 8.0},
                             Bound{Wavelet::Butterfly, 3.9, 6.0}, Bound{Wavelet::ButterflyLifted, 2.4, 5.0}}) {
    INFO(wavelet_name(bound.wavelet));
    CHECK(condition(levels_of(shapes::lattice_torus(8, 8), 0), bound.wavelet) < bound.lattice);
    for (int valence = 3; valence <= 12; ++valence) {
      CHECK(condition(levels_of(bipyramid(valence), 1), bound.wavelet) < bound.anywhere);
      CHECK(condition(levels_of(shapes::sector_disc(valence, 0), 1), bound.wavelet) < bound.anywhere);
    }
    CHECK(condition(levels_of(shapes::grid(5, 5), 0), bound.wavelet) < bound.anywhere);
  }
}

TEST_CASE("Butterfly reproduces constants everywhere and quadratics between regular vertices") {
  for (const Mesh& base : {shapes::sector_disc(5, 1), shapes::grid(3, 4), shapes::sector_disc(6, 3)}) {
    const SubdivisionLevel level = levels_of(base, 0)[0];
    const SparseMatrix low = low_pass_matrix(*butterfly_low_pass(level));
    CHECK((low * Eigen::VectorXd::Ones(low.cols()) - Eigen::VectorXd::Ones(low.rows())).cwiseAbs().maxCoeff() < 1e-14);
  }
  const Mesh disc = shapes::sector_disc(6, 3);
  const SubdivisionLevel level = levels_of(disc, 0)[0];
  const SparseMatrix low = low_pass_matrix(*butterfly_low_pass(level));
  for (int e = 0; e < level.edge_count(); ++e) {
    const Vec3 middle = (disc.positions[level.edges[e][0]] + disc.positions[level.edges[e][1]]) / 2;
    if (middle.norm() > 0.5) continue;  // beside the boundary only constants are reproduced
    Vec3 sum = Vec3::Zero();
    double square = 0.0;
    for (SparseMatrix::InnerIterator it(low, level.vertex_count + e); it; ++it) {
      sum += it.value() * disc.positions[it.col()];
      square += it.value() * disc.positions[it.col()].x() * disc.positions[it.col()].x();
    }
    CHECK((sum - middle).norm() < 1e-14);
    CHECK(square == Approx(middle.x() * middle.x()).margin(1e-14));
  }
}

TEST_CASE("analysis and synthesis invert each other to rounding") {
  for (const SemiregularMesh& mesh : {samples::noise(shapes::tetrahedron(), 4), samples::noise(shapes::grid(3, 2), 3),
                                      samples::noise(shapes::torus(5, 4), 3), samples::bumpy_sphere(4)}) {
    for (Wavelet wavelet : kWavelets) {
      const WaveletTransform transform(subdivision_levels(mesh.base_vertices, mesh.base_faces, mesh.level - 1),
                                       wavelet);
      const WaveletTransform::Split split = transform.analysis(mesh.level - 1, mesh.positions);
      const std::vector<Vec3> back = transform.synthesis(mesh.level - 1, split.coarse, split.details);
      double worst = 0.0;
      for (std::size_t v = 0; v < back.size(); ++v) worst = std::max(worst, (back[v] - mesh.positions[v]).norm());
      CHECK(worst < 1e-12);
    }
  }
}

TEST_CASE("the low-pass reproduces linear functions on a regular lattice, so these have no details") {
  // The inverse is unique: what P alone makes has d = 0.
  const Mesh base = shapes::sector_disc(6, 2);
  const SubdivisionLevel level = levels_of(base, 0)[0];
  std::vector<bool> boundary(level.vertex_count, false);
  for (int e = 0; e < level.edge_count(); ++e)
    if (level.edge_faces[e][1] < 0) boundary[level.edges[e][0]] = boundary[level.edges[e][1]] = true;
  const SparseMatrix low = low_pass_matrix(*loop_low_pass(level));
  std::vector<Vec3> fine(low.rows(), Vec3::Zero());
  for (int r = 0; r < low.rows(); ++r)
    for (SparseMatrix::InnerIterator it(low, r); it; ++it) fine[r] += it.value() * base.positions[it.col()];
  for (int v = 0; v < level.vertex_count; ++v)
    if (!boundary[v]) CHECK((fine[v] - base.positions[v]).norm() < 1e-14);
  for (int e = 0; e < level.edge_count(); ++e) {
    const auto [a, b] = level.edges[e];
    if (!boundary[a] || !boundary[b])
      CHECK((fine[level.vertex_count + e] - (base.positions[a] + base.positions[b]) / 2).norm() < 1e-14);
  }
}

TEST_CASE("details of a smooth surface decay with the level") {
  // C2 parameters would give a factor of 8 and more; inside each patch of this base they are smooth, across edges only
  // C0.
  const std::vector<double> torus = detail_sizes([] {
    constexpr int kColumns = 6, kRows = 6;
    SemiregularMesh flat = samples::refine(shapes::lattice_torus(kColumns, kRows), 0, [](const Vec3& p) { return p; });
    flat.level = 4;
    // Lattice coordinates of every vertex, carried along the edges so that the wrap-around does not matter.
    const auto levels = subdivision_levels(flat.base_vertices, flat.base_faces, flat.level);
    std::vector<Eigen::Vector2d> lattice;
    for (int v = 0; v < flat.base_vertices; ++v) lattice.emplace_back(v % kColumns, v / kColumns);
    for (int l = 0; l < flat.level; ++l)
      for (const auto& [a, b] : levels[l].edges) {
        Eigen::Vector2d step = lattice[b] - lattice[a];
        for (int k = 0; k < 2; ++k) step[k] -= kColumns * std::round(step[k] / kColumns);
        lattice.push_back(lattice[a] + step / 2);
      }
    flat.positions.clear();
    for (const Eigen::Vector2d& p : lattice) {
      const double u = 2 * M_PI * p.x() / kColumns, v = 2 * M_PI * p.y() / kRows;
      flat.positions.emplace_back((2 + std::cos(v)) * std::cos(u), (2 + std::cos(v)) * std::sin(u), std::sin(v));
    }
    return flat;
  }());
  for (std::size_t l = 1; l < torus.size(); ++l) CHECK(torus[l] < torus[l - 1] / 10.0);
  const std::vector<double> sphere = detail_sizes(samples::bumpy_sphere(5));
  for (std::size_t l = 2; l < sphere.size(); ++l) CHECK(sphere[l] < sphere[l - 1] / 2.0);
}

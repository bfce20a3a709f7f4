#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <map>
#include <numeric>

#include "coder/codec.h"
#include "coder/coded_order.h"
#include "coder/loop_high_pass.h"
#include "coder/wavelet_transform.h"
#include "metrics/surface_distance.h"
#include "remesh/filters/butterfly_low_pass.h"
#include "remesh/filters/butterfly_update.h"
#include "remesh/filters/loop_low_pass.h"
#include "tests/coder/crease_meshes.h"

using namespace gsp;

namespace {

Progress quiet;

/// A level cut open along its creases: a vertex for each part of the faces around one.
struct CutLevel {
  SubdivisionLevel level;
  std::vector<int> source;  ///< #V, the vertex that each is a part of

  explicit CutLevel(const SubdivisionLevel& whole) {
    std::vector<int> part(3 * whole.faces.size());
    std::iota(part.begin(), part.end(), 0);
    const auto root = [&](int c) {
      while (part[c] != c) c = part[c];
      return c;
    };
    const auto corner = [&](int f, int v) {
      for (int k = 0; k < 3; ++k)
        if (whole.faces[f][k] == v) return 3 * f + k;
      return -1;
    };
    for (int e = 0; e < whole.edge_count(); ++e)
      if (!whole.sharp(e))
        for (int v : whole.edges[e])
          part[root(corner(whole.edge_faces[e][0], v))] = root(corner(whole.edge_faces[e][1], v));
    std::map<int, int> number;
    std::vector<Triangle> faces = whole.faces;
    for (std::size_t c = 0; c < part.size(); ++c) {
      const auto [at, is_new] = number.try_emplace(root(static_cast<int>(c)), static_cast<int>(number.size()));
      if (is_new) source.push_back(whole.faces[c / 3][c % 3]);
      faces[c / 3][c % 3] = at->second;
    }
    level = base_level(static_cast<int>(source.size()), faces);
  }
};

std::vector<Vec3> random_points(std::size_t count) {
  Random random(5);
  std::vector<Vec3> points(count);
  for (Vec3& p : points)
    for (int k = 0; k < 3; ++k) p[k] = random.uniform();
  return points;
}

template <class Make>
std::vector<Vec3> low_passed(Make make, const SubdivisionLevel& level, const std::vector<Vec3>& points) {
  std::vector<Vec3> fine(level.vertex_count + level.edge_count(), Vec3::Zero());
  make(level)->add(points.data(), fine.data());
  return fine;
}

SemiregularMesh with_random_creases(const Mesh& base, int level, double share) {
  SemiregularMesh mesh = samples::noise(base, level);
  Random random(23);
  const SubdivisionLevel flat = base_level(mesh.base_vertices, mesh.base_faces);
  for (int e = 0; e < flat.edge_count(); ++e)
    if (!flat.on_boundary(e) && random.uniform() < share)
      mesh.creases.push_back(
          {std::min(flat.edges[e][0], flat.edges[e][1]), std::max(flat.edges[e][0], flat.edges[e][1])});
  std::sort(mesh.creases.begin(), mesh.creases.end());
  return mesh;
}

std::vector<SubdivisionLevel> detail_levels(const SemiregularMesh& mesh) {
  std::vector<SubdivisionLevel> levels = mesh.levels();
  levels.pop_back();
  return levels;
}

struct Analysis {
  std::vector<std::vector<Vec3>> points, details;
};
Analysis analyse(const SemiregularMesh& mesh, Wavelet wavelet) {
  const WaveletTransform transform(detail_levels(mesh), wavelet);
  Analysis result{std::vector<std::vector<Vec3>>(mesh.level + 1), std::vector<std::vector<Vec3>>(mesh.level)};
  result.points[mesh.level] = mesh.positions;
  for (int l = mesh.level - 1; l >= 0; --l) {
    WaveletTransform::Split split = transform.analysis(l, result.points[l + 1]);
    result.points[l] = split.coarse;
    result.details[l] = split.details;
  }
  return result;
}

double largest(const std::vector<Vec3>& a) {
  double most = 0.0;
  for (const Vec3& p : a) most = std::max(most, p.cwiseAbs().maxCoeff());
  return most;
}

}  // namespace

TEST_CASE("filters along creases are those of the boundaries of the surface cut there") {
  for (const SemiregularMesh& mesh : {samples::cylinder(5, 3), samples::lens(3)})
    for (const SubdivisionLevel& whole : mesh.levels()) {
      const CutLevel cut(whole);
      REQUIRE(cut.level.vertex_count > whole.vertex_count);
      const std::vector<Vec3> points = random_points(whole.vertex_count);
      std::vector<Vec3> parts;
      for (int v : cut.source) parts.push_back(points[v]);
      for (const auto& make : {loop_low_pass, butterfly_low_pass}) {
        const std::vector<Vec3> fine = low_passed(make, whole, points), cut_fine = low_passed(make, cut.level, parts);
        double farthest = 0.0;
        for (int v = 0; v < cut.level.vertex_count; ++v)
          farthest = std::max(farthest, (cut_fine[v] - fine[cut.source[v]]).norm());
        for (int f = 0; f < whole.face_count(); ++f)
          for (int k = 0; k < 3; ++k)
            farthest = std::max(farthest, (cut_fine[cut.level.vertex_count + cut.level.face_edges[f][k]] -
                                           fine[whole.vertex_count + whole.face_edges[f][k]])
                                              .norm());
        CHECK(farthest < 1e-14);
      }
    }
}

TEST_CASE("filters with any creases sum to one and to zero") {
  for (const Mesh& base : {shapes::icosahedron(), shapes::grid(3, 4), shapes::torus(5, 4)})
    for (double share : {0.2, 0.5, 1.0})
      for (const SubdivisionLevel& level : with_random_creases(base, 2, share).levels()) {
        const int vertices = level.vertex_count, edges = level.edge_count();
        const std::vector<Vec3> ones(std::max(vertices, edges), Vec3::Ones());
        for (const auto& make : {loop_low_pass, butterfly_low_pass})
          for (const Vec3& p : low_passed(make, level, ones)) CHECK((p - Vec3::Ones()).norm() < 1e-13);
        const SparseMatrix high = loop_high_pass(level)->matrix(vertices + edges, edges);
        const Eigen::VectorXd sums = high.transpose() * Eigen::VectorXd::Ones(high.rows());
        // Between corners alone a detail moves its own vertex, and nothing can be taken off others.
        for (int e = 0; e < edges; ++e) CHECK((std::abs(sums[e]) < 1e-13 || high.col(e).head(vertices).norm() == 0.0));
      }
}

TEST_CASE("a flat-sided body has no details where its edges are creases, whatever the wavelet") {
  const SemiregularMesh cube = samples::creased_cube(4);
  REQUIRE(cube.creases.size() == 12);
  for (Wavelet wavelet : kWavelets) {
    INFO(wavelet_name(wavelet));
    const Analysis analysis = analyse(cube, wavelet);
    for (const auto& details : analysis.details) CHECK(largest(details) < 1e-11);
    EncodeOptions options;
    options.wavelet = wavelet;
    options.precision_bits = 20;
    const Bytes stream = encode(cube, options, quiet);
    const SemiregularMesh decoded = decode(stream, stream.size());
    CHECK(stream.size() < 160);
    const std::vector<int> order = [&] {
      Bytes unused;
      return coded_vertex_order(cube, encode_connectivity(cube.base_faces, unused));
    }();
    double farthest = 0.0;
    for (std::size_t v = 0; v < order.size(); ++v)
      farthest = std::max(farthest, (decoded.positions[v] - cube.positions[order[v]]).norm());
    CHECK(farthest < 1e-5);
  }
}

TEST_CASE("a crease that bends in its corners alone has no details, and streams hold the corners") {
  const SemiregularMesh pillow = samples::pillow(4);
  REQUIRE(pillow.corners.size() == 4);
  for (Wavelet wavelet : kWavelets) {
    INFO(wavelet_name(wavelet));
    for (const auto& details : analyse(pillow, wavelet).details) CHECK(largest(details) < 1e-11);
    SemiregularMesh round = pillow;
    round.corners.clear();
    CHECK(largest(analyse(round, wavelet).details[0]) > 0.01);
    EncodeOptions options;
    options.wavelet = wavelet;
    const Bytes stream = encode(pillow, options, quiet);
    const SemiregularMesh decoded = decode(stream, stream.size());
    CHECK(decoded.corners.size() == 4);
    for (int v : decoded.corners)
      CHECK((decoded.positions[v] - Vec3(0.5, 0.5, 0)).norm() == Approx(std::sqrt(0.5)).margin(1e-3));
  }
}

TEST_CASE("what lies on one side of a crease moves neither the crease nor what lies on the other") {
  const auto dented = [](const Vec3& p) {
    return Vec3(p + 0.2 * std::sin(5 * p.x()) * std::cos(7 * p.z()) * Vec3(p.x(), p.y(), 0.0));
  };
  const SemiregularMesh plain = samples::cylinder(6, 4), other = samples::cylinder(6, 4, dented);
  REQUIRE(plain.creases.size() == 12);
  const auto levels = plain.levels();
  for (Wavelet wavelet : kWavelets) {
    INFO(wavelet_name(wavelet));
    const Analysis a = analyse(plain, wavelet), b = analyse(other, wavelet);
    for (int l = 0; l < plain.level; ++l) {
      double on_rim = 0.0, on_lids = 0.0, between = 0.0;
      const auto note = [&](double z, bool sharp, double moved) {
        double& most = sharp ? on_rim : std::abs(z) == 1.0 ? on_lids : between;
        most = std::max(most, moved);
      };
      const auto fans = vertex_fans(levels[l]);
      for (int v = 0; v < levels[l].vertex_count; ++v)
        note(plain.positions[v].z(), fans[v].on_crease(), (a.points[l][v] - b.points[l][v]).norm());
      for (int e = 0; e < levels[l].edge_count(); ++e)
        note(plain.positions[levels[l].vertex_count + e].z(), levels[l].creased[e],
             (a.details[l][e] - b.details[l][e]).norm());
      CHECK(on_rim < 1e-11);
      CHECK(on_lids < 1e-11);
      CHECK(between > 1e-3);
    }
  }
}

TEST_CASE("streams of meshes with creases hold these and the mesh, to every prefix") {
  for (const SemiregularMesh& mesh :
       {samples::creased_cube(3, 0.2), samples::cylinder(7, 3), samples::lens(3),
        with_random_creases(shapes::grid(3, 4), 3, 0.3), with_random_creases(shapes::torus(6, 4), 3, 1.0)})
    for (Wavelet wavelet : kWavelets) {
      INFO(wavelet_name(wavelet));
      EncodeOptions options;
      options.wavelet = wavelet;
      options.precision_bits =
          22;  // details of random creases turn with their frames, so errors grow from level to level
      const Bytes stream = encode(mesh, options, quiet);
      const SemiregularMesh decoded = decode(stream, stream.size());
      Bytes connectivity;
      const CodedBase base = encode_connectivity(mesh.base_faces, connectivity, mesh.creases);
      const std::vector<int> order = coded_vertex_order(mesh, base);
      Creases back;
      for (const auto& [a, b] : decoded.creases)
        back.push_back({std::min(order[a], order[b]), std::max(order[a], order[b])});
      std::sort(back.begin(), back.end());
      CHECK(back == mesh.creases);
      double farthest = 0.0;
      for (std::size_t v = 0; v < order.size(); ++v)
        farthest = std::max(farthest, (decoded.positions[v] - mesh.positions[order[v]]).norm());
      CHECK(farthest < 1e-3);
      for (std::size_t bytes = header_bytes(stream); bytes < stream.size(); bytes += 1 + bytes / 4)
        CHECK(decode(stream, bytes).positions.size() == decoded.positions.size());
    }
}

TEST_CASE("with creases analysis converges as fast as without, whichever they are") {
  for (const Mesh& base : {shapes::icosahedron(), shapes::grid(3, 4), shapes::torus(5, 4)})
    for (double share : {0.0, 0.2, 0.5, 1.0})
      for (Wavelet wavelet : {Wavelet::Loop, Wavelet::Loop11}) {
        const SemiregularMesh mesh = with_random_creases(base, 3, share);
        const WaveletTransform transform(detail_levels(mesh), wavelet);
        std::vector<Vec3> points = mesh.positions;
        for (int l = mesh.level - 1; l >= 0; --l) {
          const WaveletTransform::Split split = transform.analysis(l, points);
          CHECK(split.iterations < 125);
          points = split.coarse;
        }
      }
}

TEST_CASE("creases code bodies with sharp edges better by far at the same bytes", "[slow]") {
  struct Body {
    SemiregularMesh mesh;
    double gain;  ///< dB that are asked for
  };
  for (const Body& body :
       {Body{samples::creased_cube(5, 0.2), 12.0}, Body{samples::cylinder(8, 4), 25.0}, Body{samples::lens(5), 4.0}})
    for (Wavelet wavelet : {Wavelet::Loop, Wavelet::ButterflyLifted})
      for (std::size_t bytes : {500, 1000, 2000}) {
        const auto psnr = [&](const SemiregularMesh& coded) {
          EncodeOptions options;
          options.wavelet = wavelet;
          DistanceOptions samples;
          samples.samples = 100'000;
          const SemiregularMesh decoded = decode(encode(coded, options, quiet), bytes);
          return surface_distance(body.mesh.mesh(), decoded.mesh(), samples, quiet).psnr_db();
        };
        SemiregularMesh smooth = body.mesh;
        smooth.creases.clear();
        INFO(wavelet_name(wavelet) << " at " << bytes);
        CHECK(psnr(body.mesh) > psnr(smooth) + body.gain);
      }
}

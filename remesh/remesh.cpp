#include "remesh/remesh.h"

#include <algorithm>
#include <climits>
#include <optional>
#include <string>
#include <utility>

#include "mesh/error.h"
#include "mesh/parallel.h"
#include "param/map/development.h"
#include "remesh/chart_samples.h"
#include "remesh/closest_fit.h"
#include "remesh/crease_corners.h"
#include "remesh/displaced/displaced_remesh.h"
#include "remesh/displaced/fit_target.h"
#include "remesh/fit_positions.h"
#include "remesh/lattice_corners.h"
#include "remesh/normal/normal_remesh.h"
#include "remesh/scalar/scalar_fit.h"

namespace gsp {

namespace {

/// Of a remesh whose level is automatic (bench/README.md, "The level of coarse surfaces").
constexpr int kFewestFaces = 1 << 15;

int chosen_level(const Parameterization& map, const RemeshOptions& options) {
  int level = options.level;
  if (level == RemeshOptions::kAutoLevel) {
    level = first_level_with(map.base.face_count(), std::max<double>(input_face_count(map), kFewestFaces));
  }
  if (level < 0 || level > kMaxSubdivisionLevel)
    throw Error(Cause::BadOption,
                "remeshing level " + std::to_string(level) + " is not in 0.." + std::to_string(kMaxSubdivisionLevel));
  // Half-edges of the finest level are counted in int.
  if ((static_cast<long long>(map.base.face_count()) << (2 * level)) > INT_MAX / 3)
    throw Error(Cause::BadOption, "a remesh of level " + std::to_string(level) + " has too many faces to number");
  return level;
}

/// Steps between vertices at which a fit samples the surface: 4, and more where faces of the input would fall between
/// samples; fewer where one chart's samples would take too much memory.
int fit_steps(const Parameterization& map, int level) {
  constexpr int kLeastSteps = 4, kMostAcrossChart = 2048;
  constexpr double kSamplesPerFace = 4.0;
  const int n = 1 << level;
  const double charts = map.base.face_count();
  int steps = kLeastSteps;
  const auto samples = [&] { return 0.5 * charts * n * steps * n * steps; };
  while (2 * steps * n <= kMostAcrossChart && samples() < kSamplesPerFace * map.surface.face_count()) steps *= 2;
  while (steps > 1 && steps * n > kMostAcrossChart) steps /= 2;
  return steps;
}

FitEffort effort_of(const RemeshOptions& options) {
  // A third of the stiffness costs up to 0.5 dB at 8 and 16 KB on Venus and the bunny, twice as much gives the same
  // curves with ceilings 0.5 dB lower.
  constexpr FitEffort kFitted{5e-3};
  // With three times as much the remeshing error of Venus and the bunny is 4% larger. The error is what counts here, so
  // the rounds go on for less.
  constexpr FitEffort kClosest{5e-5, 0.01, 20};
  FitEffort effort = options.positions == Positions::Closest ? kClosest : kFitted;
  effort.most_rounds =
      options.positions == Positions::Sampled ? 0 : std::min(effort.most_rounds, options.most_fit_rounds);
  return effort;
}

void require_built(const RemeshOptions& options) {
  if (options.kind == RemeshKind::Parametric || options.kind == RemeshKind::Displaced) return;
  if (options.predict == Prediction::ButterflyLifted && options.kind == RemeshKind::Normal &&
      options.positions == Positions::Sampled)
    throw Error(Cause::BadOption,
                "vertices on normals through the prediction of lifted Butterfly are fitted ones only");
  if (options.predict == Prediction::Loop &&
      (options.kind != RemeshKind::Normal || options.positions != Positions::Sampled))
    throw Error(Cause::BadOption, "vertices on normals through the prediction of Loop are sampled ones only");
}

NormalRemesh normal(const Parameterization& map, const std::vector<std::vector<FacePiece>>& pieces,
                    const std::vector<SubdivisionLevel>& levels, const RemeshOptions& options, Progress& progress) {
  NormalOptions normal_options;
  if (options.kind == RemeshKind::VariationalNormal)
    normal_options.tolerance = options.normal_tolerance * bounding_box_diagonal(map.surface);
  normal_options.loop = options.predict == Prediction::Loop;
  NormalRemesh made = normal_remesh(map, pieces, levels, normal_options, progress);
  const auto count = [&](VertexForm form) {
    return std::to_string(std::count(made.forms.begin(), made.forms.end(), form));
  };
  progress.note(count(VertexForm::Normal) + " of " + std::to_string(made.forms.size()) +
                " vertices above the base are normal; " + count(VertexForm::Parametric) +
                " are where the map has them, " + count(VertexForm::Boundary) + " on boundaries and creases");
  return made;
}

SemiregularMesh semiregular(const Parameterization& map, int level, std::vector<Vec3> positions,
                            std::vector<int> corners) {
  SemiregularMesh mesh{level, map.base.vertex_count(), map.base.faces, std::move(positions)};
  mesh.creases = map.base.creases;
  mesh.corners = std::move(corners);
  return mesh;
}

/// Remeshing in progress: the finest connectivity, the positions, and what the charts found on their borders.
class Remesher {
 public:
  Remesher(const Parameterization& map, int level, Positions positions)
      : map_(map),
        level_(level),
        n_(1 << level),
        steps_(positions == Positions::Sampled ? 1 : fit_steps(map, level)),
        finest_(subdivision_levels(map.base.vertex_count(), map.base.faces, level, map.base.creases).back()),
        creased_(map.base.crease_halfedges()),
        borders_(map.base.twins.size()),
        gaps_(map.base.faces.size(), 0) {
    if (positions != Positions::Sampled) {
      fit_.emplace(finest_, steps_);
      surface_samples_.resize(map.base.faces.size());
    }
    positions_.assign(finest_.vertex_count, Vec3::Zero());
    for (int b = 0; b < map.base.vertex_count(); ++b) positions_[b] = map.surface.positions[map.base.vertices[b]];
  }

  void sample_chart(int chart, const std::vector<FacePiece>& pieces) {
    ChartSamples samples(map_, pieces, n_ * steps_);
    samples.fill_gaps();
    for (int k = 0; k < 3; ++k)
      if (creased_[3 * chart + k]) samples.put_on_crease(k);
    const auto sample = [&](int i, int j) { return samples.at(steps_ * i, steps_ * j); };
    const std::vector<int> vertices = chart_vertices(chart);
    const auto vertex = [&](int i, int j) { return vertices[lattice_index(n_, i, j)]; };
    for (int j = 1; j < n_; ++j)
      for (int i = 1; i + j < n_; ++i) set(chart, vertex(i, j), sample(i, j));
    for (int s = 1; s < n_; ++s) {
      borders_[3 * chart].push_back({vertex(s, 0), sample(s, 0)});
      borders_[3 * chart + 1].push_back({vertex(n_ - s, s), sample(n_ - s, s)});
      borders_[3 * chart + 2].push_back({vertex(0, n_ - s), sample(0, n_ - s)});
    }
    if (fit_) integrate(chart, samples);
  }

  /// Points on base edges, from whichever side found them better.
  void merge_borders() {
    for (int h = 0; h < static_cast<int>(borders_.size()); ++h) {
      const int twin = map_.base.twins[h];
      if (twin >= 0 && twin < h) continue;
      for (int s = 1; s < n_; ++s) {
        SurfacePoint best = borders_[h][s - 1].point;
        if (twin >= 0 && borders_[twin][n_ - s - 1].point.better_than(best)) best = borders_[twin][n_ - s - 1].point;
        set(h / 3, borders_[h][s - 1].vertex, best);
      }
    }
  }

  /// Of the creases, once all points are there.
  void find_corners() { finest_.corners = crease_corners(finest_, map_.base.vertex_count(), positions_); }

  int gaps() const {
    int sum = 0;
    for (int gap : gaps_) sum += gap;
    return sum;
  }

  void fit(const FitEffort& effort) {
    std::vector<SurfaceSample> samples;
    for (std::vector<SurfaceSample>& chart : surface_samples_) {
      samples.insert(samples.end(), chart.begin(), chart.end());
      std::vector<SurfaceSample>().swap(chart);
    }
    const FoldGuard guard(finest_, fit_->surface_areas());
    positions_ = fit_closest(finest_, guard, std::move(samples), effort, fit_->fit(positions_));
  }

  SemiregularMesh take() { return semiregular(map_, level_, std::move(positions_), finest_.corners); }

 private:
  /// The position of a sample. Throws where the chart has none.
  Vec3 covered(int chart, const SurfacePoint& point) const {
    if (point.face < 0)
      throw Error(Cause::InvalidMap, "no face of the surface covers a base face", Element::Face, chart);
    return position_at(map_.surface, point);
  }

  void set(int chart, int vertex, const SurfacePoint& point) {
    positions_[vertex] = covered(chart, point);
    if (point.fit < -SurfacePoint::kNear) ++gaps_[chart];
  }

  /// Hands the surface over each face of a chart to the fit.
  void integrate(int chart, const ChartSamples& samples) {
    const int n = n_ * steps_;
    std::vector<Vec3> points(static_cast<std::size_t>(steps_ + 1) * (steps_ + 2) / 2);
    std::vector<char> taken(static_cast<std::size_t>(n + 1) * (n + 2) / 2, 0);
    for (int f = 0; f < 1 << (2 * level_); ++f) {
      const auto c = lattice_corners(level_, f);
      const int face = (chart << (2 * level_)) + f;
      for (int t = 0; t <= steps_; ++t)
        for (int s = 0; s + t <= steps_; ++s) {
          const int r = steps_ - s - t;
          const int i = r * c[0][0] + s * c[1][0] + t * c[2][0], j = r * c[0][1] + s * c[1][1] + t * c[2][1];
          const Vec3& point = points[lattice_index(steps_, s, t)] = covered(chart, samples.at(i, j));
          if (std::exchange(taken[lattice_index(n, i, j)], 1)) continue;
          // The part of the triangles around it that lies in the chart, in faces.
          const int borders = (i == 0) + (j == 0) + (i + j == n);
          const double weight = (borders == 0 ? 6.0 : borders == 1 ? 3.0 : 1.0) / (3.0 * steps_ * steps_);
          const auto part = [&](int of) { return static_cast<double>(of) / steps_; };
          surface_samples_[chart].push_back({point, weight, {face, {part(r), part(s), part(t)}}});
        }
      fit_->add_face(face, points);
    }
  }

  /// #samples, the remesh's vertex at each lattice point of a chart.
  std::vector<int> chart_vertices(int chart) const {
    std::vector<int> vertices(static_cast<std::size_t>(n_ + 1) * (n_ + 2) / 2, -1);
    for (int f = 0; f < 1 << (2 * level_); ++f) {
      const auto corners = lattice_corners(level_, f);
      const Triangle& face = finest_.faces[(static_cast<std::size_t>(chart) << (2 * level_)) + f];
      for (int k = 0; k < 3; ++k) vertices[lattice_index(n_, corners[k][0], corners[k][1])] = face[k];
    }
    return vertices;
  }

  const Parameterization& map_;
  int level_, n_;
  int steps_;  ///< samples between neighbouring vertices, for the fit
  SubdivisionLevel finest_;
  std::vector<char> creased_;  ///< by half-edge of the base
  std::optional<PositionFit> fit_;
  std::vector<std::vector<SurfaceSample>> surface_samples_;  ///< by chart, for a fit
  std::vector<Vec3> positions_;
  struct BorderSample {
    int vertex;
    SurfacePoint point;
  };
  std::vector<std::vector<BorderSample>> borders_;  ///< by half-edge of the base, along it
  std::vector<int> gaps_;
};

/// The surface that a fit goes by: sampled on a level that is finer than `level`, and than the input by twice as many
/// faces at least, where there is such a level that can be numbered.
SemiregularMesh fit_target(const Parameterization& map, int level, Progress& progress) {
  const int faces = map.base.face_count(),
            finer = std::max(level + 1, first_level_with(faces, 2.0 * input_face_count(map)));
  RemeshOptions sampled;
  sampled.level = std::max(level, last_level_with(faces, INT_MAX / 3, std::min(finer, kMaxSubdivisionLevel)));
  sampled.positions = Positions::Sampled;
  return remesh(map, sampled, progress);
}

SemiregularMesh displaced(const Parameterization& map, int level, Positions positions, Progress& progress) {
  if (!map.base.creases.empty())
    progress.note("a displaced mesh has no creases: its " + std::to_string(map.base.creases.size()) +
                  " base edges on feature curves are smooth ones");
  DisplacedOptions options;
  options.positions = positions;
  return displaced_remesh(fit_target(map, level, progress), level, options, progress);
}

/// Of remeshes with the same exceptions, one nearest to the surface; sampled, the one nearest to the given one.
std::vector<Vec3> fitted(const Parameterization& map, const std::vector<SubdivisionLevel>& levels,
                         const RemeshOptions& options, const NormalRemesh& normal, Progress& progress) {
  const int level = static_cast<int>(levels.size()) - 1;
  const SemiregularMesh surface = fit_target(map, level, progress);
  const SubdivisionLevel finest = surface.levels().back();
  const FitEffort effort = effort_of(options);
  std::vector<char> exceptional;
  for (VertexForm form : normal.forms) exceptional.push_back(form != VertexForm::Normal);
  progress.report("scalar fit", 0.5);
  ScalarFit fit =
      fit_scalars(levels, exceptional, options.predict == Prediction::ButterflyLifted,
                  FitTarget{finest, surface.positions}.samples(surface.level - level), effort, normal.positions);
  progress.note("details were made normal at an RMS distance of " +
                std::to_string(100.0 * fit.rms / bounding_box_diagonal(map.surface)) + "% of the diagonal");
  return std::move(fit.positions);
}

}  // namespace

SemiregularMesh remesh(const Parameterization& map, const RemeshOptions& options, Progress& progress) {
  require_built(options);
  require_well_formed(map);
  if (map.base.faces.empty()) throw Error(Cause::InvalidMap, "a map without base faces has nothing to remesh");
  const int level = chosen_level(map, options);
  if (options.kind == RemeshKind::Displaced) return displaced(map, level, options.positions, progress);
  progress.report("remesh", 0.0);
  const std::vector<std::vector<FacePiece>> pieces = pieces_by_chart(map);
  progress.report("remesh", 0.3);
  if (options.kind == RemeshKind::Normal || options.kind == RemeshKind::VariationalNormal) {
    auto levels = subdivision_levels(map.base.vertex_count(), map.base.faces, level, map.base.creases);
    NormalRemesh made = normal(map, pieces, levels, options, progress);
    const std::vector<int> corners = crease_corners(levels.back(), map.base.vertex_count(), made.positions);
    for (SubdivisionLevel& l : levels) l.corners = corners;
    if (options.kind == RemeshKind::VariationalNormal || options.positions != Positions::Sampled)
      made.positions = fitted(map, levels, options, made, progress);
    progress.report("remesh", 1.0);
    return semiregular(map, level, std::move(made.positions), corners);
  }
  Remesher remesher(map, level, options.positions);
  parallel_for(pieces.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) remesher.sample_chart(static_cast<int>(c), pieces[c]);
  });
  progress.report("remesh", 0.9);
  remesher.merge_borders();
  remesher.find_corners();
  if (remesher.gaps() > 0)
    progress.note(std::to_string(remesher.gaps()) +
                  " points of the remesh lie in no face of the map, which has folds; the nearest place was taken");
  if (options.positions != Positions::Sampled) remesher.fit(effort_of(options));
  progress.report("remesh", 1.0);
  return remesher.take();
}

}  // namespace gsp

#include "remesh/normal/normal_remesh.h"

#include <algorithm>
#include <optional>

#include "mesh/parallel.h"
#include "remesh/filters/butterfly_low_pass.h"
#include "remesh/filters/local_frames.h"
#include "remesh/filters/loop_low_pass.h"
#include "remesh/normal/piercing.h"

namespace gsp {

namespace {

/// Least area of a triangle of the domain, over the quarter of its parent's that it has where all vertices are at the
/// middles of edges.
constexpr double kUpright = 0.1;

constexpr std::size_t kGrain = 256;

/// One level's new vertices in progress: those that a normal offers, and the middles instead.
class Insertion {
 public:
  Insertion(const ChartIndex& index, const RemeshDomain& domain, const std::vector<Vec3>& positions,
            const NormalOptions& options)
      : index_(index),
        domain_(domain),
        level_(domain.connectivity()),
        reach_(domain),
        hits_(level_.edges.size()),
        lines_(level_.edges.size()),
        tolerance_(options.tolerance) {
    std::vector<Vec3> predicted(level_.vertex_count + level_.edges.size(), Vec3::Zero());
    (options.loop ? loop_low_pass(level_) : butterfly_low_pass(level_))->add(positions.data(), predicted.data());
    const EdgeFrames frames(level_, positions);
    middles_.resize(level_.edges.size());
    parallel_for(level_.edges.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const int e = static_cast<int>(i);
        const auto [a, b] = ends(e);
        middles_[e] = 0.5 * (a + b);
        if (on_curve(e)) continue;
        lines_[e] = {predicted[level_.vertex_count + e], frames(e).col(0)};
        hits_[e] = nearest_hit(index, domain, reach_, e, lines_[e], middles_[e],
                               options.aperture * std::min(std::abs(b - a), 0.1));
      }
    });
  }

  /// Gives up, one by one, the vertices that leave triangles of the domain not upright.
  void keep_upright() {
    std::vector<int> faces(level_.faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) faces[f] = static_cast<int>(f);
    while (!faces.empty()) {
      std::vector<int> again;
      for (int face : faces)
        for (int e = worst_edge(face); e >= 0; e = worst_edge(face)) {
          hits_[e].reset();
          for (int beside : level_.edge_faces[e])
            if (beside >= 0) again.push_back(beside);
        }
      faces = std::move(again);
    }
  }

  /// Puts the middles where nothing else was found. Appends to all three.
  void finish(std::vector<Vec3>& positions, std::vector<VertexForm>& forms, std::vector<DomainVertex>& places) {
    const std::size_t edges = level_.edges.size(), before = positions.size();
    positions.resize(before + edges);
    places.resize(edges);
    parallel_for(edges, kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const int e = static_cast<int>(i);
        const Hit hit = hits_[e] ? *hits_[e] : surface_hit(index_, domain_, reach_, e, middles_[e]);
        positions[before + i] = hit.position;
        places[i] = hit.place;
        if (hits_[e] || on_curve(e) || tolerance_ == 0.0) continue;
        const Vec3 nearest = lines_[e].nearest(hit.position);
        if ((nearest - hit.position).norm() > tolerance_) continue;
        positions[before + i] = nearest;
        hits_[e] = hit;
      }
    });
    for (int e = 0; e < level_.edge_count(); ++e)
      forms.push_back(hits_[e] ? VertexForm::Normal : on_curve(e) ? VertexForm::Boundary : VertexForm::Parametric);
  }

 private:
  bool on_curve(int edge) const { return level_.sharp(edge); }

  /// In the chart of the edge's first face.
  std::array<Complex, 2> ends(int edge) const {
    const int face = level_.edge_faces[edge][0];
    const std::array<int, 3>& edges = level_.face_edges[face];
    const int k = static_cast<int>(std::find(edges.begin(), edges.end(), edge) - edges.begin());
    return {domain_.corner(face, k), domain_.corner(face, (k + 1) % 3)};
  }

  /// Of the new vertices of a triangle that is not upright among the four that `face` becomes, the one that is farthest
  /// from its middle; -1 where all are upright.
  int worst_edge(int face) const {
    const std::array<Complex, 3> corner = domain_.corners(face);
    const std::array<int, 3>& edges = level_.face_edges[face];
    std::array<Complex, 3> middle;
    for (int k = 0; k < 3; ++k) {
      const Complex z = hits_[edges[k]] ? hits_[edges[k]]->place.z : middles_[edges[k]];
      middle[k] = domain_.across(edges[k], face).apply(z);
    }
    const double least = kUpright * 0.25 * chart_area(corner[0], corner[1], corner[2]);
    std::array<bool, 3> at_fault = {false, false, false};
    if (!(chart_area(middle[0], middle[1], middle[2]) > least)) at_fault.fill(true);
    for (int k = 0; k < 3; ++k) {
      const int before = (k + 2) % 3;
      if (!(chart_area(corner[k], middle[k], middle[before]) > least)) at_fault[k] = at_fault[before] = true;
    }
    int worst = -1;
    double farthest = -1.0;
    for (int k = 0; k < 3; ++k) {
      if (!at_fault[k] || !hits_[edges[k]]) continue;
      const double distance = std::abs(hits_[edges[k]]->place.z - middles_[edges[k]]);
      if (distance <= farthest) continue;
      farthest = distance;
      worst = edges[k];
    }
    return worst;
  }

  const ChartIndex& index_;
  const RemeshDomain& domain_;
  const SubdivisionLevel& level_;
  const FaceReach reach_;
  std::vector<Complex> middles_;          ///< #E, in the chart of the edge's first face
  std::vector<std::optional<Hit>> hits_;  ///< #E
  std::vector<Line> lines_;               ///< #E, the normals, but on curves
  double tolerance_;
};

}  // namespace

NormalRemesh normal_remesh(const Parameterization& map, const std::vector<std::vector<FacePiece>>& pieces,
                           const std::vector<SubdivisionLevel>& levels, const NormalOptions& options,
                           Progress& progress) {
  const ChartIndex index(map, pieces);
  NormalRemesh result{{}, RemeshDomain(map.base, levels), {}};
  for (int v : map.base.vertices) result.positions.push_back(map.surface.positions[v]);
  const double faces = static_cast<double>(levels.back().faces.size());
  for (std::size_t l = 0; l + 1 < levels.size(); ++l) {
    progress.report("normal remesh", static_cast<double>(levels[l].faces.size()) / faces);
    Insertion insertion(index, result.domain, result.positions, options);
    insertion.keep_upright();
    std::vector<DomainVertex> places;
    insertion.finish(result.positions, result.forms, places);
    result.domain.refine(std::move(places));
  }
  return result;
}

}  // namespace gsp

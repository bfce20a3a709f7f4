#include "param/corners/choose_base_flips.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "param/atlas/folds.h"
#include "param/corners/base_edge_flip.h"
#include "param/energy/distortion_energy.h"
#include "param/energy/lower_peaks.h"
#include "param/energy/newton_descent.h"
#include "param/energy/untangle.h"

namespace gsp {

namespace {

constexpr double kIsometry = 1.0 + kMapAreaWeight;  // energy by area
constexpr double kWorthwhile = 0.99;                // of the energy above an isometry's, that a flip has to fall below
constexpr double kLoss = 0.5;            // of shape that the affine map may cost, which smoothing has to win back
constexpr int kApartSteps = 20;          // of L-BFGS for each ε, where the affine map has folds
constexpr int kDescentSteps = 8;         // of the descent at most
constexpr double kLeastStepGain = 3e-3;  // that ends it
constexpr double kStepsAhead = 4.0;      // as good as the last, with which the goal must come within reach
constexpr int kFlipPasses = 3;
constexpr double kLongEdge = 1.7;  // in base edges: two heights of a patch, across which an edge could pass unseen

/// What a flip and the smoothing after it change.
class Snapshot {
 public:
  Snapshot(const Atlas& atlas, const FlipSite& site, std::vector<int> vertices, const std::vector<int>& edges)
      : site_(site), vertices_(std::move(vertices)), edges_(edges) {
    for (int corner : site.corners) {
      vertices_.push_back(atlas.base.vertices[corner]);
      fans_.push_back(atlas.fans[corner]);
    }
    for (int v : vertices_) places_.emplace_back(atlas.patch[v], atlas.position[v]);
    for (int e : edges_) transitions_.push_back(atlas.transition[e]);
    for (int f : site.faces) {
      faces_.push_back(atlas.base.faces[f]);
      for (int h = 3 * f; h < 3 * f + 3; ++h) twins_.push_back(atlas.base.twins[h]);
    }
  }

  void restore(Atlas& atlas) const {
    for (std::size_t i = 0; i < fans_.size(); ++i) atlas.fans[site_.corners[i]] = fans_[i];
    for (std::size_t i = 0; i < vertices_.size(); ++i)
      std::tie(atlas.patch[vertices_[i]], atlas.position[vertices_[i]]) = places_[i];
    for (std::size_t i = 0; i < edges_.size(); ++i) atlas.transition[edges_[i]] = transitions_[i];
    std::size_t next = 0;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      const int f = site_.faces[i];
      atlas.base.faces[f] = faces_[i];
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int twin = twins_[next++];
        atlas.base.twins[h] = twin;
        if (twin >= 0) atlas.base.twins[twin] = h;
      }
    }
  }

 private:
  const FlipSite site_;
  std::vector<int> vertices_, edges_;
  std::vector<BaseFan> fans_;
  std::vector<std::pair<int, Complex>> places_;
  std::vector<Transition> transitions_;
  std::vector<Triangle> faces_;
  std::vector<int> twins_;
};

class Flipper {
 public:
  explicit Flipper(Atlas& atlas) : atlas_(atlas), members_(atlas.base.face_count()), changed_(members_.size(), 0) {
    std::vector<int> faces(atlas.surface->mesh.faces.size());
    std::iota(faces.begin(), faces.end(), 0);
    shapes_ = reference_shapes(atlas, faces);
    for (int v = 0; v < static_cast<int>(atlas.patch.size()); ++v)
      if (atlas.patch[v] >= 0 && atlas.corner[v] < 0) members_[atlas.patch[v]].push_back(v);
    for (int e = 0; e < atlas.surface->edge_count(); ++e)
      if (is_long(e)) long_edges_.push_back(e);
  }

  /// One attempt for every candidate around which something has changed since the last one. Returns how many were
  /// flipped.
  int pass() {
    int flipped = 0;
    for (const Candidate& c : candidates()) {
      const int h = find_base_edge(atlas_.base, atlas_.fans, c.a, c.b);
      const auto site = h < 0 ? std::nullopt : flip_site(atlas_, h);
      if (!site) continue;
      const std::vector<int> patches = faces_around(atlas_, *site);
      int& last = attempted_[std::minmax(c.a, c.b)];
      if (std::none_of(patches.begin(), patches.end(), [&](int p) { return changed_[p] >= last; })) continue;
      last = ++time_;
      if (!attempt(*site, patches)) continue;
      for (int p : patches) changed_[p] = time_;
      ++flipped;
    }
    return flipped;
  }

 private:
  struct Candidate {
    double gain;
    int a, b;  ///< the edge's base vertices
  };

  bool is_long(int edge) const;
  bool is_beside(int patch, const FlipSite& site) const;
  std::vector<Candidate> candidates() const;
  bool attempt(const FlipSite& site, const std::vector<int>& patches);
  bool lower_to(double goal, const std::vector<int>& vertices, const std::vector<int>& faces);
  DistortionEnergy energy_of(const std::vector<int>& vertices, const std::vector<int>& faces) const;

  Atlas& atlas_;
  std::vector<ReferenceShape> shapes_;     ///< per face
  std::vector<std::vector<int>> members_;  ///< per patch, its vertices that are no corners
  std::vector<int> long_edges_;
  int time_ = 0;                                  ///< counts the attempts
  std::vector<int> changed_;                      ///< per patch, the last attempt that changed it
  std::map<std::pair<int, int>, int> attempted_;  ///< per edge, the last attempt
};

bool Flipper::is_long(int edge) const {
  const int h = atlas_.surface->edge_halfedge[edge];
  const int from = atlas_.surface->halfedges.from(h), to = atlas_.surface->halfedges.to(h);
  return std::norm(atlas_.transition[edge].apply(atlas_.position[to]) - atlas_.position[from]) > kLongEdge * kLongEdge;
}

/// The edges for which the mean of J Jᵀ over their patches has not much more shape distortion after the flip's affine
/// map, in the order of what it gains.
std::vector<Flipper::Candidate> Flipper::candidates() const {
  struct Mean {
    double xx = 0.0, xy = 0.0, yy = 0.0;
  };
  const BaseComplex& base = atlas_.base;
  std::vector<Mean> mean(base.face_count());
  for (int f = 0; f < atlas_.surface->mesh.face_count(); ++f) {
    const Atlas::FaceFrame frame = atlas_.face_frame(f);
    const auto z = atlas_.face_corners(f, frame);
    const ReferenceShape& s = shapes_[f];
    const Complex e1 = z[1] - z[0], e2 = z[2] - z[0], j1 = s.inverse[0] * e1,
                  j2 = s.inverse[1] * e1 + s.inverse[2] * e2;
    Mean& m = mean[frame.chart];
    m.xx += s.weight * (j1.real() * j1.real() + j2.real() * j2.real());
    m.xy += s.weight * (j1.real() * j1.imag() + j2.real() * j2.imag());
    m.yy += s.weight * (j1.imag() * j1.imag() + j2.imag() * j2.imag());
  }
  // With the edge along x: the flip stretches by √3 along it and shrinks by as much across.
  const auto along_edge = [&](int h, double& along, double& across) {
    const Mean& m = mean[h / 3];
    const Complex d = omega_power(2 * (h % 3));
    along += d.real() * d.real() * m.xx + 2.0 * d.real() * d.imag() * m.xy + d.imag() * d.imag() * m.yy;
    across += d.imag() * d.imag() * m.xx - 2.0 * d.real() * d.imag() * m.xy + d.real() * d.real() * m.yy;
  };
  std::vector<Candidate> found;
  for (int h = 0; h < static_cast<int>(base.twins.size()); ++h) {
    if (base.twins[h] < h) continue;
    double along = 0.0, across = 0.0;
    along_edge(h, along, across);
    along_edge(base.twins[h], along, across);
    const double gain = along + across - (3.0 * along + across / 3.0);
    if (gain > -kLoss * (along + across))
      found.push_back({gain, base.faces[h / 3][h % 3], base.faces[h / 3][(h + 1) % 3]});
  }
  std::sort(found.begin(), found.end(), [](const Candidate& x, const Candidate& y) {
    return x.gain != y.gain ? x.gain > y.gain : std::pair(x.a, x.b) < std::pair(y.a, y.b);
  });
  return found;
}

/// `faces`: those around the vertices.
DistortionEnergy Flipper::energy_of(const std::vector<int>& vertices, const std::vector<int>& faces) const {
  std::vector<ReferenceShape> shapes;
  for (int f : faces) shapes.push_back(shapes_[f]);
  return {atlas_, vertices, faces, shapes, kMapAreaWeight};
}

/// Smooths around the site until its energy is below the goal and gains little more. False where it does not come there
/// free of folds, or a vertex loses its chart.
bool Flipper::lower_to(double goal, const std::vector<int>& vertices, const std::vector<int>& faces) {
  const DistortionEnergy around = energy_of(vertices, faces);
  std::vector<double> x = around.positions(atlas_);
  if (!around.upright(x) && !drive_apart(around, x, kApartSteps)) return false;
  lower_peaks(around, x);
  NewtonDescent descent(around, x);
  for (int i = 0; i < kDescentSteps; ++i) {
    const double gain = descent.step();
    if (gain < kLeastStepGain || descent.value() * (1.0 - kStepsAhead * gain) > goal) break;
  }
  if (descent.value() > goal) return false;
  around.write_back(x, atlas_);
  // Faces that have been driven apart may still go round a vertex once too often.
  const std::vector<int> touched = vertices_of(atlas_.surface->mesh.faces, faces);
  const auto injective = [&](int v) { return local_map(atlas_, v) == LocalMap::Injective; };
  return std::all_of(touched.begin(), touched.end(), injective) &&
         std::all_of(vertices.begin(), vertices.end(), [&](int v) { return atlas_.reassign(v); });
}

/// Whether a patch is one of the site's or shares an edge with them.
bool Flipper::is_beside(int patch, const FlipSite& site) const {
  const Triangle& t = atlas_.base.faces[patch];
  return std::count_if(t.begin(), t.end(), [&](int b) {
           return std::find(site.corners.begin(), site.corners.end(), b) != site.corners.end();
         }) >= 2;
}

bool Flipper::attempt(const FlipSite& site, const std::vector<int>& patches) {
  std::vector<int> inside, edges = long_edges_, free;
  for (int p : patches) inside.insert(inside.end(), members_[p].begin(), members_[p].end());
  const auto add_edges = [&](int v) {
    atlas_.surface->for_each_neighbour(v, [&](int, int edge, bool) { edges.push_back(edge); });
  };
  for (int v : inside) add_edges(v);
  for (int corner : site.corners) add_edges(atlas_.base.vertices[corner]);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const auto ways = changed_ways(atlas_, site, edges);
  if (!ways) return false;
  for (int p : patches)
    if (is_beside(p, site))
      std::copy_if(members_[p].begin(), members_[p].end(), std::back_inserter(free),
                   [&](int v) { return atlas_.is_free(v); });
  if (free.empty()) return false;
  std::sort(free.begin(), free.end());

  const std::vector<int> faces = faces_around(*atlas_.surface, free);
  const DistortionEnergy around = energy_of(free, faces);
  std::vector<double> x = around.positions(atlas_), gradient(x.size());
  const double before = around.evaluate(x.data(), gradient.data(), 0.0);
  double isometric = 0.0;
  for (int f = 0; f < around.face_count(); ++f) isometric += kIsometry * around.weight(f);

  const Snapshot snapshot(atlas_, site, inside, edges);
  std::vector<int> moved = members_[site.faces[0]];
  moved.insert(moved.end(), members_[site.faces[1]].begin(), members_[site.faces[1]].end());
  const double goal = isometric + kWorthwhile * (before - isometric);
  if (!flip(atlas_, site, moved, *ways) || !lower_to(goal, free, faces)) {
    snapshot.restore(atlas_);
    return false;
  }
  for (int p : patches) members_[p].clear();
  for (int v : inside) members_[atlas_.patch[v]].push_back(v);
  for (int e : edges)
    if (is_long(e)) long_edges_.push_back(e);
  std::sort(long_edges_.begin(), long_edges_.end());
  long_edges_.erase(std::unique(long_edges_.begin(), long_edges_.end()), long_edges_.end());
  return true;
}

}  // namespace

int flip_base_edges(Atlas& atlas, Progress& progress) {
  const auto step = progress.step("flip base edges");
  if (atlas.reassign_all() > 0) return 0;
  Flipper flipper(atlas);
  int flipped = 0;
  for (int pass = 0; pass < kFlipPasses; ++pass) {
    progress.report("flip base edges", double(pass) / kFlipPasses);
    const int more = flipper.pass();
    flipped += more;
    if (more == 0) break;
  }
  return flipped;
}

}  // namespace gsp

#include "param/corners/choose_base_flips.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <list>
#include <map>
#include <numeric>
#include <tuple>

#include "mesh/parallel.h"
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
constexpr int kSideBySide = 8;     // attempts; changes no result
constexpr double kLongEdge = 1.7;  // in base edges: two heights of a patch, across which an edge could pass unseen

/// The state of all that a flip and the smoothing after it change, before or after.
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
  FlipSite site_;
  std::vector<int> vertices_, edges_;
  std::vector<BaseFan> fans_;
  std::vector<std::pair<int, Complex>> places_;
  std::vector<Transition> transitions_;
  std::vector<Triangle> faces_;
  std::vector<int> twins_;
};

/// A flip that has been tried out, and all that it may have looked at.
struct Attempt {
  FlipSite site;
  std::vector<int> patches;         ///< at the site's corners
  std::vector<int> inside;          ///< the vertices in them that are no corners
  std::vector<int> edges;           ///< at those and at the corners, and the long ones
  std::optional<Snapshot> flipped;  ///< what it leads to; nothing where it is not worthwhile
};

/// Attempts are made side by side, each on one of several equal copies of the atlas, and accepted in order. One that
/// rests on what an earlier one has changed is made again, so the result is that of one attempt after the other.
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
    copies_.assign(thread_count() - 1, atlas);
    vertex_changed_.assign(atlas.patch.size(), 0);
    patch_changed_.assign(members_.size(), 0);
  }

  /// One attempt for every candidate around which something has changed since the last one. Returns how many were
  /// flipped.
  int pass();

 private:
  struct Candidate {
    double gain;
    int a, b;  ///< the edge's base vertices
  };

  bool is_long(int edge) const;
  std::vector<Candidate> candidates() const;
  std::optional<FlipSite> due(const Candidate& c) const;
  /// Per site, from the present state.
  std::vector<Attempt> attempt_all(const std::vector<FlipSite>& sites);
  /// The atlas is as it was afterwards.
  Attempt attempt(Atlas& atlas, const FlipSite& site) const;
  bool lower_to(Atlas& atlas, double goal, const std::vector<int>& vertices, const std::vector<int>& faces) const;
  DistortionEnergy energy_of(const Atlas& atlas, const std::vector<int>& vertices, const std::vector<int>& faces) const;
  bool is_stale(const Attempt& made) const;
  void accept(const Attempt& made);

  Atlas& atlas_;
  std::list<Atlas> copies_;
  std::vector<ReferenceShape> shapes_;     ///< per face
  std::vector<std::vector<int>> members_;  ///< per patch, its vertices that are no corners
  std::vector<int> long_edges_;
  int time_ = 0;                                     ///< counts the attempts
  std::vector<int> changed_;                         ///< per patch, the last attempt that changed it
  std::map<std::pair<int, int>, int> attempted_;     ///< per edge, the last attempt
  int round_ = 0;                                    ///< counts the attempts side by side
  bool all_changed_ = false;                         ///< in this round
  std::vector<int> vertex_changed_, patch_changed_;  ///< the last round that did, beside the vertex too
};

/// Nothing where the edge is gone, cannot be flipped, or nothing around it has changed since the last attempt.
std::optional<FlipSite> Flipper::due(const Candidate& c) const {
  const int h = find_base_edge(atlas_.base, atlas_.fans, c.a, c.b);
  auto site = h < 0 ? std::nullopt : flip_site(atlas_, h);
  if (!site) return std::nullopt;
  const auto last = attempted_.find(std::minmax(c.a, c.b));
  if (last == attempted_.end()) return site;
  const std::vector<int> patches = faces_around(atlas_, *site);
  if (std::none_of(patches.begin(), patches.end(), [&](int p) { return changed_[p] >= last->second; }))
    return std::nullopt;
  return site;
}

int Flipper::pass() {
  const std::vector<Candidate> all = candidates();
  const std::size_t ahead = copies_.empty() ? 1 : kSideBySide;  // on one thread some would be made in vain
  int flipped = 0;
  for (auto next = all.begin(); next != all.end();) {
    ++round_;
    all_changed_ = false;
    const auto first = next;
    std::vector<FlipSite> sites;
    for (; next != all.end() && sites.size() < ahead; ++next)
      if (const auto site = due(*next)) sites.push_back(*site);
    const std::vector<Attempt> made = attempt_all(sites);
    for (auto c = first; c != next; ++c) {
      const auto site = due(*c);
      if (!site) continue;
      attempted_[std::minmax(c->a, c->b)] = ++time_;
      const auto known =
          std::find_if(made.begin(), made.end(), [&](const Attempt& m) { return m.site == *site && !is_stale(m); });
      std::optional<Attempt> anew;
      if (known == made.end()) anew = attempt(atlas_, *site);
      const Attempt& valid = anew ? *anew : *known;
      if (!valid.flipped) continue;
      accept(valid);
      ++flipped;
    }
  }
  return flipped;
}

std::vector<Attempt> Flipper::attempt_all(const std::vector<FlipSite>& sites) {
  std::vector<Attempt> made(sites.size());
  std::vector<Atlas*> atlases{&atlas_};
  for (Atlas& copy : copies_) atlases.push_back(&copy);
  std::atomic<std::size_t> next = 0;
  parallel_for(atlases.size(), 1, [&](std::size_t i, std::size_t) {
    for (std::size_t s = next++; s < sites.size(); s = next++) made[s] = attempt(*atlases[i], sites[s]);
  });
  return made;
}

/// Whether it may rest on what has been accepted in this round.
bool Flipper::is_stale(const Attempt& made) const {
  const auto changed = [&](int v) { return vertex_changed_[v] == round_; };
  const auto& surface = *atlas_.surface;
  return all_changed_ ||
         std::any_of(made.patches.begin(), made.patches.end(), [&](int p) { return patch_changed_[p] == round_; }) ||
         std::any_of(made.edges.begin(), made.edges.end(), [&](int e) {
           const int h = surface.edge_halfedge[e];
           return changed(surface.halfedges.from(h)) || changed(surface.halfedges.to(h));
         });
}

void Flipper::accept(const Attempt& made) {
  made.flipped->restore(atlas_);
  for (Atlas& copy : copies_) made.flipped->restore(copy);
  for (int p : made.patches) {
    members_[p].clear();
    changed_[p] = time_;
    patch_changed_[p] = round_;
  }
  const auto mark = [&](int v) {
    vertex_changed_[v] = round_;
    atlas_.surface->for_each_neighbour(v, [&](int w, int, bool) { vertex_changed_[w] = round_; });
  };
  for (int v : made.inside) {
    members_[atlas_.patch[v]].push_back(v);
    patch_changed_[atlas_.patch[v]] = round_;
    mark(v);
  }
  for (int corner : made.site.corners) mark(atlas_.base.vertices[corner]);
  const std::size_t before = long_edges_.size();
  for (int e : made.edges)
    if (is_long(e)) long_edges_.push_back(e);
  std::sort(long_edges_.begin(), long_edges_.end());
  long_edges_.erase(std::unique(long_edges_.begin(), long_edges_.end()), long_edges_.end());
  // Each attempt looks at all of them.
  const auto ways = changed_ways(atlas_, made.site, long_edges_);
  if (long_edges_.size() > before || !ways || !ways->empty()) all_changed_ = true;
}

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
DistortionEnergy Flipper::energy_of(const Atlas& atlas, const std::vector<int>& vertices,
                                    const std::vector<int>& faces) const {
  std::vector<ReferenceShape> shapes;
  for (int f : faces) shapes.push_back(shapes_[f]);
  return {atlas, vertices, faces, shapes, kMapAreaWeight};
}

/// Smooths around the site until its energy is below the goal and gains little more. False where it does not come there
/// free of folds, or a vertex loses its chart.
bool Flipper::lower_to(Atlas& atlas, double goal, const std::vector<int>& vertices,
                       const std::vector<int>& faces) const {
  const DistortionEnergy around = energy_of(atlas, vertices, faces);
  std::vector<double> x = around.positions(atlas);
  if (!around.upright(x) && !drive_apart(around, x, kApartSteps)) return false;
  lower_peaks(around, x);
  NewtonDescent descent(around, x);
  for (int i = 0; i < kDescentSteps; ++i) {
    const double gain = descent.step();
    if (gain < kLeastStepGain || descent.value() * (1.0 - kStepsAhead * gain) > goal) break;
  }
  if (descent.value() > goal) return false;
  around.write_back(x, atlas);
  // Faces that have been driven apart may still go round a vertex once too often.
  const std::vector<int> touched = vertices_of(atlas.surface->mesh.faces, faces);
  const auto injective = [&](int v) { return local_map(atlas, v) == LocalMap::Injective; };
  return std::all_of(touched.begin(), touched.end(), injective) &&
         std::all_of(vertices.begin(), vertices.end(), [&](int v) { return atlas.reassign(v); });
}

/// Whether a patch is one of the site's or shares an edge with them.
bool is_beside(const Triangle& t, const FlipSite& site) {
  return std::count_if(t.begin(), t.end(), [&](int b) {
           return std::find(site.corners.begin(), site.corners.end(), b) != site.corners.end();
         }) >= 2;
}

Attempt Flipper::attempt(Atlas& atlas, const FlipSite& site) const {
  Attempt made{site, faces_around(atlas, site), {}, long_edges_, std::nullopt};
  for (int p : made.patches) made.inside.insert(made.inside.end(), members_[p].begin(), members_[p].end());
  const auto add_edges = [&](int v) {
    atlas.surface->for_each_neighbour(v, [&](int, int edge, bool) { made.edges.push_back(edge); });
  };
  for (int v : made.inside) add_edges(v);
  for (int corner : site.corners) add_edges(atlas.base.vertices[corner]);
  std::sort(made.edges.begin(), made.edges.end());
  made.edges.erase(std::unique(made.edges.begin(), made.edges.end()), made.edges.end());
  const auto ways = changed_ways(atlas, site, made.edges);
  if (!ways) return made;
  std::vector<int> free;
  for (int p : made.patches)
    if (is_beside(atlas.base.faces[p], site))
      std::copy_if(members_[p].begin(), members_[p].end(), std::back_inserter(free),
                   [&](int v) { return atlas.is_free(v); });
  if (free.empty()) return made;
  std::sort(free.begin(), free.end());

  const std::vector<int> faces = faces_around(*atlas.surface, free);
  const DistortionEnergy around = energy_of(atlas, free, faces);
  std::vector<double> x = around.positions(atlas), gradient(x.size());
  const double before = around.evaluate(x.data(), gradient.data(), 0.0);
  double isometric = 0.0;
  for (int f = 0; f < around.face_count(); ++f) isometric += kIsometry * around.weight(f);

  const Snapshot unflipped(atlas, site, made.inside, made.edges);
  std::vector<int> moved = members_[site.faces[0]];
  moved.insert(moved.end(), members_[site.faces[1]].begin(), members_[site.faces[1]].end());
  const double goal = isometric + kWorthwhile * (before - isometric);
  // An edge may pass through the rhombus, and be turned by the flip, between vertices that the smoothing does not
  // reach.
  const auto stays = [&](const Way& way) {
    return local_map(atlas, way.start) == LocalMap::Injective && local_map(atlas, way.end) == LocalMap::Injective;
  };
  if (flip(atlas, site, moved, *ways) && lower_to(atlas, goal, free, faces) &&
      std::all_of(ways->begin(), ways->end(), stays))
    made.flipped.emplace(atlas, site, made.inside, made.edges);
  unflipped.restore(atlas);
  return made;
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

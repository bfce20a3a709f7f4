#include "param/corners/corner_move.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "param/atlas/folds.h"
#include "param/map/tolerances.h"

namespace gsp {

namespace {

/// Gives the inside vertices their new frames, charts and positions; the rim keeps its own.
void place(const CornerDisc& disc, std::vector<CornerDisc::Vertex>& vertices, int center, CornerMove& move) {
  const double power = 1.0 / disc.power();
  const BaseFan& fan = disc.fan();
  vertices[0].develop = fan.develop(fan.find(disc.atlas().patch[disc.corner()]));
  for (const CornerDisc::Vertex& v : vertices)
    if (!v.inside) move.rim.push_back(v.vertex);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    CornerDisc::Vertex& v = vertices[i];
    if (!v.inside) continue;
    int sector = 0;
    Complex plane = 0.0;
    if (static_cast<int>(i) != center) {
      v.angle = std::arg(v.disc) * power;
      sector = static_cast<int>(std::floor(v.angle / kSectorAngle));
      plane = std::polar(std::pow(std::abs(v.disc), power), v.angle);
    }
    v.develop = fan.develop(sector);
    const BaseFan::Sector& s = fan.sector(sector);
    move.places.push_back(
        {v.vertex, s.face,
         static_cast<int>(i) == center ? kChartCorners[s.corner].value() : v.develop.inverse().apply(plane)});
  }
}

/// The new transitions of all edges at inside vertices.
void connect(const CornerDisc& disc, const std::vector<CornerDisc::Vertex>& vertices, int center, CornerMove& move) {
  const double power = 1.0 / disc.power(), cone = disc.fan().valence() * kSectorAngle;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const CornerDisc::Vertex& v = vertices[i];
    if (!v.inside) continue;
    disc.surface().for_each_neighbour(v.vertex, [&](int w, int edge, bool forward) {
      const int j = disc.index(w);
      const CornerDisc::Vertex& other = vertices[j];
      if (other.inside && j < static_cast<int>(i)) return;
      Transition to_other_plane = other.develop;
      if (static_cast<int>(i) != center && j != center) {
        // The edge is straight in the disc: it passes the corner on one side, which says by how many full turns the two
        // planes differ.
        const double along = v.angle + std::arg(other.disc / v.disc) * power;
        const int turns = disc.fan().boundary ? 0 : static_cast<int>(std::lround((along - other.angle) / cone));
        const int sixths = turns * disc.fan().valence();
        to_other_plane = Transition{((sixths % 6) + 6) % 6, {}} * to_other_plane;
      }
      const Transition t = v.develop.inverse() * to_other_plane;
      move.transitions.push_back({edge, forward ? t : t.inverse()});
    });
  }
}

/// Whether the new transitions compose to the identity around every face of the region, which the lifted rim implies
/// unless the old map was folded there too.
bool closed(const CornerDisc& disc, const CornerMove& move) {
  const Atlas& atlas = disc.atlas();
  const Surface& surface = disc.surface();
  std::unordered_map<int, Transition> changed;
  for (const CornerMove::Change& t : move.transitions) changed.emplace(t.edge, t.transition);
  const auto across = [&](int h) {
    const int edge = surface.edge_of[h];
    const auto at = changed.find(edge);
    const Transition t = at == changed.end() ? atlas.transition[edge] : at->second;
    return surface.edge_halfedge[edge] == h ? t : t.inverse();
  };
  // A corner on a boundary stays where it is; where the region goes round a small hole the way there may not be the
  // same.
  const auto stays = [&](int v) { return v != move.new_corner || disc.fan().boundary; };
  const auto is_corner = [&](int v) { return v == move.new_corner || (v != disc.corner() && atlas.corner[v] >= 0); };
  for (const CornerDisc::Vertex& v : disc.vertices()) {
    if (!v.inside) continue;
    const int start = surface.halfedges.outgoing[v.vertex];
    int h = start;
    do {
      const int a = surface.halfedges.to(h), b = surface.halfedges.to(Halfedges::next(h));
      const Transition forth = across(h), beside = across(Halfedges::next(h)), back = across(Halfedges::prev(h));
      if (!is_corner(v.vertex)) {
        // At a corner transitions hold up to turns about it, so only where it lies can be compared.
        const Transition round = forth * beside;
        const Transition direct = back.inverse();
        if (!is_corner(a) && !is_corner(b) && !(round == direct)) return false;
        if (!is_corner(a) && is_corner(b) && stays(b) &&
            std::abs(round.apply(atlas.position[b]) - direct.apply(atlas.position[b])) > tolerance::kSameWay)
          return false;
        if (is_corner(a) && !is_corner(b) && stays(a) &&
            std::abs((direct * beside.inverse()).apply(atlas.position[a]) - forth.apply(atlas.position[a])) >
                tolerance::kSameWay)
          return false;
      }
      h = surface.halfedges.rotate_ccw(h);
    } while (h != start);
  }
  return true;
}

}  // namespace

bool make_move(const CornerDisc& disc, int center, CornerMove& move) {
  std::vector<CornerDisc::Vertex> vertices = disc.vertices();
  move.new_corner = vertices[center].vertex;
  place(disc, vertices, center, move);
  connect(disc, vertices, center, move);
  return closed(disc, move);
}

void exchange(Atlas& atlas, CornerMove& move) {
  assert(move.base_vertex >= 0 && move.new_corner >= 0);
  int& corner = atlas.base.vertices[move.base_vertex];
  atlas.corner[corner] = -1;
  std::swap(corner, move.new_corner);
  atlas.corner[corner] = move.base_vertex;
  for (CornerMove::Place& place : move.places) {
    std::swap(atlas.patch[place.vertex], place.chart);
    std::swap(atlas.position[place.vertex], place.position);
  }
  for (CornerMove::Change& t : move.transitions) std::swap(atlas.transition[t.edge], t.transition);
}

bool free_of_folds(const Atlas& atlas, const CornerMove& move) {
  for (const CornerMove::Place& place : move.places)
    if (local_map(atlas, place.vertex) != LocalMap::Injective) return false;
  return std::all_of(move.rim.begin(), move.rim.end(),
                     [&](int v) { return local_map(atlas, v) == LocalMap::Injective; });
}

}  // namespace gsp

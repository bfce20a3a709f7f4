#include "param/composition.h"

#include <algorithm>
#include <map>

#include "mesh/error.h"
#include "param/flatten.h"

namespace gsp {

namespace {

using Hold = PlanarRegion::Hold;

constexpr double kTouching = 0.05; // of an edge, within which its end is moved instead of splitting it
constexpr double kCrowded = 0.1;   // of their even spacing, nearer than which vertices on an edge are spaced evenly
constexpr int kSpreads = 100;

/// The lattice motion that takes two lattice points, given to rounding, to two others.
Transition motion(Complex a, Complex b, Complex a_there, Complex b_there) {
  const Eisenstein from = nearest_lattice_point(a), to = nearest_lattice_point(a_there);
  const Eisenstein along = nearest_lattice_point(b) - from, along_there = nearest_lattice_point(b_there) - to;
  for (int k = 0; k < 6; ++k)
    if (rotate(along, k) == along_there) return {k, to - rotate(from, k)};
  throw Error(Cause::Internal, "an edge between two patch corners is not as long on both sides");
}

Complex flat_point(const std::array<double, 3>& weights) { return chart_position(weights[0], weights[1]); }

}  // namespace

CoarseSurface coarse_surface(const OverlayMap& overlay) {
  const TriangleComplex& complex = overlay.complex();
  const Surface& fine = *overlay.surface();
  CoarseSurface coarse;
  std::vector<int> number(fine.mesh.positions.size(), -1);
  for (int t = 0; t < complex.slot_count(); ++t) {
    if (!complex.alive(t)) continue;
    coarse.slot.push_back(t);
    for (int v : complex.corners(t)) number[v] = 0;
  }
  Mesh mesh;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = mesh.vertex_count();
    mesh.positions.push_back(fine.mesh.positions[v]);
    coarse.vertex.push_back(static_cast<int>(v));
  }
  const std::vector<double> all_areas = overlay.areas();
  std::vector<double> areas;
  for (int t : coarse.slot) {
    const Triangle& c = complex.corners(t);
    mesh.faces.push_back({number[c[0]], number[c[1]], number[c[2]]});
    areas.push_back(all_areas[t]);
  }
  coarse.surface = std::make_shared<const Surface>(std::move(mesh), std::move(areas));
  return coarse;
}

Composition::Composition(OverlayMap& overlay, const RefinedMap& map)
    : overlay_(overlay),
      refined_(*overlay.refined_),
      map_(map),
      second_(*map.atlas.surface),
      coarse_(coarse_surface(overlay)),
      faces_of_(coarse_.slot.size()),
      vertex_(second_.mesh.positions.size(), -1),
      second_vertex_(refined_.vertex_count(), -1),
      face_of_piece_(refined_.face_slots(), -1),
      slot_of_piece_(refined_.face_slots(), -1) {
  for (int slot : coarse_.slot)
    for (int f : overlay_.pieces_[slot]) slot_of_piece_[f] = slot;
  for (int g = 0; g < second_.mesh.face_count(); ++g) {
    const int piece = map.halfedge[3 * g] / 3, face = map.refined.origin(piece);
    faces_of_[face].push_back(g);
    for (int v : map.refined.corners(piece)) corner_.push_back(map.refined.weights_in(v, face));
  }
  for (std::size_t v = 0; v < coarse_.vertex.size(); ++v) {
    vertex_[v] = coarse_.vertex[v];
    second_vertex_[coarse_.vertex[v]] = static_cast<int>(v);
  }
}

Composition::Weights Composition::place_weights(int v, int slot) const {
  const OverlayMap::Place& at = overlay_.place_[v];
  if (at.triangle >= 0) return {1.0 - at.weight1 - at.weight2, at.weight1, at.weight2};
  const Triangle& corners = overlay_.complex().corners(slot);
  Weights weights{};
  for (int k = 0; k < 3; ++k) {
    if (corners[k] == at.a) weights[k] = at.b < 0 ? 1.0 : 1.0 - at.weight1;
    if (corners[k] == at.b) weights[k] = at.weight1;
  }
  return weights;
}

Complex Composition::flat_in(int v, int slot) const { return flat_point(place_weights(v, slot)); }

/// Any places on the edge will do, in the same order: where some are too near each other for the pieces between them, all
/// are spaced evenly.
void Composition::space(int edge, EdgeVertices& vertices) {
  const double even = 1.0 / (vertices.size() + 1);
  double before = 0.0, nearest = 1.0 - vertices.back().first;
  for (const auto& [share, w] : vertices) {
    nearest = std::min(nearest, share - before);
    before = share;
  }
  if (nearest > kCrowded * even) return;
  const Surface& coarse = *coarse_.surface;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i].first = (i + 1) * even;
    const int start = second_.halfedges.outgoing[vertices[i].second];
    int h = start;
    do {
      const int face = coarse_face(h);
      for (int k = 0; k < 3; ++k) {
        if (coarse.edge_of[3 * face + k] != edge) continue;
        const double share = coarse.edge_halfedge[edge] == 3 * face + k ? vertices[i].first : 1.0 - vertices[i].first;
        corner_[h] = {};
        corner_[h][k] = 1.0 - share;
        corner_[h][(k + 1) % 3] = share;
      }
      h = second_.halfedges.rotate_ccw(h);
    } while (h != start);
  }
}

/// The same for the vertices inside a coarse face: where faces are thin there, its vertices are spread to the middles of their
/// neighbours, which leaves no fold (Tutte 1963).
void Composition::spread(int face, const std::vector<int>& inside) {
  const bool thin = std::any_of(faces_of_[face].begin(), faces_of_[face].end(), [&](int g) {
    return thickness(flat_point(corner_[3 * g]), flat_point(corner_[3 * g + 1]), flat_point(corner_[3 * g + 2])) < kThin;
  });
  for (int pass = 0; thin && pass < kSpreads; ++pass)
    for (int w : inside) {
      Weights middle{};
      int neighbours = 0;
      const int start = second_.halfedges.outgoing[w];
      int h = start;
      do {
        for (int k = 0; k < 3; ++k) middle[k] += corner_[Halfedges::next(h)][k];
        ++neighbours;
        h = second_.halfedges.rotate_ccw(h);
      } while (h != start);
      for (double& weight : middle) weight /= neighbours;
      do {
        corner_[h] = middle;
        h = second_.halfedges.rotate_ccw(h);
      } while (h != start);
    }
}

/// Makes them vertices of the overlay.
bool Composition::cut_edge(int edge, const EdgeVertices& vertices) {
  const int side = coarse_.surface->edge_halfedge[edge];
  const int a = coarse_.vertex[coarse_.surface->halfedges.from(side)], b = coarse_.vertex[coarse_.surface->halfedges.to(side)];
  const auto share_of = [&](int v) {
    const OverlayMap::Place& at = overlay_.place_[v];
    return v == a ? 0.0 : v == b ? 1.0 : at.b == b ? at.weight1 : 1.0 - at.weight1;
  };
  const auto next = [&](int v) {  // half-edge to the next vertex along the edge
    int along = -1;
    refined_.for_each_outgoing(v, [&](int h) {
      const int to = refined_.to(h);
      if (to != v && OverlayMap::on_side(overlay_.place_[to], a, b) && share_of(to) > share_of(v)) along = h;
    });
    return along;
  };
  int at = a;
  for (const auto& [share, w] : vertices) {
    int h = next(at);
    while (h >= 0 && share_of(refined_.to(h)) < share) h = next(at = refined_.to(h));
    if (h < 0) return false;
    const double before = share_of(at), after = share_of(refined_.to(h)), local = (share - before) / (after - before);
    int made = -1;
    if (local < kTouching && slide(at, share, a, b)) made = at;
    if (made < 0 && local > 1.0 - kTouching && slide(refined_.to(h), share, a, b)) made = refined_.to(h);
    if (made < 0) {
      const int twin = refined_.twin(h);
      if (!(local > 0.0 && local < 1.0) || twin < 0) return false;
      const int slots[2] = {slot_of_piece_[h / 3], slot_of_piece_[twin / 3]};
      made = refined_.split(h, local);
      for (int slot : slots) {
        overlay_.pieces_[slot].push_back(static_cast<int>(slot_of_piece_.size()));
        slot_of_piece_.push_back(slot);
      }
      overlay_.place_.push_back({-1, a, b, share, 0.0});
      second_vertex_.push_back(-1);
    }
    vertex_[w] = made;
    second_vertex_[made] = w;
    at = made;
  }
  return true;
}

/// Moves a vertex along an edge of the complex to a share of it, if its pieces stay upright.
bool Composition::slide(int v, double share, int a, int b) {
  if (second_vertex_[v] >= 0) return false;
  const OverlayMap::Place before = overlay_.place_[v];
  overlay_.place_[v] = {-1, a, b, share, 0.0};
  bool possible = true;
  refined_.for_each_outgoing(v, [&](int h) {
    const int slot = slot_of_piece_[h / 3];
    const Complex x = flat_in(refined_.to(h), slot), y = flat_in(refined_.from(Halfedges::prev(h)), slot);
    possible = possible && thickness(flat_in(v, slot), x, y) > kThin * kWorse;
  });
  if (!possible) overlay_.place_[v] = before;
  return possible;
}

bool Composition::cut() {
  // The second surface's own vertices, by the edge or face of the complex where they lie.
  std::map<int, EdgeVertices> on_edge;
  std::vector<std::vector<int>> inside(coarse_.slot.size());
  std::vector<char> seen(vertex_.size(), 0);
  const Surface& coarse = *coarse_.surface;
  for (int h = 0; h < static_cast<int>(corner_.size()); ++h) {
    const int w = second_.halfedges.from(h), face = coarse_face(h);
    if (vertex_[w] >= 0 || seen[w]) continue;
    seen[w] = 1;
    const Weights& weights = corner_[h];
    const int zero = static_cast<int>(std::min_element(weights.begin(), weights.end()) - weights.begin());
    if (weights[zero] != 0.0) {
      inside[face].push_back(w);
      continue;
    }
    const int side = 3 * face + (zero + 1) % 3, edge = coarse.edge_of[side];
    const double share = weights[(zero + 2) % 3];
    on_edge[edge].emplace_back(coarse.edge_halfedge[edge] == side ? share : 1.0 - share, w);
  }
  for (auto& [edge, vertices] : on_edge) {
    std::sort(vertices.begin(), vertices.end());
    space(edge, vertices);
    if (!cut_edge(edge, vertices)) return false;
  }
  for (std::size_t c = 0; c < coarse_.slot.size(); ++c) {
    if (faces_of_[c].size() > 1) {
      if (!cut_face(static_cast<int>(c), inside[c])) return false;
      continue;
    }
    face_of_piece_.resize(refined_.face_slots(), -1);
    for (int f : overlay_.pieces_[coarse_.slot[c]]) face_of_piece_[f] = faces_of_[c].front();
  }
  return true;
}

/// Cuts the pieces in one triangle of the complex along the second surface's edges inside it.
bool Composition::cut_face(int face, const std::vector<int>& inside) {
  const int slot = coarse_.slot[face];
  PlanarRegion& region = overlay_.region_;
  std::vector<int> pieces;
  for (int f : overlay_.pieces_[slot])
    if (refined_.alive(f)) pieces.push_back(f);
  region.begin(pieces);
  for (int v : region.vertices())
    region.place(v, flat_in(v, slot), overlay_.place_[v].triangle >= 0 ? Hold::Free : Hold::Ring);
  bool possible = true;
  region.relax();
  spread(face, inside);
  for (int w : inside) {
    vertex_[w] = region.insert(flat_point(corner_[second_.halfedges.outgoing[w]]));
    if (vertex_[w] < 0) return false;
    region.relax();
  }
  std::vector<Line> lines;
  for (int g : faces_of_[face])
    for (int h = 3 * g; h < 3 * g + 3; ++h) {
      const int twin = second_.halfedges.twin[h];
      if (twin > h && coarse_face(twin) == face)
        lines.emplace_back(vertex_[second_.halfedges.from(h)], vertex_[second_.halfedges.to(h)]);
    }
  for (const Line& line : lines) {
    possible = possible && region.cut(line.first, line.second);
    if (possible) region.relax();
  }
  overlay_.place_.resize(refined_.vertex_count());
  second_vertex_.resize(refined_.vertex_count(), -1);
  for (int w : inside) second_vertex_[vertex_[w]] = w;
  for (int v : region.vertices()) {
    OverlayMap::Place& at = overlay_.place_[v];
    if (at.triangle < 0 && at.a >= 0) continue;
    const auto w = chart_barycentric(region.flat(v));
    at = {slot, -1, -1, w[1], w[2]};
  }
  possible = possible && distribute(face, lines);
  region.leave();
  return possible;
}

/// Gives the parts into which the lines cut a triangle's pieces to the second surface's faces in it.
bool Composition::distribute(int face, const std::vector<Line>& lines) {
  const int slot = coarse_.slot[face];
  const PlanarRegion& region = overlay_.region_;
  const auto on = [&](int v, const Line& line) {
    return v == line.first || v == line.second || (region.hold(v) == Hold::Edge && region.line(v) == line);
  };
  const auto is_cut = [&](int p, int q) {
    return std::any_of(lines.begin(), lines.end(), [&](const Line& line) { return on(p, line) && on(q, line); });
  };
  face_of_piece_.resize(refined_.face_slots(), -1);
  slot_of_piece_.resize(refined_.face_slots(), slot);
  overlay_.pieces_[slot] = region.faces();
  for (int f : region.faces()) face_of_piece_[f] = -1;
  std::vector<int> part;
  std::vector<char> given(faces_of_[face].size(), 0);
  for (int seed : region.faces()) {
    if (face_of_piece_[seed] >= 0) continue;
    part.assign(1, seed);
    face_of_piece_[seed] = second_.mesh.face_count();  // taken, owner not known yet
    for (std::size_t i = 0; i < part.size(); ++i)
      for (int h = 3 * part[i]; h < 3 * part[i] + 3; ++h) {
        const int other = refined_.twin(h);
        if (other < 0 || !region.holds_face(other / 3) || face_of_piece_[other / 3] >= 0 ||
            is_cut(refined_.from(h), refined_.to(h)))
          continue;
        face_of_piece_[other / 3] = second_.mesh.face_count();
        part.push_back(other / 3);
      }
    // The face that holds the middle of the largest piece holds the part.
    const int largest = *std::max_element(part.begin(), part.end(),
                                          [&](int a, int b) { return region.area(a) < region.area(b); });
    const Triangle& t = refined_.corners(largest);
    const Complex middle = (region.flat(t[0]) + region.flat(t[1]) + region.flat(t[2])) / 3.0;
    std::size_t owner = 0;
    double best = -1e300;
    for (std::size_t i = 0; i < given.size(); ++i) {
      const int g = faces_of_[face][i];
      const auto w = barycentric(middle, flat_point(corner_[3 * g]), flat_point(corner_[3 * g + 1]), flat_point(corner_[3 * g + 2]));
      const double least = std::min({w[0], w[1], w[2]});
      if (least <= best) continue;
      best = least;
      owner = i;
    }
    const int g = faces_of_[face][owner];
    const double whole = chart_area(flat_point(corner_[3 * g]), flat_point(corner_[3 * g + 1]), flat_point(corner_[3 * g + 2]));
    if (given[owner]) return false;
    given[owner] = 1;
    for (int f : part) {
      if (!(region.area(f) > kLeastPiece * whole)) return false;
      face_of_piece_[f] = g;
    }
  }
  return std::all_of(given.begin(), given.end(), [](char g) { return g; });
}

/// From the frame of the face of half-edge h of the second surface to that of its neighbour.
Transition Composition::across(int h) const {
  const int twin = second_.halfedges.twin[h];
  const int ends[2] = {second_.halfedges.from(h), second_.halfedges.to(h)};
  const int here[2] = {h % 3, (h % 3 + 1) % 3}, there[2] = {(twin % 3 + 1) % 3, twin % 3};
  for (int i = 0; i < 2; ++i)
    if (map_.atlas.corner[ends[i]] < 0)
      return frames_[twin / 3].to_chart[there[i]] * frames_[h / 3].to_chart[here[i]].inverse();
  // Between two patch corners transitions hold up to turns.
  const auto place = [&](int face, int corner, int i) {
    return frames_[face].to_chart[corner].apply(map_.atlas.position[ends[i]]);
  };
  return motion(place(h / 3, here[0], 0), place(h / 3, here[1], 1), place(twin / 3, there[0], 0), place(twin / 3, there[1], 1));
}

/// From the frame of a face of the second surface to the chart of a vertex of one of its pieces.
Transition Composition::to_home(int v, int face) const {
  const int w = second_vertex_[v];
  if (w >= 0) {
    const Triangle& t = second_.mesh.faces[face];
    const int k = static_cast<int>(std::find(t.begin(), t.end(), w) - t.begin());
    return frames_[face].to_chart[k].inverse();
  }
  if (home_[v] == face) return from_home_[v];
  for (int h = 3 * face; h < 3 * face + 3; ++h)
    if (second_.halfedges.twin[h] >= 0 && second_.halfedges.twin[h] / 3 == home_[v]) return from_home_[v] * across(h);
  throw Error(Cause::Internal, "a vertex on an edge of the complex lies in neither triangle beside it", Element::Vertex, v);
}

/// From the frame of a face of the second surface to the chart of the base's boundary edge along which its half-edge h, which has
/// no twin, runs.
Transition Composition::to_boundary_chart(int h, int& chart) const {
  const Atlas& atlas = map_.atlas;
  const Atlas::FaceFrame& frame = frames_[h / 3];
  const int ends[2] = {second_.halfedges.from(h), second_.halfedges.to(h)}, at[2] = {h % 3, (h % 3 + 1) % 3};
  for (int i = 0; i < 2; ++i)
    if (atlas.corner[ends[i]] < 0) {
      chart = atlas.patch[ends[i]];
      return frame.to_chart[at[i]].inverse();
    }
  for (const BaseFan::Sector& s : atlas.fans[atlas.corner[ends[0]]].sectors) {
    const int next = (s.corner + 1) % 3;
    if (atlas.base.twins[3 * s.face + s.corner] >= 0 || atlas.base.faces[s.face][next] != atlas.corner[ends[1]]) continue;
    chart = s.face;
    return motion(frame.to_chart[at[0]].apply(atlas.position[ends[0]]), frame.to_chart[at[1]].apply(atlas.position[ends[1]]),
                  kChartCorners[s.corner].value(), kChartCorners[next].value());
  }
  throw Error(Cause::Internal, "a boundary edge between two patch corners is none of the base", Element::Edge, second_.edge_of[h]);
}

RefinedMap Composition::finish() {
  for (int g = 0; g < second_.mesh.face_count(); ++g) frames_.push_back(map_.atlas.face_frame(g));
  RefinedSurface::Compact compact = refined_.compact();
  Atlas atlas;
  atlas.surface = std::make_shared<const Surface>(std::move(compact.mesh));
  const Surface& surface = *atlas.surface;
  const int count = surface.mesh.vertex_count();
  atlas.base = map_.atlas.base;
  atlas.fans = map_.atlas.fans;
  atlas.patch.assign(count, -1);
  atlas.position.assign(count, 0.0);
  atlas.corner.assign(count, -1);
  home_.assign(refined_.vertex_count(), -1);
  from_home_.assign(refined_.vertex_count(), {});
  const auto piece_of = [&](int f) { return compact.halfedge[3 * f] / 3; };
  for (int f = 0; f < surface.mesh.face_count(); ++f) {
    const int piece = piece_of(f), g = face_of_piece_[piece];
    const auto z = map_.atlas.face_corners(g, frames_[g]);
    for (int v : refined_.corners(piece)) {
      if (home_[v] >= 0) continue;
      home_[v] = g;
      const int number = compact.vertex[v], w = second_vertex_[v];
      if (w >= 0) {
        atlas.patch[number] = map_.atlas.patch[w];
        atlas.position[number] = map_.atlas.position[w];
        atlas.corner[number] = map_.atlas.corner[w];
        if (atlas.corner[number] >= 0) atlas.base.vertices[atlas.corner[number]] = number;
        continue;
      }
      const Complex at = flat_in(v, slot_of_piece_[piece]);
      const auto weights = barycentric(at, flat_point(corner_[3 * g]), flat_point(corner_[3 * g + 1]), flat_point(corner_[3 * g + 2]));
      atlas.patch[number] = frames_[g].chart;
      atlas.position[number] = weights[0] * z[0] + weights[1] * z[1] + weights[2] * z[2];
      if (!surface.halfedges.boundary_vertex(number)) continue;
      const int opposite = static_cast<int>(std::min_element(weights.begin(), weights.end()) - weights.begin());
      from_home_[v] = to_boundary_chart(3 * g + (opposite + 1) % 3, atlas.patch[number]);
      atlas.position[number] = from_home_[v].apply(atlas.position[number]);
    }
  }
  for (int e = 0; e < surface.edge_count(); ++e) {
    const int h = surface.edge_halfedge[e], own = compact.halfedge[h], g = face_of_piece_[own / 3];
    atlas.transition.push_back(to_home(refined_.from(own), g) * to_home(refined_.to(own), g).inverse());
  }
  return {std::move(refined_), std::move(atlas), std::move(compact.vertex), std::move(compact.halfedge)};
}

}  // namespace gsp

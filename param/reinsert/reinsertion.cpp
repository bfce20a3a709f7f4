#include "param/reinsert/reinsertion.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "param/energy/distortion_energy.h"
#include "param/energy/newton_descent.h"
#include "param/reinsert/insert_by_cutting.h"
#include "param/reinsert/visibility_kernel.h"
#include "param/removal/flatten.h"

namespace gsp {

namespace {

constexpr int kRings = 1;  // around a hole, that are moved to give it room, doubled with every attempt
constexpr int kAttempts = 2;
constexpr int kSteps = 8;
constexpr double kRoom = 10.0;      // weight of the hole's shape over the shapes around it, to the power of the attempt
constexpr double kFlattest = 0.02;  // height over longest side of a triangle that the hole should be made of

class Reinsertion {
 public:
  Reinsertion(const RemovalRecord& decimation, const EditableAtlas& map) : map_(decimation, map), hole_(map_) {}

  /// The vertex that found no place, after which nothing is done; none where all did.
  std::optional<int> run() {
    for (int i = map_.decimation.size() - 1; i >= 0; --i)
      if (!insert(i)) return hole_.star.center;
    return std::nullopt;
  }
  EditableAtlas finish() && { return std::move(map_).finish(); }

 private:
  bool insert(int removal);
  bool develop();
  bool seat_on_boundary();
  void lay_border();
  bool place();
  Complex wanted_place() const;
  void take_home_chart();
  bool make_room(int rings, double importance);
  void want_star(const Atlas& part, const std::vector<int>& faces, double importance,
                 std::vector<ReferenceShape>& shapes) const;
  void make_fan();

  ReinsertionMap map_;
  StarHole hole_;

  // Of the removal in hand.
  int chart_ = -1;                ///< that the hole is laid into
  std::vector<Transition> into_;  ///< per side, from its vertex's chart to that
  std::vector<Complex> polygon_;  ///< per side, where it starts
  Complex center_;
};

/// Lays the hole into one chart: that of a vertex on the boundary where the star is on one.
bool Reinsertion::develop() {
  const std::vector<StarHole::Side>& border = hole_.border;
  const auto face_with = [&](const StarHole::Side& side) {
    return (side.halfedge >= 0 ? side : border[border.size() - 2]).halfedge / 3;
  };
  int start = hole_.region.front();
  for (const StarHole::Side& side : border)
    if (map_.loose.corner[side.vertex] < 0) start = face_with(side);
  if (hole_.star.boundary)
    for (const StarHole::Side* side : {&border.back(), &border.front()})
      if (map_.loose.corner[side->vertex] < 0) start = face_with(*side);
  polygon_.clear();
  std::vector<char> developed(hole_.region.size(), 0);
  const auto mark = [&](int face) {  // whether it was not marked before
    char& is = developed[std::find(hole_.region.begin(), hole_.region.end(), face) - hole_.region.begin()];
    return !std::exchange(is, 1);
  };
  mark(start);
  std::vector<std::pair<int, Atlas::FaceFrame>> open{{start, map_.frame(start)}};
  chart_ = open.front().second.chart;
  into_.assign(border.size(), {});
  for (std::size_t i = 0; i < open.size(); ++i) {
    const auto [face, frame] = open[i];
    for (int k = 0; k < 3; ++k) {
      const int h = 3 * face + k, twin = map_.links.twin[h];
      if (hole_.is_side(h)) {
        const auto side =
            std::find_if(border.begin(), border.end(), [&](const StarHole::Side& s) { return s.halfedge == h; });
        const std::size_t j = side - border.begin();
        into_[j] = frame.to_chart[k];
        if (hole_.star.boundary && j + 2 == border.size()) into_[j + 1] = frame.to_chart[(k + 1) % 3];
        continue;
      }
      if (twin < 0 || !mark(twin / 3)) continue;
      const auto next = map_.frame_across(h, frame);
      if (!next) return false;
      open.emplace_back(twin / 3, *next);
    }
  }
  lay_border();
  return !hole_.star.boundary || seat_on_boundary();
}

void Reinsertion::lay_border() {
  polygon_.clear();
  for (std::size_t j = 0; j < hole_.border.size(); ++j)
    polygon_.push_back(into_[j].apply(map_.loose.position[hole_.border[j].vertex]));
}

/// A boundary star between two patch corners: the hole goes to the chart of the base edge between them.
bool Reinsertion::seat_on_boundary() {
  const int first = hole_.border.front().vertex, last = hole_.border.back().vertex;
  if (map_.loose.corner[first] < 0 || map_.loose.corner[last] < 0) return true;
  const auto seat = map_.boundary_seat(last, first, polygon_.back(), polygon_.front());
  if (!seat) return false;
  chart_ = seat->chart;
  for (Transition& t : into_) t = seat->change * t;
  lay_border();
  return true;
}

/// Where the filling has the middle of the star's plane.
Complex Reinsertion::wanted_place() const {
  Complex wanted = 0.0;
  double most = -1e300;
  for (const RingTriangle& t : hole_.filling) {
    const auto w = barycentric(0.0, hole_.ring[t[0]], hole_.ring[t[1]], hole_.ring[t[2]]);
    const double least = std::min({w[0], w[1], w[2]});
    if (least <= most) continue;
    most = least;
    wanted = 0.0;
    for (int k = 0; k < 3; ++k) wanted += w[k] * polygon_[hole_.side_of_ring[t[k]]];
  }
  return wanted;
}

bool Reinsertion::place() {
  const Kernel kernel{polygon_, hole_.star.boundary};
  const auto at = hole_.star.boundary ? kernel.place_on_chord(hole_.share_of_boundary()) : kernel.place(wanted_place());
  if (at) center_ = *at;
  return at.has_value();
}

/// Gives the hole the chart in which the centre lies: the way there from a vertex of the border is straight.
void Reinsertion::take_home_chart() {
  for (std::size_t j = 0; !inside_chart(center_) && j < hole_.border.size(); ++j) {
    const int w = hole_.border[j].vertex;
    if (map_.loose.corner[w] >= 0 || !inside_chart(map_.loose.position[w])) continue;
    const Transition back = into_[j].inverse();
    const auto arrival = follow(map_.base, map_.loose.patch[w], map_.loose.position[w], back.apply(center_));
    if (!arrival) continue;
    const Transition change = arrival->change * back;
    chart_ = arrival->chart;
    center_ = change.apply(center_);
    for (Transition& t : into_) t = change * t;
    return;
  }
}

/// Sets the shapes of the hole's faces to those they have in the plane of the star. `faces`: those of the part.
void Reinsertion::want_star(const Atlas& part, const std::vector<int>& faces, double importance,
                            std::vector<ReferenceShape>& shapes) const {
  std::vector<std::pair<std::size_t, std::array<Complex, 3>>> flat;
  double flat_area = 0.0, area = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    weight += shapes[i].weight / faces.size();
    if (!hole_.holds(faces[i])) continue;
    const Triangle& t = map_.links.faces[faces[i]];
    flat.push_back({i, {hole_.in_plane(t[0]), hole_.in_plane(t[1]), hole_.in_plane(t[2])}});
    const auto& p = flat.back().second;
    flat_area += std::max(0.0, chart_area(p[0], p[1], p[2]));
    const auto z = part.face_corners(static_cast<int>(i), part.face_frame(static_cast<int>(i)));
    area += chart_area(z[0], z[1], z[2]);
  }
  const double scale = std::sqrt(area / flat_area);
  for (const auto& [i, p] : flat) {
    const Complex a = scale * (p[1] - p[0]), b = scale * (p[2] - p[0]);
    const double least = kFlattest * std::max({std::abs(a), std::abs(b), std::abs(b - a)});
    const double base = std::max(std::abs(a), least), height = std::max(cross(a, b) / base, least);
    const double along = std::real(std::conj(a) * b) / base;
    shapes[i] = {{1.0 / base, -along / (base * height), 1.0 / height}, importance * weight};
  }
}

/// Moves what is within so many rings of the hole so that the hole becomes like the star in the plane, without folds.
/// Tells whether the centre has found a place.
bool Reinsertion::make_room(int rings, double importance) {
  const std::vector<int> faces = hole_.faces_within(rings);
  std::vector<int> vertices, all(faces.size()), moving;
  Atlas part = map_.part(faces, vertices);
  std::iota(all.begin(), all.end(), 0);
  for (int v = 0; v < static_cast<int>(vertices.size()); ++v)
    if (part.is_free(v)) moving.push_back(v);
  if (moving.empty()) return false;
  std::vector<ReferenceShape> shapes = reference_shapes(part, all);
  want_star(part, faces, importance, shapes);
  const DistortionEnergy energy(part, moving, all, shapes, kMapAreaWeight);
  std::vector<double> x = energy.positions(part);
  NewtonDescent descent(energy, x);
  for (int step = 0; step < kSteps; ++step) {
    if (descent.step() <= 0.0) return false;
    energy.write_back(x, part);
    for (int v : moving) map_.loose.position[vertices[v]] = part.position[v];
    lay_border();
    if (place()) return true;
  }
  return false;
}

/// Takes the region out and puts the faces around the centre in.
void Reinsertion::make_fan() {
  TriangleLinks& links = map_.links;
  LooseMap& loose = map_.loose;
  const Star& star = hole_.star;
  const std::vector<StarHole::Side>& border = hole_.border;
  const std::vector<int>& region = hole_.region;
  const int v = star.center, count = static_cast<int>(border.size()), sides = count - star.boundary;
  std::vector<int> outer;
  std::vector<Transition> along;
  for (int j = 0; j < sides; ++j) {
    outer.push_back(links.twin[border[j].halfedge]);
    along.push_back(loose.transition[border[j].halfedge]);
  }
  for (int f : region) {
    for (int w : links.faces[f])
      if (map_.is_added(w)) links.outgoing[w] = -1;
    links.faces[f] = {-1, -1, -1};
  }
  std::vector<int> place(region.begin(), region.begin() + std::min<std::size_t>(region.size(), sides));
  for (int f = static_cast<int>(links.faces.size()); static_cast<int>(place.size()) < sides; ++f) place.push_back(f);
  const std::size_t slots =
      std::max<std::size_t>(links.faces.size(), *std::max_element(place.begin(), place.end()) + 1);
  links.faces.resize(slots, {-1, -1, -1});
  links.twin.resize(3 * slots, -1);
  loose.transition.resize(3 * slots);
  map_.slot.resize(slots, -1);
  loose.patch[v] = chart_;
  loose.position[v] = center_;
  for (int j = 0; j < sides; ++j) {
    const int f = place[j], next = (j + 1) % count;
    links.faces[f] = {v, border[j].vertex, border[next].vertex};
    map_.slot[f] = border[j].slot;
    links.twin[3 * f] = j > 0 ? 3 * place[j - 1] + 2 : star.boundary ? -1 : 3 * place[sides - 1] + 2;
    links.twin[3 * f + 1] = -1;
    links.join(3 * f + 1, outer[j]);
    links.twin[3 * f + 2] = j + 1 < sides ? 3 * place[j + 1] : star.boundary ? -1 : 3 * place[0];
    loose.transition[3 * f] = into_[j];
    loose.transition[3 * f + 1] = along[j];
    loose.transition[3 * f + 2] = into_[next].inverse();
    links.outgoing[border[j].vertex] = 3 * f + 1;
    links.outgoing[border[next].vertex] = 3 * f + 2;
  }
  links.outgoing[v] = 3 * place[0];
}

bool Reinsertion::insert(int removal) {
  if (!hole_.open(removal)) return false;
  bool placed = develop() && place();
  double importance = kRoom;
  for (int attempt = 0; !placed && !polygon_.empty() && attempt < kAttempts; ++attempt, importance *= kRoom)
    placed = make_room(kRings << attempt, importance);
  if (!placed) return cut_in(hole_);
  if (!hole_.star.boundary) take_home_chart();
  make_fan();
  return true;
}

}  // namespace

std::optional<EditableAtlas> reinsert(const RemovalRecord& decimation, const EditableAtlas& map,
                                      std::optional<int>* unplaced) {
  Reinsertion reinsertion(decimation, map);
  if (const std::optional<int> vertex = reinsertion.run()) {
    if (unplaced) *unplaced = vertex;
    return std::nullopt;
  }
  return std::move(reinsertion).finish();
}

}  // namespace gsp

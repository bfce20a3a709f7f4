#include "coder/base_connectivity.h"

#include <algorithm>
#include <bit>
#include <unordered_map>

#include "coder/base_creases.h"
#include "coder/bit_model.h"
#include "coder/range_coder.h"
#include "mesh/edge.h"
#include "mesh/error.h"

namespace gsp {

namespace {

constexpr int kNone = -1;

std::uint64_t directed(int from, int to) {
  return (static_cast<std::uint64_t>(from) << 32) | static_cast<std::uint32_t>(to);
}

/// The part of the surface that both sides know: its faces and the cyclic borders around it. Half-edge 3f + k runs from
/// corner k to corner k+1 of face f.
class GrowingSurface {
 public:
  std::vector<Triangle> faces;
  std::vector<int> faces_around;  ///< #V

  int vertex_count() const { return static_cast<int>(faces_around.size()); }
  int new_vertex() {
    faces_around.push_back(0);
    return vertex_count() - 1;
  }
  int from(int h) const { return faces[h / 3][h % 3]; }
  int to(int h) const { return faces[h / 3][(h % 3 + 1) % 3]; }
  int before(int h) const { return previous_[h]; }
  int after(int h) const { return next_[h]; }
  bool open(int h) const { return state_[h] == State::Open; }
  void close_as_boundary(int h) { state_[h] = State::Boundary; }
  bool has(int from, int to) const { return sides_.count(directed(from, to)) != 0; }

  /// Adds a face and sews its sides to the open sides that they meet. False where a side exists already.
  bool add(const Triangle& t) {
    const int first = 3 * static_cast<int>(faces.size());
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return false;
    for (int k = 0; k < 3; ++k) {
      if (has(t[k], t[(k + 1) % 3])) return false;
      const auto opposite = sides_.find(directed(t[(k + 1) % 3], t[k]));
      if (opposite != sides_.end() && !open(opposite->second)) return false;
    }
    faces.push_back(t);
    for (int k = 0; k < 3; ++k) {
      ++faces_around[t[k]];
      sides_.emplace(directed(t[k], t[(k + 1) % 3]), first + k);
      next_.push_back(first + (k + 1) % 3);
      previous_.push_back(first + (k + 2) % 3);
      state_.push_back(State::Open);
    }
    for (int k = 0; k < 3; ++k) {
      const auto opposite = sides_.find(directed(t[(k + 1) % 3], t[k]));
      if (opposite != sides_.end()) sew(first + k, opposite->second);
    }
    return true;
  }

 private:
  enum class State : std::uint8_t { Open, Boundary, Sewn };

  void sew(int g, int h) {
    const int before_g = previous_[g], after_g = next_[g], before_h = previous_[h], after_h = next_[h];
    link(before_g, after_h);
    link(before_h, after_g);
    state_[g] = state_[h] = State::Sewn;
  }
  void link(int a, int b) {
    next_[a] = b;
    previous_[b] = a;
  }

  std::vector<int> next_, previous_;  ///< along the borders
  std::vector<State> state_;
  std::unordered_map<std::uint64_t, int> sides_;
};

class Writer {
 public:
  explicit Writer(Bytes& out) : coder_(out) {}
  bool decide(bool actual, AdaptiveBit& context) {
    coder_.encode(actual, context.set);
    context.update(actual, kMemory);
    return actual;
  }
  bool plain(bool actual) {
    coder_.encode(actual, 32768);
    return actual;
  }
  void finish() { coder_.finish(); }

 private:
  static constexpr int kMemory = 60;
  RangeEncoder coder_;
};

class Reader {
 public:
  Reader(const std::uint8_t* begin, const std::uint8_t* end) : coder_(begin, end) {}
  bool decide(bool, AdaptiveBit& context) {
    const bool bit = coder_.decode(context.set);
    context.update(bit, kMemory);
    return bit;
  }
  bool plain(bool) { return coder_.decode(32768); }

 private:
  static constexpr int kMemory = 60;
  RangeDecoder coder_;
};

/// Where the face beyond a side has its third corner. The encoder fills it in, the decoder receives it.
struct Third {
  bool boundary = false;
  int vertex = kNone;  ///< kNone: one not seen before
};

template <class Side>
class ConnectivityCoder {
 public:
  explicit ConnectivityCoder(Side& side) : side_(side) {
    // How likely a fan of so many faces is closed by the next one, from the valences that simplification leaves.
    constexpr double kClosing[kFanClasses] = {0.01, 0.01, 0.03, 0.13, 0.33, 0.5, 0.55, 0.55, 0.55, 0.55, 0.55, 0.55};
    for (int n = 0; n < kFanClasses; ++n) closes_[0][n] = closes_[1][n] = expecting(kClosing[n]);
    boundary_ = expecting(0.02);
    other_ = expecting(0.05);
    seen_before_ = expecting(0.02);
  }

  GrowingSurface surface;

  bool finished() const { return gates_.empty(); }

  /// The next side to add a face at, kNone where a new component must be started.
  int next_gate() {
    while (!gates_.empty()) {
      const int gate = gates_.back();
      gates_.pop_back();
      if (surface.open(gate)) return gate;
    }
    return kNone;
  }

  Third code_third(int gate, const Third& actual) {
    Third third;
    third.boundary = side_.decide(actual.boundary, boundary_);
    if (third.boundary) return third;
    // Clockwise around the gate's first vertex, then counter-clockwise around its second.
    const int before = surface.before(gate), after = surface.after(gate);
    for (const auto& [neighbour, pivot, vertex, which] :
         {std::tuple{before, surface.from(gate), surface.from(before), 0},
          std::tuple{after, surface.to(gate), surface.to(after), 1}}) {
      if (!surface.open(neighbour)) continue;
      AdaptiveBit& context = closes_[which][std::min(surface.faces_around[pivot], kFanClasses - 1)];
      if (side_.decide(actual.vertex == vertex, context)) {
        third.vertex = vertex;
        return third;
      }
    }
    if (side_.decide(actual.vertex != kNone, other_)) third.vertex = code_index(actual.vertex);
    return third;
  }

  int code_seed_vertex(int actual) {
    if (surface.vertex_count() == 0 || !side_.decide(actual != kNone, seen_before_)) return kNone;
    return code_index(actual);
  }

  /// Gates of a new face, in an order that stays with the first vertex of the last gate until its fan is closed.
  void push_gates(int face) {
    for (int k : {0, 2, 1}) gates_.push_back(3 * face + k);
  }

 private:
  static constexpr int kFanClasses = 12;

  int code_index(int actual) {
    int index = 0;
    for (int b = std::bit_width(static_cast<unsigned>(surface.vertex_count() - 1)) - 1; b >= 0; --b)
      index |= side_.plain(actual >> b & 1) << b;
    return index;
  }

  Side& side_;
  std::vector<int> gates_;
  std::array<std::array<AdaptiveBit, kFanClasses>, 2> closes_;
  AdaptiveBit boundary_, other_, seen_before_;
};

/// Names of the input's faces and vertices on the way to the coded order.
class Renaming {
 public:
  explicit Renaming(const std::vector<Triangle>& faces) : faces_(faces), done_(faces.size(), false) {
    int vertices = 0;
    for (const Triangle& t : faces)
      for (int v : t) vertices = std::max(vertices, v + 1);
    coded_vertex_.assign(vertices, kNone);
    sides_.reserve(3 * faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (int k = 0; k < 3; ++k) sides_.emplace(directed(faces[f][k], faces[f][(k + 1) % 3]), 3 * f + k);
  }

  CodedBase base;

  /// Half-edge of the input's face beyond coded side (from, to), kNone on a boundary.
  int beyond(int from, int to) const {
    const auto side = sides_.find(directed(base.source_vertex[to], base.source_vertex[from]));
    return side == sides_.end() ? kNone : side->second;
  }
  int next_component() {
    while (done_[first_left_]) ++first_left_;
    return 3 * first_left_;
  }
  int coded(int vertex) const { return coded_vertex_[vertex]; }
  int source_corner(int h, int k) const { return faces_[h / 3][(h % 3 + k) % 3]; }
  void name(int vertex, int coded) {
    coded_vertex_[vertex] = coded;
    base.source_vertex.push_back(vertex);
  }
  void take(int h) {
    done_[h / 3] = true;
    base.source_face.push_back(h / 3);
    base.source_corner.push_back(h % 3);
  }

 private:
  const std::vector<Triangle>& faces_;
  std::vector<bool> done_;
  std::vector<int> coded_vertex_;
  std::unordered_map<std::uint64_t, int> sides_;
  int first_left_ = 0;
};

/// Creases of a base, after its faces, and their corners. `base` names those of the encoder and receives the decoder's.
template <class Side>
void code_creases(CodedBase& base, Side& side) {
  const SubdivisionLevel level = base_level(base.vertices, base.faces, base.creases, base.corners);
  const std::vector<char> found = CreaseCoder<Side>(level, side).run(level.creased);
  base.creases.clear();
  for (int e = 0; e < level.edge_count(); ++e)
    if (found[e]) base.creases.push_back(ascending(level.edges[e][0], level.edges[e][1]));
  std::sort(base.creases.begin(), base.creases.end());

  const std::vector<VertexFan> actual = vertex_fans(level);
  const std::vector<VertexFan> fans = vertex_fans(base_level(base.vertices, base.faces, base.creases));
  AdaptiveBit bent = expecting(0.2);
  base.corners.clear();
  for (int v = 0; v < base.vertices; ++v)
    if (fans[v].crease_count == 2 && fans[v].sharp_count == 2 && side.decide(actual[v].bent, bent))
      base.corners.push_back(v);
}

[[noreturn]] void refuse() { throw Error(Cause::BadStream, "the base connectivity of the coded mesh is damaged"); }

}  // namespace

CodedBase encode_connectivity(const std::vector<Triangle>& faces, Bytes& out, const Creases& creases,
                              const std::vector<int>& corners) {
  Writer writer(out);
  ConnectivityCoder<Writer> coder(writer);
  Renaming names(faces);
  GrowingSurface& surface = coder.surface;
  while (surface.faces.size() < faces.size()) {
    const int gate = coder.next_gate();
    const int h = gate == kNone ? names.next_component() : names.beyond(surface.from(gate), surface.to(gate));
    Triangle t;
    const auto vertex = [&](int corner, int coded) {
      if (coded == kNone) {
        coded = surface.new_vertex();
        names.name(names.source_corner(h, corner), coded);
      }
      t[corner] = coded;
    };
    if (gate == kNone) {
      for (int k = 0; k < 3; ++k) vertex(k, coder.code_seed_vertex(names.coded(names.source_corner(h, k))));
    } else {
      const Third third =
          coder.code_third(gate, {h == kNone, h == kNone ? kNone : names.coded(names.source_corner(h, 2))});
      if (third.boundary) {
        surface.close_as_boundary(gate);
        continue;
      }
      t[0] = surface.to(gate);
      t[1] = surface.from(gate);
      vertex(2, third.vertex);
    }
    if (!surface.add(t)) throw Error(Cause::Internal, "base faces overlap", Element::Face, h / 3);
    names.take(h);
    coder.push_gates(static_cast<int>(surface.faces.size()) - 1);
  }
  names.base.vertices = surface.vertex_count();
  names.base.faces = std::move(surface.faces);
  if (!creases.empty()) {
    for (const auto& [a, b] : creases) names.base.creases.push_back(ascending(names.coded(a), names.coded(b)));
    for (int v : corners) names.base.corners.push_back(names.coded(v));
    std::sort(names.base.creases.begin(), names.base.creases.end());
    std::sort(names.base.corners.begin(), names.base.corners.end());
    code_creases(names.base, writer);
  }
  writer.finish();
  return std::move(names.base);
}

CodedBase decode_connectivity(int face_count, bool creased, const std::uint8_t* begin, const std::uint8_t* end) {
  Reader reader(begin, end);
  ConnectivityCoder<Reader> coder(reader);
  GrowingSurface& surface = coder.surface;
  try {
    while (static_cast<int>(surface.faces.size()) < face_count) {
      const int gate = coder.next_gate();
      Triangle t;
      if (gate == kNone) {
        for (int& v : t) {
          v = coder.code_seed_vertex(kNone);
          if (v == kNone) v = surface.new_vertex();
        }
      } else {
        const Third third = coder.code_third(gate, {});
        if (third.boundary) {
          surface.close_as_boundary(gate);
          continue;
        }
        t = {surface.to(gate), surface.from(gate), third.vertex == kNone ? surface.new_vertex() : third.vertex};
      }
      if (t[0] >= surface.vertex_count() || t[1] >= surface.vertex_count() || t[2] >= surface.vertex_count()) refuse();
      if (!surface.add(t)) refuse();
      coder.push_gates(static_cast<int>(surface.faces.size()) - 1);
    }
    CodedBase base;
    base.vertices = surface.vertex_count();
    base.faces = std::move(surface.faces);
    if (creased) code_creases(base, reader);
    return base;
  } catch (const StreamEnd&) {
    refuse();
  }
}

}  // namespace gsp

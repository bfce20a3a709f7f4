#include "remesh/recover_levels.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

#include "mesh/edge.h"
#include "mesh/error.h"
#include "mesh/io.h"
#include "mesh/topology.h"
#include "remesh/semiregular_file.h"

namespace gsp {

namespace {

[[noreturn]] void refuse(const std::string& why, Element element, int index) {
  throw Error(Cause::NoSubdivisionConnectivity, "the mesh has no subdivision connectivity: " + why, element, index);
}

/// A quadrisection undone: the coarse faces, and which vertex stands on which of their edges. Vertices keep the numbers
/// that they have in the fine mesh.
struct Coarsening {
  std::vector<Triangle> faces;
  std::unordered_map<std::uint64_t, int> midpoints;
};

class Coarsener {
 public:
  Coarsener(int vertices, const std::vector<Triangle>& faces) : fine_(base_level(vertices, faces)) {
    fans_ = vertex_fans(fine_);
    begin_.assign(vertices + 1, 0);
    for (int v = 0; v < vertices; ++v) begin_[v + 1] = begin_[v] + fans_[v].valence;
    incident_.resize(begin_.back());
    std::vector<int> next(begin_.begin(), begin_.end() - 1);
    for (int e = 0; e < fine_.edge_count(); ++e)
      for (int v : fine_.edges[e]) incident_[next[v]++] = e;
  }

  Coarsening run() {
    parity_.assign(fans_.size(), Unknown);
    // Irregular vertices are old at every level; a component without any may start anywhere.
    for (const bool only_irregular : {true, false})
      for (int v = 0; v < static_cast<int>(fans_.size()); ++v)
        if (fans_[v].valence > 0 && parity_[v] == Unknown && !(only_irregular && regular(v))) spread_from(v);
    return join_faces();
  }

 private:
  enum Parity : std::int8_t { Unknown, Old, New };

  bool regular(int v) const { return fans_[v].valence == (fans_[v].sharp_count == 0 ? 6 : 4); }

  void mark(int v, Parity parity) {
    if (parity_[v] != Unknown && parity_[v] != parity) refuse("a vertex is both old and new", Element::Vertex, v);
    if (parity == New && !regular(v)) refuse("an irregular vertex stands where a new one should", Element::Vertex, v);
    parity_[v] = parity;
  }

  void spread_from(int seed) {
    mark(seed, Old);
    std::vector<int> queue = {seed};
    while (!queue.empty()) {
      const int v = queue.back();
      queue.pop_back();
      for (int i = begin_[v]; i < begin_[v + 1]; ++i) {
        const int middle = fine_.other_end(incident_[i], v);
        mark(middle, New);
        const int beyond = fine_.other_end(straight_on(incident_[i], middle), middle);
        const bool news = parity_[beyond] == Unknown;
        mark(beyond, Old);
        if (news) queue.push_back(beyond);
      }
    }
  }

  /// The edge that continues `edge` past the new vertex `through`.
  int straight_on(int edge, int through) const {
    if (fans_[through].sharp_count > 0) {
      const auto& [first, second] = fans_[through].sharp_edges;
      if (edge != first && edge != second) refuse("a new vertex lies on no boundary edge", Element::Vertex, through);
      return edge == first ? second : first;
    }
    int face = fine_.edge_faces[edge][0];
    for (int turn = 0; turn < 3; ++turn) {
      if (face < 0) refuse("faces around a vertex form more than one fan", Element::Vertex, through);
      edge = fine_.other_side(face, edge, through);
      face = fine_.other_face(edge, face);
    }
    return edge;
  }

  /// One coarse face for each face of new vertices only, and every other face beside exactly one of these.
  Coarsening join_faces() const {
    Coarsening coarse;
    for (int f = 0; f < fine_.face_count(); ++f) {
      const Triangle& t = fine_.faces[f];
      const long old = std::count_if(t.begin(), t.end(), [&](int v) { return parity_[v] == Old; });
      if (old == 1) continue;
      if (old != 0) refuse("a face has more than one old vertex", Element::Face, f);
      Triangle corners;
      for (int k = 0; k < 3; ++k) corners[(k + 1) % 3] = corner_across(f, k);
      if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
        refuse("a coarse face would name a vertex twice", Element::Face, f);
      coarse.faces.push_back(corners);
      for (int k = 0; k < 3; ++k) {
        const auto [at, is_new] = coarse.midpoints.try_emplace(edge_key(corners[k], corners[(k + 1) % 3]), t[k]);
        if (!is_new && at->second != t[k])
          refuse("two coarse edges would join the same vertices", Element::Vertex, t[k]);
      }
    }
    if (4 * coarse.faces.size() != fine_.faces.size())
      refuse("the faces do not come in groups of four", Element::Face, 0);
    return coarse;
  }

  /// The old vertex beyond side k of a middle face.
  int corner_across(int face, int k) const {
    const auto& [f, g] = fine_.edge_faces[fine_.face_edges[face][k]];
    const int beyond = f == face ? g : f;
    if (beyond >= 0)
      for (int v : fine_.faces[beyond])
        if (parity_[v] == Old) return v;
    refuse("no corner face lies beside a middle face", Element::Face, face);
  }

  SubdivisionLevel fine_;
  std::vector<VertexFan> fans_;
  std::vector<int> begin_, incident_;
  std::vector<Parity> parity_;
};

/// Base vertices and faces renumbered to those in use, by first appearance in `faces`.
std::vector<int> compact(std::vector<Triangle>& faces, int vertices) {
  std::vector<int> source, number(vertices, -1);
  for (Triangle& t : faces)
    for (int& v : t) {
      if (number[v] < 0) {
        number[v] = static_cast<int>(source.size());
        source.push_back(v);
      }
      v = number[v];
    }
  return source;
}

}  // namespace

SemiregularMesh recover_levels(const Mesh& mesh) {
  require_indices(mesh);
  std::vector<Coarsening> levels;  // finest first
  SemiregularMesh result;
  result.base_faces = mesh.faces;
  while (static_cast<int>(levels.size()) < kMaxSubdivisionLevel) {
    try {
      Coarsening coarser = Coarsener(mesh.vertex_count(), result.base_faces).run();
      base_level(mesh.vertex_count(), coarser.faces);
      result.base_faces = coarser.faces;
      levels.push_back(std::move(coarser));
    } catch (const Error&) {
      if (levels.empty()) throw;
      break;
    }
  }
  result.level = static_cast<int>(levels.size());
  std::vector<int> source = compact(result.base_faces, mesh.vertex_count());
  result.base_vertices = static_cast<int>(source.size());
  SubdivisionLevel level = base_level(result.base_vertices, result.base_faces);
  for (std::size_t l = levels.size(); l-- > 0;) {
    for (const auto& [a, b] : level.edges) source.push_back(levels[l].midpoints.at(edge_key(source[a], source[b])));
    level = subdivide(level);
  }
  for (int v : source) result.positions.push_back(mesh.positions[v]);
  return result;
}

SemiregularMesh read_or_recover(const std::string& path, const ReadOptions& options) {
  if (path.ends_with(".ply") && !options.weld) {
    try {
      return read_semiregular(path);
    } catch (const Error& error) {
      if (error.cause() != Cause::NoSubdivisionConnectivity) throw;
    }
  }
  return recover_levels(read_surface(path, options).mesh);
}

}  // namespace gsp

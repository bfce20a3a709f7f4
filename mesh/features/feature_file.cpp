#include "mesh/features/feature_file.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "mesh/edge.h"
#include "mesh/error.h"
#include "mesh/halfedges.h"
#include "mesh/read_file.h"
#include "mesh/topology.h"

namespace gsp {

namespace {

struct Row {
  int line;
  std::vector<int> numbers;
};

/// The rows that hold anything.
std::vector<Row> rows_of(std::string_view text) {
  std::vector<Row> rows;
  int line = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view rest = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    Row row{++line, {}};
    for (;;) {
      const std::size_t start = rest.find_first_not_of(" \t\r,");
      if (start == std::string_view::npos) break;
      rest.remove_prefix(start);
      int number = 0;
      const auto [after, failure] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
      const bool ends = after == rest.data() + rest.size() || std::string_view(" \t\r,").find(*after) < 4;
      if (failure != std::errc() || !ends || row.numbers.size() == 3)
        throw Error(Cause::Malformed, "a row of features holds two or three whole numbers", Element::Line, line);
      row.numbers.push_back(number);
      rest.remove_prefix(after - rest.data());
    }
    if (!row.numbers.empty()) rows.push_back(std::move(row));
  }
  return rows;
}

/// The half-edge of a row of "type,face,edge".
int halfedge_of(const Row& row, const Mesh& mesh) {
  const int face = row.numbers[1], edge = row.numbers[2];
  if (face < 0 || face >= mesh.face_count() || edge < 0 || edge > 2)
    throw Error(Cause::IndexOutOfRange, "a feature names a face or an edge that does not exist", Element::Line,
                row.line);
  return 3 * face + edge;
}

/// The half-edge between the two vertices of a row.
int halfedge_between(const Row& row, const Halfedges& halfedges) {
  const int a = row.numbers[0], b = row.numbers[1], count = static_cast<int>(halfedges.outgoing.size());
  if (a < 0 || b < 0 || a >= count || b >= count)
    throw Error(Cause::IndexOutOfRange, "a feature names a vertex that does not exist", Element::Line, row.line);
  const int start = halfedges.outgoing[a];
  for (int h = start; h >= 0;) {
    if (halfedges.to(h) == b) return h;
    if (halfedges.from(Halfedges::prev(h)) == b) return Halfedges::prev(h);
    h = halfedges.rotate_ccw(h);
    if (h == start) break;
  }
  throw Error(Cause::Malformed, "a feature names two vertices that no edge joins", Element::Line, row.line);
}

FeatureEdges features_of(const std::string& text, const Mesh& mesh) {
  std::vector<Row> rows = rows_of(text);
  const Halfedges halfedges(mesh);
  const bool by_faces = !rows.empty() && rows.front().numbers.size() == 1;
  if (by_faces) {
    const int promised = rows.front().numbers[0], line = rows.front().line;
    rows.erase(rows.begin());
    if (promised < 0 || rows.size() != static_cast<std::size_t>(promised))
      throw Error(Cause::Malformed, "the number of features is not that of the rows", Element::Line, line);
  }
  FeatureEdges edges;
  for (const Row& row : rows) {
    if (row.numbers.size() != (by_faces ? 3u : 2u))
      throw Error(Cause::Malformed, "a row of features has another length", Element::Line, row.line);
    const int h = by_faces ? halfedge_of(row, mesh) : halfedge_between(row, halfedges);
    if (halfedges.twin[h] < 0) continue;
    edges.push_back(ascending(halfedges.from(h), halfedges.to(h)));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace

FeatureEdges read_features(const std::string& path, const Mesh& mesh) {
  const std::string text = read_text(path);
  require_parameterizable(mesh);
  try {
    return features_of(text, mesh);
  } catch (const Error& error) {
    throw error.within(path);
  }
}

}  // namespace gsp

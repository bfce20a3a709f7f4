#include "mesh/surface_file.h"

#include <utility>

#include "mesh/edge_groups.h"
#include "mesh/weld.h"

namespace gsp {

namespace {

/// What lies behind the file's own vertices and faces was added later, and the file has no number for it.
long long number(const std::vector<int>& numbers, long long index, int first) {
  if (numbers.empty()) return index + first;
  const bool known = index >= 0 && index < static_cast<long long>(numbers.size());
  return known ? numbers[static_cast<std::size_t>(index)] + first : index;
}

/// The numbers of those that are left, by their index before.
std::vector<int> left_of(const std::vector<int>& numbers, const std::vector<int>& left) {
  if (numbers.empty()) return left;
  std::vector<int> of_left;
  for (const int index : left) of_left.push_back(numbers[static_cast<std::size_t>(index)]);
  return of_left;
}

}  // namespace

Error in_file(const Error& error, const Numbering& numbering) {
  if (!error.place()) return error;
  Place place = *error.place();
  const bool face = place.element == Element::Face;
  const bool vertices = place.element == Element::Vertex || (place.element == Element::Edge && place.end);
  if (!face && !vertices) return error;
  const std::vector<int>& numbers = face ? numbering.polygons : numbering.vertices;
  place.index = number(numbers, place.index, numbering.first);
  if (place.end) place.end = number(numbers, *place.end, numbering.first);
  return error.at(place);
}

void weld(SurfaceFile& file, double share) {
  WeldedMesh welded = gsp::weld(file.mesh, share);
  const std::size_t joined = file.mesh.positions.size() - welded.mesh.positions.size();
  std::vector<Triangle> faces;
  std::vector<int> left;
  for (int f = 0; f < welded.mesh.face_count(); ++f) {
    const bool lost = names_vertex_twice(welded.mesh.faces[f]);
    if (lost) continue;
    faces.push_back(welded.mesh.faces[f]);
    left.push_back(f);
  }
  const std::size_t dropped = file.mesh.faces.size() - faces.size();
  file.numbering.vertices = left_of(file.numbering.vertices, welded.vertices);
  file.numbering.polygons = left_of(file.numbering.polygons, left);
  file.mesh = {std::move(welded.mesh.positions), std::move(faces)};
  file.notes.push_back(std::to_string(joined) + " vertices were joined to others by the weld" +
                       (dropped > 0 ? ", which leaves " + std::to_string(dropped) +
                                          " faces with fewer than three corners; they are dropped"
                                    : ""));
}

void cut_apart(SurfaceFile& file) {
  CutApart cut = gsp::cut_apart(file.mesh);
  const CutCounts counts = cut.counts;
  if (counts.added_vertices > 0) file.numbering.vertices = left_of(file.numbering.vertices, cut.surface.original);
  file.mesh = std::move(cut.surface.mesh);
  file.cuts = counts;
  file.notes.push_back(std::to_string(counts.edges) + " edges and " + std::to_string(counts.vertices) +
                       " vertices were cut apart, which adds " + std::to_string(counts.added_vertices) +
                       " vertices at the same places");
}

}  // namespace gsp

#include "mesh/files/polygon_builder.h"

#include <algorithm>
#include <numeric>

#include "mesh/files/formats.h"
#include "mesh/topology.h"

namespace gsp {

void PolygonBuilder::add(std::span<const long long> corners) {
  require_in_range(corners);
  const std::size_t faces = file_.mesh.faces.size();
  if (corners.size() < 3)
    ++without_surface_;
  else
    cut(corners);
  require_countable(file_.mesh.positions.size(), std::max(file_.mesh.faces.size(), static_cast<std::size_t>(polygon_)));
  number_faces(faces);
  ++polygon_;
}

void PolygonBuilder::require_in_range(std::span<const long long> corners) const {
  const long long count = file_.mesh.vertex_count(), first = file_.numbering.first;
  for (const long long corner : corners)
    if (corner < 0 || corner >= count)
      throw in_file(Error(Cause::IndexOutOfRange,
                          "a face names vertex " + std::to_string(corner + first) + ", but there are " +
                              std::to_string(count) + ", counted from " + std::to_string(first),
                          Element::Face, polygon_),
                    {.first = file_.numbering.first});
}

void PolygonBuilder::cut(std::span<const long long> corners) {
  positions_.clear();
  for (const long long corner : corners) positions_.push_back(file_.mesh.positions[static_cast<std::size_t>(corner)]);
  const PolygonCutter::Outcome outcome = cutter_.cut(positions_);
  if (outcome != PolygonCutter::Outcome::Cut) {
    const std::string sentence =
        outcome == PolygonCutter::Outcome::NotSimple
            ? "a polygon crosses itself as seen along its normal, so it cannot be cut into triangles"
            : "a concave polygon of more than " + std::to_string(PolygonCutter::kMostCorners) + " corners";
    throw in_file(Error(Cause::PolygonNotSimple, sentence, Element::Face, polygon_), {.first = file_.numbering.first});
  }
  for (const Triangle& t : cutter_.triangles())
    file_.mesh.faces.push_back(
        {static_cast<int>(corners[t[0]]), static_cast<int>(corners[t[1]]), static_cast<int>(corners[t[2]])});
}

/// Nothing is stored as long as every polygon is one face.
void PolygonBuilder::number_faces(std::size_t faces_before) {
  std::vector<int>& polygons = file_.numbering.polygons;
  const std::size_t faces = file_.mesh.faces.size();
  if (!renumbered_ && faces == faces_before + 1) return;
  if (!renumbered_) {
    polygons.resize(faces_before);
    std::iota(polygons.begin(), polygons.end(), 0);
    renumbered_ = true;
  }
  polygons.resize(faces, static_cast<int>(polygon_));
}

void PolygonBuilder::finish() {
  if (without_surface_ > 0)
    file_.notes.push_back(std::to_string(without_surface_) +
                          " faces of fewer than three corners carry no surface and are left out");
}

}  // namespace gsp

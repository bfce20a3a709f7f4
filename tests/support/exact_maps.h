#pragma once

#include <cstdint>

#include "param/map/parameterization.h"

/// Maps that are known exactly, for the tests of everything that reads a Parameterization.
namespace gsp::exact_maps {

/// The surface is `base` itself, every face quadrisected `level` times and flat; each base face is its own chart and
/// the map is the identity. Chart positions are dyadic, so corners in one chart are exact to the rounding of √3/2.
Parameterization quadrisected(const Mesh& base, int level);

/// Moves every vertex that is neither a base vertex nor on the boundary to another place of the domain, by up to
/// `amount` times the smallest spacing 2^-level in each direction; the surface stays. Below 0.2 no face flips. Vertices
/// on base edges move across them, so faces then reach into neighbouring charts.
void jitter(Parameterization& map, double amount, int level, std::uint64_t seed);

/// The same for a map whose base edges are creases: vertices on base edges move along them. `map` is `quadrisected`.
void jitter_along_edges(Parameterization& map, double amount, int level, std::uint64_t seed);

/// Gives about half of the faces in the chart of a neighbour of their base face instead: the same map, written
/// otherwise.
void rechart(Parameterization& map, std::uint64_t seed);

/// Puts every vertex where the flat base triangle of its patch has it, so that the map is the identity again where no
/// face crosses a base edge at an angle.
void flatten_onto_base(Parameterization& map, const Mesh& base);

}  // namespace gsp::exact_maps

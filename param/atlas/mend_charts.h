#pragma once

#include "param/atlas/atlas.h"

namespace gsp {

/// Gives the vertices that have the chart of another place than their neighbours see them at the chart in which they
/// lie. Returns how many did; the map is the same bits where none does.
///
/// A vertex beside others that lie outside of their charts gets a chart from them by transitions alone. Round a patch
/// corner of high valence it can lie inside that chart's triangle as numbers and still be in another sector, which no
/// area, angle or transition shows. In a map without folds no base vertex lies inside a face, so the straight way from
/// a vertex to one that shares a face, or an edge between patch corners opposite, tells the place of the second by that
/// of the first. Those which all such ways between them agree on form groups. The largest of the groups that touch is
/// right, and the others follow it, vertex by vertex.
///
/// `atlas`: without folds. Vertices outside of their chart (`reassign_all`) say nothing. O(E + base faces crossed).
int mend_charts(Atlas& atlas);

}  // namespace gsp

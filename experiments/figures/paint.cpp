#include "experiments/figures/paint.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "param/map/development.h"

namespace gsp {

namespace {

using ChartCorners = std::vector<std::array<Complex, 3>>;

const Colour kPlaster(0.86, 0.85, 0.83);
const Colour kIsoline(0.20, 0.32, 0.48);
const Colour kPatchEdge(0.10, 0.10, 0.14);
const Colour kCrease(0.04, 0.04, 0.06);
const Colour kWire(0.16, 0.18, 0.24);
constexpr double kIsolineWidth = 1.0, kPatchEdgeWidth = 2.4, kCreaseWidth = 4.0, kWireWidth = 0.9;

/// Light colours that differ in hue, from a qualitative scheme made for neighbouring areas on a map.
const std::array<Colour, 10> kPatchColours = {
    Colour(0.60, 0.76, 0.87), Colour(0.98, 0.80, 0.55), Colour(0.70, 0.85, 0.60), Colour(0.94, 0.66, 0.63),
    Colour(0.78, 0.72, 0.87), Colour(0.97, 0.93, 0.63), Colour(0.62, 0.84, 0.80), Colour(0.93, 0.75, 0.85),
    Colour(0.82, 0.75, 0.64), Colour(0.76, 0.80, 0.83)};

Colour over(const Colour& under, const Colour& ink, double share) { return under + share * (ink - under); }

/// Which patch holds a point of a face, and where its chart has the face.
class PatchLookup {
 public:
  explicit PatchLookup(const Parameterization& map) : corners_(map.face_corners) {
    const Development development(map);
    for (int f = 0; f < map.surface.face_count(); ++f) {
      starts_.push_back(pieces_.size());
      development.append(f, pieces_);
    }
    starts_.push_back(pieces_.size());
  }

  const FacePiece& piece_at(const Fragment& fragment) const {
    const std::size_t begin = starts_[fragment.face], end = starts_[fragment.face + 1];
    std::size_t best = begin;
    if (end - begin == 1) return pieces_[best];
    Complex z = 0.0;
    for (int k = 0; k < 3; ++k) z += fragment.weights[k] * corners_[fragment.face][k];
    double deepest = -1e300;
    for (std::size_t i = begin; i < end; ++i) {
      const std::array<double, 3> w = chart_barycentric(pieces_[i].motion.apply(z));
      const double depth = std::min({w[0], w[1], w[2]});
      if (depth <= deepest) continue;
      deepest = depth;
      best = i;
    }
    return pieces_[best];
  }

  /// Barycentric coordinates of the corners of a piece's face in the piece's chart.
  std::array<std::array<double, 3>, 3> corners_of(const FacePiece& piece) const {
    std::array<std::array<double, 3>, 3> at;
    for (int k = 0; k < 3; ++k) at[k] = chart_barycentric(piece.motion.apply(corners_[piece.face][k]));
    return at;
  }

 private:
  ChartCorners corners_;
  std::vector<std::size_t> starts_;
  std::vector<FacePiece> pieces_;
};

Colour scaled(const ColourScale& scale, double value) {
  const std::array<double, 3> rgb = colour_of(scale, value);
  return Colour(rgb[0], rgb[1], rgb[2]) / 255.0;
}

/// Lines where a barycentric coordinate times `density` is an integer, over another paint.
Paint with_lattice_lines(Paint under, const Parameterization& map, int density, const Colour& ink, double width) {
  return [under = std::move(under), corners = map.face_corners, density, ink, width](const Fragment& fragment) {
    std::array<std::array<double, 3>, 3> at;  // of each corner
    for (int k = 0; k < 3; ++k) at[k] = chart_barycentric(corners[fragment.face][k]);
    double share = 0.0;
    for (int c = 0; c < 3; ++c)
      share = std::max(share, line_ink({density * at[0][c], density * at[1][c], density * at[2][c]}, fragment, width));
    return over(under(fragment), ink, share);
  };
}

}  // namespace

std::vector<Colour> patch_colours(const BaseComplex& base) {
  std::vector<std::vector<int>> around(base.vertices.size());
  for (int p = 0; p < base.face_count(); ++p)
    for (int b : base.faces[p]) around[b].push_back(p);
  std::vector<int> colour(base.faces.size(), -1);
  std::array<int, kPatchColours.size()> used = {};
  for (int p = 0; p < base.face_count(); ++p) {
    std::array<int, kPatchColours.size()> conflicts = {};
    constexpr int kAcrossEdge = 1000;
    for (int b : base.faces[p])
      for (int q : around[b])
        if (colour[q] >= 0) ++conflicts[colour[q]];
    for (int k = 0; k < 3; ++k) {
      const int twin = base.twins[3 * p + k];
      if (twin >= 0 && colour[twin / 3] >= 0) conflicts[colour[twin / 3]] += kAcrossEdge;
    }
    int best = 0;
    for (int c = 1; c < static_cast<int>(kPatchColours.size()); ++c)
      if (std::tie(conflicts[c], used[c]) < std::tie(conflicts[best], used[best])) best = c;
    colour[p] = best;
    ++used[best];
  }
  std::vector<Colour> colours;
  for (int place : colour) colours.push_back(kPatchColours[place]);
  return colours;
}

Paint plain_paint() {
  return [](const Fragment&) { return kPlaster; };
}

Paint patch_paint(const Parameterization& map) {
  return [lookup = PatchLookup(map), colour = patch_colours(map.base)](const Fragment& fragment) {
    return colour[lookup.piece_at(fragment).chart];
  };
}

Paint face_value_paint(std::vector<double> values, const ColourScale& scale) {
  return [values = std::move(values), scale](const Fragment& fragment) { return scaled(scale, values[fragment.face]); };
}

Paint vertex_value_paint(const Mesh& mesh, std::vector<double> values, const ColourScale& scale) {
  return [faces = mesh.faces, values = std::move(values), scale](const Fragment& fragment) {
    double value = 0.0;
    for (int k = 0; k < 3; ++k) value += fragment.weights[k] * values[faces[fragment.face][k]];
    return scaled(scale, value);
  };
}

Paint with_isolines(Paint under, const Parameterization& map, int density) {
  return with_lattice_lines(std::move(under), map, density, kIsoline, kIsolineWidth);
}

Paint with_patch_edges(Paint under, const Parameterization& map) {
  return with_lattice_lines(std::move(under), map, 1, kPatchEdge, kPatchEdgeWidth);
}

Paint with_creases(Paint under, const Parameterization& map) {
  if (map.base.creases.empty()) return under;
  return [under = std::move(under), lookup = PatchLookup(map),
          creased = map.base.crease_halfedges()](const Fragment& fragment) {
    const FacePiece& piece = lookup.piece_at(fragment);
    const std::array<std::array<double, 3>, 3> at = lookup.corners_of(piece);
    double share = 0.0;
    for (int k = 0; k < 3; ++k) {
      if (!creased[3 * piece.chart + k]) continue;
      const int c = (k + 2) % 3;  // the coordinate that is 0 along half-edge k
      const std::array<double, 3> values = {at[0][c], at[1][c], at[2][c]};
      double here = 0.0;
      for (int i = 0; i < 3; ++i) here += fragment.weights[i] * values[i];
      // Past the middle of the patch the nearest integer is 1, at the corner across.
      if (here < 0.5) share = std::max(share, line_ink(values, fragment, kCreaseWidth));
    }
    return over(under(fragment), kCrease, share);
  };
}

Paint with_wireframe(Paint under) {
  return [under = std::move(under)](const Fragment& fragment) {
    double share = 0.0;
    for (int k = 0; k < 3; ++k) {
      std::array<double, 3> weight = {0.0, 0.0, 0.0};
      weight[k] = 1.0;
      share = std::max(share, line_ink(weight, fragment, kWireWidth));
    }
    return over(under(fragment), kWire, 0.8 * share);
  };
}

}  // namespace gsp

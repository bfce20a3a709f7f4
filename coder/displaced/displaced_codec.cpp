#include "coder/displaced/displaced_codec.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "coder/coded_order.h"
#include "coder/displaced/scalar_field.h"
#include "coder/displaced/scalar_planes.h"
#include "coder/quantizer.h"
#include "mesh/error.h"
#include "remesh/filters/displacement.h"

namespace gsp {

namespace {

/// Control points into the header: the origin is the least of each coordinate, in steps of the grid.
void put_control(const ControlMesh& control, StreamHeader& header) {
  const auto steps = [&](double x) { return static_cast<std::int64_t>(x / control.grid); };
  for (int k = 0; k < 3; ++k) {
    header.origin[k] = steps(control.points[0][k]);
    for (const Vec3& p : control.points) header.origin[k] = std::min(header.origin[k], steps(p[k]));
  }
  std::uint64_t largest = 0;
  for (const Vec3& p : control.points)
    for (int k = 0; k < 3; ++k) largest = std::max(largest, static_cast<std::uint64_t>(steps(p[k]) - header.origin[k]));
  header.base_planes = std::bit_width(largest);
  if (header.base_planes > kMostControlPlanes)
    throw Error(Cause::BadOption, "control points span more than 2^24 steps of their grid");
  for (const Vec3& p : control.points) {
    ControlSteps point;
    for (int k = 0; k < 3; ++k) point[k] = static_cast<std::uint32_t>(steps(p[k]) - header.origin[k]);
    header.control.push_back(point);
  }
  header.control_grid = control.grid;
}

/// Exact, since a step has 3 bits and its multiples 41 at most.
ControlMesh take_control(const StreamHeader& header) {
  ControlMesh control{{}, header.control_grid};
  for (const ControlSteps& point : header.control) {
    Vec3 p;
    for (int k = 0; k < 3; ++k) p[k] = static_cast<double>(header.origin[k] + point[k]) * control.grid;
    control.points.push_back(p);
  }
  return control;
}

/// Everything that encoder and decoder derive from the header and the level that they go to.
struct ScalarStructure {
  const std::vector<SubdivisionLevel> levels;
  const ScalarForest forest;
  const ScalarField field;

  ScalarStructure(const StreamHeader& header, int level)
      : levels(subdivision_levels(header.base.vertices, header.base.faces, level)),
        forest(levels),
        field(levels, forest, header.wavelet) {}
};

ScalarIntegers quantized(const std::vector<double>& coefficients, const std::vector<double>& weights,
                         StreamHeader& header) {
  double largest = 0.0;
  for (std::size_t n = 0; n < coefficients.size(); ++n)
    largest = std::max(largest, std::abs(coefficients[n]) * weights[n]);
  // No magnitude may need more planes than there are.
  while (std::ldexp(largest, -header.step_exponent) >= 0x1p31) ++header.step_exponent;
  ScalarIntegers integers;
  std::uint32_t most = 0;
  for (std::size_t n = 0; n < coefficients.size(); ++n) {
    const double steps = std::ldexp(std::abs(coefficients[n]) * weights[n], -header.step_exponent);
    integers.magnitude.push_back(static_cast<std::uint32_t>(steps));
    integers.negative.push_back(coefficients[n] < 0.0);
    most = std::max(most, integers.magnitude.back());
  }
  header.detail_planes = std::bit_width(most);
  return integers;
}

std::vector<double> dequantized(const ScalarIntegers& known, const std::vector<double>& weights, int step_exponent) {
  std::vector<double> coefficients(weights.size(), 0.0);
  for (std::size_t n = 0; n < coefficients.size(); ++n) {
    if (known.magnitude[n] == 0) continue;
    const double steps = centroid(known.magnitude[n], known.low_plane[n]);
    const double size = std::ldexp(steps, step_exponent) / weights[n];
    coefficients[n] = known.negative[n] ? -size : size;
  }
  return coefficients;
}

}  // namespace

Bytes encode_displaced(const SemiregularMesh& mesh, Wavelet wavelet, double diagonal, int precision, Progress& progress,
                       StreamParts* parts) {
  StreamHeader header;
  header.kind = StreamKind::Displaced;
  header.wavelet = wavelet;
  header.tangential_ratio = 1;
  header.level = mesh.level;
  Bytes connectivity;
  header.base = encode_connectivity(mesh.base_faces, connectivity);
  const SemiregularMesh coded = in_coded_order(mesh, header.base);
  put_control(*coded.control, header);
  constexpr int kLeastExponent = -500;
  header.step_exponent =
      std::max(kLeastExponent, std::ilogb(diagonal) - (precision + kPassesPerPlane - 1) / kPassesPerPlane);

  progress.report("wavelet analysis", 0.1);
  const ScalarStructure structure(header, mesh.level);
  const std::vector<double> weights =
      structure.field.weights(coded.control->points, importance_level(header), header.level);
  const ScalarIntegers integers =
      quantized(structure.field.analysis(displaced_form(coded).displacements), weights, header);
  progress.report("entropy coding", 0.8);
  Bytes bytes = write_header(header, connectivity);
  const std::size_t header_size = bytes.size();
  BitplaneParts bits = encode_scalars(structure.forest, header.detail_planes, integers, bytes);
  if (parts) {
    Bytes control_bytes;
    encode_control(header.base, header.base_planes, header.control, control_bytes);
    bits.base = 8.0 * static_cast<double>(control_bytes.size());
    *parts = {header_size - connectivity.size() - control_bytes.size(), connectivity.size(), bits};
  }
  progress.report("entropy coding", 1.0);
  return bytes;
}

SemiregularMesh decode_displaced(const StreamHeader& header, int level, int area_level, const std::uint8_t* begin,
                                 const std::uint8_t* end) {
  const ScalarStructure structure(header, level);
  ControlMesh control = take_control(header);
  const std::vector<double> weights = structure.field.weights(control.points, area_level, header.level);
  const ScalarIntegers known = decode_scalars(structure.forest, header.level + 1, header.detail_planes, begin, end);
  const Displacements displacements = structure.field.synthesis(dequantized(known, weights, header.step_exponent));
  SemiregularMesh mesh{level, header.base.vertices, header.base.faces,
                       displaced_points(structure.levels, smooth_surface(structure.levels, control.points),
                                        displacements, header.across)};
  mesh.control = std::move(control);
  return mesh;
}

}  // namespace gsp

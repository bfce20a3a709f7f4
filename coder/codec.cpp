#include "coder/codec.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <string>

#include "coder/bitplane_coder.h"
#include "coder/coded_order.h"
#include "coder/displaced/displaced_codec.h"
#include "coder/edge_forest.h"
#include "coder/header.h"
#include "coder/importance.h"
#include "coder/precision.h"
#include "coder/quantizer.h"
#include "coder/rate_distortion.h"
#include "coder/wavelet_transform.h"
#include "mesh/fixed_order.h"
#include "mesh/topology.h"
#include "mesh/words.h"
#include "remesh/filters/local_frames.h"

namespace gsp {

namespace {

void check(const SemiregularMesh& mesh, const EncodeOptions& options) {
  const bool automatic = options.precision_bits == EncodeOptions::kAutoPrecision;
  if (!automatic && (options.precision_bits < 8 || options.precision_bits > 24))
    throw Error(Cause::BadOption, "precision_bits " + std::to_string(options.precision_bits) + " is not in 8..24");
  if (options.tangential_ratio < 1 || options.tangential_ratio > 8 ||
      !std::has_single_bit(static_cast<unsigned>(options.tangential_ratio)))
    throw Error(Cause::BadOption,
                "tangential_ratio " + std::to_string(options.tangential_ratio) + " is not 1, 2, 4 or 8");
  if (mesh.control && !mesh.creases.empty())
    throw Error(Cause::BadOption, "displaced meshes with creases are not coded: their surface is smooth");
  if (mesh.base_faces.empty()) throw Error(Cause::NoFaces, "a mesh without base faces cannot be coded");
  require_well_formed(mesh);
  require_computable(mesh.positions);
  std::vector<bool> used(mesh.base_vertices, false);
  for (const Triangle& t : mesh.base_faces)
    for (int v : t) used[v] = true;
  for (int v = 0; v < mesh.base_vertices; ++v)
    if (!used[v]) throw Error(Cause::Malformed, "a base vertex belongs to no face", Element::Vertex, v);
}

/// Where there is no level to read it from.
constexpr int kFlatPrecision = kPassesPerPlane * 16;

/// Of levels finer than what any prefix decodes to.
constexpr std::int64_t kFacesPerByte = 2048;

/// -1 where no detail is.
int finest_significant_level(const BitplaneCoefficients& known, const EdgeForest& forest) {
  int node = forest.nodes() - 1;
  const auto zero = [&](int n) {
    return (known.details[0].magnitude[n] | known.details[1].magnitude[n] | known.details[2].magnitude[n]) == 0;
  };
  while (node >= 0 && zero(node)) --node;
  int level = forest.levels() - 1;
  while (level >= 0 && node < forest.level_begin[level]) --level;
  return level;
}

/// Normal where no detail but those of sharp edges has a tangential component, to the stream's precision.
StreamKind kind_of(const EdgeForest& forest, const BitplaneCoefficients& integers) {
  for (int n = 0; n < forest.nodes(); ++n)
    if (!forest.on_curve(n) && (integers.details[1].magnitude[n] | integers.details[2].magnitude[n]) != 0)
      return StreamKind::Parametric;
  return StreamKind::Normal;
}

/// Of all details but those of sharp edges.
void drop_tangential(const EdgeForest& forest, BitplaneCoefficients& integers) {
  for (int n = 0; n < forest.nodes(); ++n)
    if (!forest.on_curve(n)) integers.details[1].magnitude[n] = integers.details[2].magnitude[n] = 0;
}

/// The levels whose edges carry details of a mesh of `level`.
std::vector<SubdivisionLevel> detail_levels(const StreamHeader& header, int level) {
  if (level == 0) return {};
  return subdivision_levels(header.base.vertices, header.base.faces, level - 1, header.base.creases,
                            header.base.corners);
}

/// Everything that encoder and decoder derive from the header and the level that they go to.
struct Structure {
  WaveletTransform transform;
  const std::vector<SubdivisionLevel>& levels;
  EdgeForest forest;

  Structure(const StreamHeader& header, int level)
      : transform(detail_levels(header, level), header.wavelet), levels(transform.levels()), forest(levels) {}
  // `levels` and what `layout` returns point into this.
  Structure(const Structure&) = delete;
  Structure& operator=(const Structure&) = delete;

  /// Positions of `level` from what is known of the coefficients; those of the coarser levels are `visit`ed on the way.
  template <class Visit>
  std::vector<Vec3> reconstruct(const BitplaneCoefficients& known, int level, const StreamHeader& header,
                                Visit visit) const {
    std::vector<Vec3> positions = dequantize_base(known, header);
    for (int l = 0; l < level; ++l) {
      const EdgeFrames frames(levels[l], positions, header.frames);
      std::vector<Vec3> details = dequantize_details(known, forest, l, header);
      for (int e = 0; e < levels[l].edge_count(); ++e)
        if (details[e] != Vec3::Zero()) details[e] = times(frames(e), details[e]);
      visit(positions);
      positions = transform.synthesis(l, std::move(positions), details);
    }
    return positions;
  }

  /// Keeps references to this and to `header`.
  BitplaneLayout layout(const StreamHeader& header) const {
    BitplaneLayout layout;
    layout.base_planes = header.base_planes;
    layout.detail_planes = header.detail_planes;
    layout.levels = header.level;
    layout.scalar = header.kind == StreamKind::Normal;
    layout.base_neighbours.resize(header.base.vertices);
    for (const auto& [a, b] : base_level(header.base.vertices, header.base.faces).edges) {
      layout.base_neighbours[a].push_back(b);
      layout.base_neighbours[b].push_back(a);
    }
    layout.urgency = [this, &header](const BitplaneCoefficients& known) {
      std::vector<std::vector<Vec3>> positions;
      const int finest = std::min(importance_level(header), finest_significant_level(known, forest) + 2);
      positions.push_back(
          reconstruct(known, finest, header, [&](const std::vector<Vec3>& p) { positions.push_back(p); }));
      const auto urgency = std::make_shared<SurfaceUrgency>(levels, forest, std::move(positions),
                                                            header.tangential_ratio, header.frames);
      return [urgency](int node) { return urgency->of(node); };
    };
    return layout;
  }
};

/// A mesh on its way into a stream.
struct Source {
  Bytes connectivity;
  StreamHeader header;
  Structure structure;
  double diagonal;
  int precision_passes;                               ///< kPassesPerPlane to a bit
  std::vector<std::vector<Vec3>> positions, details;  ///< of each level that has details, in coded order

  Source(const SemiregularMesh& mesh, const EncodeOptions& options, Progress& progress)
      : header(header_of(mesh, options, connectivity, progress)),
        structure(header, header.level),
        diagonal(bounding_box_diagonal(mesh.mesh())),
        precision_passes(kPassesPerPlane * options.precision_bits),
        positions(mesh.level + 1),
        details(mesh.level) {
    progress.report("wavelet analysis", 0.1);
    positions[mesh.level] = in_coded_order(mesh, header.base).positions;
    if (options.precision_bits == EncodeOptions::kAutoPrecision)
      precision_passes = mesh.level == 0
                             ? kFlatPrecision
                             : sufficient_precision(structure.levels.back(), positions[mesh.level], diagonal);
    precision_passes = std::min(precision_passes, kPassesPerPlane * most_precision_bits(mesh.level));
    for (int l = mesh.level - 1; l >= 0; --l) {
      WaveletTransform::Split split = structure.transform.analysis(l, positions[l + 1]);
      positions[l] = std::move(split.coarse);
      details[l] = std::move(split.details);
      progress.report("wavelet analysis", 0.8 - 0.7 * l / mesh.level);
    }
  }

  /// Coefficients as integers, details in the frames of a decoder that sees `seen` on each level.
  BitplaneCoefficients quantized(const std::vector<std::vector<Vec3>>& seen, StreamHeader& result) const {
    std::vector<std::vector<Vec3>> local = details;
    for (std::size_t l = 0; l < local.size(); ++l) {
      const EdgeFrames frames(structure.levels[l], seen[l]);
      for (std::size_t e = 0; e < local[l].size(); ++e) local[l][e] = frames(e).transpose() * local[l][e];
    }
    BitplaneCoefficients integers = quantize(positions[0], local, diagonal, precision_bits(), result);
    // Other frames turn a scalar detail. What it moves along the surface is nothing that the stream has a place for.
    if (result.kind == StreamKind::Normal) drop_tangential(structure.forest, integers);
    return integers;
  }
  /// The same in this mesh's own frames, and of what kind they are.
  BitplaneCoefficients quantized_as_it_is(StreamHeader& result) const {
    BitplaneCoefficients integers = quantized(positions, result);
    result.kind = kind_of(structure.forest, integers);
    return integers;
  }

  BitplaneLayout layout(const StreamHeader& result) const {
    BitplaneLayout layout = structure.layout(result);
    layout.last_pass = kMaxUrgency + kPassesPerPlane * precision_bits() - precision_passes;
    return layout;
  }

 private:
  int precision_bits() const { return (precision_passes + kPassesPerPlane - 1) / kPassesPerPlane; }

  static StreamHeader header_of(const SemiregularMesh& mesh, const EncodeOptions& options, Bytes& connectivity,
                                Progress& progress) {
    check(mesh, options);
    progress.report("connectivity", 0.0);
    StreamHeader header;
    header.wavelet = options.wavelet;
    header.tangential_ratio = options.tangential_ratio;
    header.level = mesh.level;
    header.base = encode_connectivity(mesh.base_faces, connectivity, mesh.creases, mesh.corners);
    return header;
  }
};

/// Squared error, in squared thresholds, that a bit is worth (coder/rate_distortion.h), in the order in which they are
/// tried. The slope of rate against squared error of coefficients is about 0.15; less is often better, since zeros err
/// to one side and leave the surface too flat.
constexpr double kBitWorths[] = {0.05, 0.05, 0.0, 0.1, 0.15, 0.05};

void require_room(std::size_t header_size, std::size_t bytes) {
  if (bytes < header_size)
    throw Error(Cause::BadOption, "the header alone takes " + std::to_string(header_size) + " bytes");
}

Bytes cut(Bytes stream, std::size_t bytes) {
  require_room(header_bytes(stream), bytes);
  if (stream.size() > bytes) stream.resize(bytes);
  return stream;
}

Bytes displaced_stream(const SemiregularMesh& mesh, const EncodeOptions& options, Progress& progress,
                       StreamParts* parts) {
  check(mesh, options);
  const double diagonal = std::max(bounding_box_diagonal(mesh.mesh()), mesh.control->grid);
  int precision = kPassesPerPlane * options.precision_bits;
  if (options.precision_bits == EncodeOptions::kAutoPrecision)
    precision = mesh.level == 0
                    ? kFlatPrecision
                    : sufficient_precision(
                          subdivision_levels(mesh.base_vertices, mesh.base_faces, mesh.level - 1, mesh.creases).back(),
                          mesh.positions, diagonal);
  return encode_displaced(mesh, options.wavelet, diagonal, precision, progress, parts);
}

}  // namespace

const char* wavelet_name(Wavelet wavelet) {
  switch (wavelet) {
    case Wavelet::Loop:
      return "loop";
    case Wavelet::Loop11:
      return "loop-11";
    case Wavelet::Butterfly:
      return "butterfly";
    case Wavelet::ButterflyLifted:
      return "butterfly-lifted";
  }
  return "unknown";
}

Wavelet wavelet_of(const std::string& name) { return value_of(kWavelets, wavelet_name, name, "wavelet"); }

Bytes encode(const SemiregularMesh& mesh, const EncodeOptions& options, Progress& progress, StreamParts* parts) {
  if (mesh.control) return displaced_stream(mesh, options, progress, parts);
  const Source source(mesh, options, progress);
  progress.report("entropy coding", 0.8);
  StreamHeader header = source.header;
  const BitplaneCoefficients integers = source.quantized_as_it_is(header);
  Bytes bytes = write_header(header, source.connectivity);
  const std::size_t header_size = bytes.size();
  const BitplaneParts bits = encode_bitplanes(source.structure.forest, source.layout(header), integers, bytes);
  if (parts) *parts = {header_size - source.connectivity.size(), source.connectivity.size(), bits};
  progress.report("entropy coding", 1.0);
  return bytes;
}

Bytes encode_fixed(const SemiregularMesh& mesh, const EncodeOptions& options, std::size_t bytes, Progress& progress) {
  if (mesh.control) return cut(displaced_stream(mesh, options, progress, nullptr), bytes);
  const Source source(mesh, options, progress);
  const SurfaceError error(in_coded_order(mesh, source.header.base).mesh());
  const EdgeForest& forest = source.structure.forest;
  StreamHeader header = source.header;
  BitplaneCoefficients integers = source.quantized_as_it_is(header);
  const std::size_t header_size = write_header(header, source.connectivity).size();
  require_room(header_size, bytes);
  BitplaneCoefficients best;
  StreamHeader best_header;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t round = 0;; ++round) {
    progress.report("rate-distortion optimization", 0.8 + 0.2 * round / (std::size(kBitWorths) + 2));
    const BitplaneState state = encode_bitplanes_until(forest, source.layout(header), integers, bytes - header_size);
    std::vector<std::vector<Vec3>> seen;
    const std::vector<Vec3> decoded =
        source.structure.reconstruct(state.known, header.level, header, [&](const auto& p) { seen.push_back(p); });
    if (const double here = error.of(decoded); round == 0 || here < least) {
      least = here;
      best = integers;
      best_header = header;
    }
    if (round == std::size(kBitWorths)) break;
    integers = rate_distortion_choice(source.quantized(seen, header), state, kBitWorths[round]);
  }
  Bytes stream = write_header(best_header, source.connectivity);
  encode_bitplanes(forest, source.layout(best_header), best, stream);
  if (stream.size() > bytes) stream.resize(bytes);
  progress.report("rate-distortion optimization", 1.0);
  return stream;
}

std::size_t header_bytes(const Bytes& stream) { return header_size(stream.data(), stream.data() + stream.size()); }

SemiregularMesh decode(const Bytes& stream, std::size_t budget) {
  const std::uint8_t* const begin = stream.data();
  const std::size_t needed = header_bytes(stream);
  if (needed > std::min(budget, stream.size()))
    throw Error(Cause::Truncated, "a coded mesh needs at least its header of " + std::to_string(needed) + " bytes");
  const StreamHeader header = read_header(begin, begin + stream.size());

  const std::size_t end = std::min(budget, stream.size());
  const std::int64_t affordable = kFacesPerByte * static_cast<std::int64_t>(std::min(end - needed, stream.size()));
  SemiregularMesh mesh;
  mesh.level = finest_level(header, std::max(kFreeFaces, affordable));
  if (header.kind == StreamKind::Displaced)
    return decode_displaced(header, mesh.level, importance_level(header), begin + needed, begin + end);
  const Structure structure(header, mesh.level);
  const BitplaneCoefficients known =
      decode_bitplanes(structure.forest, structure.layout(header), begin + needed, begin + end);
  mesh.base_vertices = header.base.vertices;
  mesh.base_faces = header.base.faces;
  mesh.creases = header.base.creases;
  mesh.corners = header.base.corners;
  mesh.positions = structure.reconstruct(known, mesh.level, header, [](const std::vector<Vec3>&) {});
  return mesh;
}

}  // namespace gsp

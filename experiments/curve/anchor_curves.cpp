#include "experiments/curve/anchor_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/curve/rate_curve.h"
#include "mesh/parallel.h"

namespace gsp {

namespace {

constexpr int kFewestBits = 4, kMostBits = 16;
// What is on the envelope is foretold from the distance of each decimated surface, by few samples, and the error of the
// grid. On the paper's models the foretold PSNR is within 0.1 dB of the measured one.
constexpr std::size_t kSamplesToForetell = 10000;
// Curves rise by 5 dB and more an octave of bytes, of which one bit more is a fifth. A size that gains less an octave
// of faces over the next smaller one at the same bits is not on the envelope, nor is a bit that gains less than this,
// nor, but for the input itself, one that the next bit gains more on. On the curves of four models bits gained at least
// 0.2, the next ones at most 3.3 dB.
constexpr double kLeastGainPerOctaveDb = 1.2, kLeastGainPerBitDb = 0.2, kMostGainOfNextBitDb = 3.5;
// How far under the foretold curve a combination may be for it to be measured.
constexpr double kMarginDb = 0.2;
// Sizes between two of `decimation_sizes` pass a point under the chord of points so close.
constexpr double kChordOctaves = 0.3;
constexpr double kNoPsnr = -std::numeric_limits<double>::infinity();

CurvePoint with_bits(CurvePoint point, int quantization_bits) {
  point.coder = "draco-qp" + std::to_string(quantization_bits);
  return point;
}

double largest_extent(const Mesh& mesh) {
  if (mesh.positions.empty()) return 0.0;
  Vec3 low = mesh.positions.front(), high = low;
  for (const Vec3& p : mesh.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return (high - low).maxCoeff();
}

// One decimated surface with what its quantizations are foretold to reach.
struct Size {
  Mesh mesh;
  double octaves = 0.0;                                                           // log2 of the face count
  std::vector<double> foretold_db = std::vector<double>(kMostBits + 1, kNoPsnr);  // by bits
};

// The grid moves a vertex by an error of variance step²/12 along the normal. A point between three vertices moves by
// half of that variance on the mean over the triangle.
Size foretold(const Meter& meter, Mesh mesh) {
  Size size;
  size.octaves = std::log2(static_cast<double>(mesh.face_count()));
  Progress silent;
  const double rms = meter.measure(mesh, 0, kSamplesToForetell, silent).rms;
  const double extent = largest_extent(mesh) / bounding_box_diagonal(meter.mesh());
  for (int bits = kFewestBits; bits <= kMostBits; ++bits) {
    const double step = extent / (std::exp2(bits) - 1.0);
    size.foretold_db[bits] = -10.0 * std::log10(rms * rms + step * step / 24.0);
  }
  size.mesh = std::move(mesh);
  return size;
}

// `larger` is null for the input, `smaller` for the smallest size.
bool may_be_on_envelope(const Size& size, const Size* larger, const Size* smaller, int bits) {
  const double db = size.foretold_db[bits];
  if (bits > kFewestBits && db - size.foretold_db[bits - 1] < kLeastGainPerBitDb) return false;
  if (larger && bits < kMostBits && size.foretold_db[bits + 1] - db > kMostGainOfNextBitDb) return false;
  return !smaller || db - smaller->foretold_db[bits] >= kLeastGainPerOctaveDb * (size.octaves - smaller->octaves);
}

struct Candidate {
  AnchorPoint anchor;
  double foretold_db = kNoPsnr;
};

// Calls work(i) for 0 <= i < count, which has one thread each, side by side.
template <class Work>
void side_by_side(std::size_t count, const Work& work) {
  parallel_for(count, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) work(i);
  });
}

std::vector<Candidate> candidates(const Meter& meter, Decimation decimation, Progress& progress) {
  std::vector<Mesh> meshes = decimate(meter.mesh(), decimation_sizes(meter.mesh().face_count()), decimation, progress);
  progress.report("decimate, then Draco: choose", 0.0);
  std::vector<Size> sizes(meshes.size());
  side_by_side(sizes.size(), [&](std::size_t i) { sizes[i] = foretold(meter, std::move(meshes[i])); });
  std::vector<std::pair<std::size_t, int>> chosen;  // size and bits
  for (std::size_t i = 0; i < sizes.size(); ++i)
    for (int bits = kFewestBits; bits <= kMostBits; ++bits)
      if (may_be_on_envelope(sizes[i], i > 0 ? &sizes[i - 1] : nullptr, i + 1 < sizes.size() ? &sizes[i + 1] : nullptr,
                             bits))
        chosen.emplace_back(i, bits);
  progress.report("decimate, then Draco: encode", 0.0);
  std::vector<Candidate> coded(chosen.size());
  side_by_side(coded.size(), [&](std::size_t i) {
    const auto [size, bits] = chosen[i];
    coded[i] = {draco_round_trip(sizes[size].mesh, bits), sizes[size].foretold_db[bits]};
  });
  // A coarse grid may leave no face.
  std::erase_if(coded, [](const Candidate& candidate) { return candidate.anchor.decoded.faces.empty(); });
  return coded;
}

// Leaves those that are foretold to be near the curve, by ascending bytes.
std::vector<AnchorPoint> worth_measuring(std::vector<Candidate> candidates) {
  RateCurve all;
  for (const Candidate& candidate : candidates)
    all.push_back({static_cast<double>(candidate.anchor.bytes), candidate.foretold_db});
  const RateCurve curve = without_dips(upper_envelope(std::move(all)), kChordOctaves);
  std::vector<AnchorPoint> kept;
  for (Candidate& candidate : candidates)
    if (const auto best = psnr_at(curve, static_cast<double>(candidate.anchor.bytes));
        best && candidate.foretold_db >= *best - kMarginDb)
      kept.push_back(std::move(candidate.anchor));
  std::stable_sort(kept.begin(), kept.end(), [](const auto& a, const auto& b) { return a.bytes < b.bytes; });
  return kept;
}

// The points of `measured` on their curve: a point of a size is the best of that size.
std::vector<CurvePoint> on_curve(const std::vector<CurvePoint>& measured) {
  RateCurve all;
  for (const CurvePoint& point : measured) all.push_back({static_cast<double>(point.bytes), point.psnr_db});
  std::vector<CurvePoint> points;
  for (const RatePoint& point : without_dips(upper_envelope(std::move(all)), kChordOctaves))
    points.push_back(*std::find_if(measured.begin(), measured.end(), [&](const CurvePoint& c) {
      return static_cast<double>(c.bytes) == point.bytes && c.psnr_db == point.psnr_db;
    }));
  return points;
}

}  // namespace

std::vector<CurvePoint> draco_curve(const Meter& meter, std::size_t samples, Progress& progress) {
  constexpr int kFirst = 7, kLast = 13;
  std::vector<CurvePoint> points;
  Progress silent;
  for (int bits = kFirst; bits <= kLast; ++bits) {
    progress.report("Draco on the input", static_cast<double>(bits - kFirst) / (kLast - kFirst + 1));
    const AnchorPoint anchor = draco_round_trip(meter.mesh(), bits);
    points.push_back(with_bits(meter.measure(anchor.decoded, anchor.bytes, samples, silent), bits));
  }
  const AnchorPoint lossless = draco_round_trip(meter.mesh(), std::nullopt);
  points.push_back(meter.measure(lossless.decoded, lossless.bytes, samples, silent));
  points.back().coder = kDracoLossless;
  return points;
}

std::vector<int> decimation_sizes(int faces) {
  constexpr int kDenseFrom = 20000, kSmallest = 20;
  std::vector<int> sizes = {faces};
  double size = faces;
  for (;;) {
    size *= std::exp2(size > kDenseFrom ? -1.0 / 3.0 : -1.0 / 6.0);
    if (size < kSmallest) return sizes;
    sizes.push_back(static_cast<int>(std::lround(size)));
  }
}

std::vector<CurvePoint> decimate_draco_curve(const Meter& meter, Decimation decimation, std::size_t samples,
                                             Progress& progress) {
  const std::vector<AnchorPoint> kept = worth_measuring(candidates(meter, decimation, progress));
  std::vector<CurvePoint> points;
  for (const AnchorPoint& anchor : kept) {
    progress.report("decimate, then Draco: measure",
                    static_cast<double>(points.size()) / static_cast<double>(kept.size()));
    Progress silent;
    points.push_back(
        with_bits(meter.measure(anchor.decoded, anchor.bytes, samples, silent), *anchor.quantization_bits));
  }
  return on_curve(points);
}

}  // namespace gsp

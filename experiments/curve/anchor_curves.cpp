#include "experiments/curve/anchor_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "coder/anchors.h"
#include "experiments/curve/rate_curve.h"
#include "mesh/parallel.h"

namespace gsp {

namespace {

// Enough to tell which of two combinations lies higher: the points that are kept are measured again.
constexpr std::size_t kSamplesToChoose = 20000;
constexpr int kFewestBits = 7, kMostBits = 12;  // of decimate-draco

CurvePoint named(CurvePoint point, int quantization_bits) {
  point.coder = "draco-qp" + std::to_string(quantization_bits);
  return point;
}

struct Candidate {
  AnchorPoint anchor;
  double psnr_db = -std::numeric_limits<double>::infinity();  // stays so where a coarse grid leaves no face
};

// One size at every quantization. Draco itself has one thread, so they run side by side.
std::vector<Candidate> quantizations(const Meter& meter, const Mesh& decimated) {
  std::vector<Candidate> row(kMostBits - kFewestBits + 1);
  parallel_for(row.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      Progress silent;
      AnchorPoint& anchor = row[k].anchor;
      anchor = draco_round_trip(decimated, kFewestBits + static_cast<int>(k));
      if (!anchor.decoded.faces.empty())
        row[k].psnr_db = meter.measure(anchor.decoded, anchor.bytes, kSamplesToChoose, silent).psnr_db;
    }
  });
  return row;
}

// Of all sizes and quantizations those on the upper envelope, by ascending bytes.
std::vector<AnchorPoint> envelope_candidates(const Meter& meter, Progress& progress) {
  const std::vector<Mesh> sizes = decimate(meter.mesh(), decimation_sizes(meter.mesh().face_count()), progress);
  std::vector<Candidate> candidates;
  RateCurve all;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    progress.report("decimate, then Draco: choose", static_cast<double>(i) / static_cast<double>(sizes.size()));
    for (Candidate& candidate : quantizations(meter, sizes[i])) {
      all.push_back({static_cast<double>(candidate.anchor.bytes), candidate.psnr_db});
      candidates.push_back(std::move(candidate));
    }
  }
  std::vector<AnchorPoint> kept;
  for (const RatePoint& point : upper_envelope(all)) {
    const auto candidate = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& c) {
      return static_cast<double>(c.anchor.bytes) == point.bytes && c.psnr_db == point.psnr_db;
    });
    kept.push_back(std::move(candidate->anchor));
  }
  return kept;
}

}  // namespace

std::vector<CurvePoint> draco_curve(const Meter& meter, std::size_t samples, Progress& progress) {
  constexpr int kFirst = 7, kLast = 13;
  std::vector<CurvePoint> points;
  Progress silent;
  for (int bits = kFirst; bits <= kLast; ++bits) {
    progress.report("Draco on the input", static_cast<double>(bits - kFirst) / (kLast - kFirst + 1));
    const AnchorPoint anchor = draco_round_trip(meter.mesh(), bits);
    points.push_back(named(meter.measure(anchor.decoded, anchor.bytes, samples, silent), bits));
  }
  return points;
}

std::vector<int> decimation_sizes(int faces) {
  constexpr double kRatio = 0.75;
  constexpr int kSmallest = 64;
  std::vector<int> sizes;
  for (double size = 0.5 * faces; size >= kSmallest; size *= kRatio)
    sizes.push_back(static_cast<int>(std::lround(size)));
  return sizes;
}

std::vector<CurvePoint> decimate_draco_curve(const Meter& meter, std::size_t samples, Progress& progress) {
  const std::vector<AnchorPoint> kept = envelope_candidates(meter, progress);
  std::vector<CurvePoint> points;
  for (const AnchorPoint& anchor : kept) {
    progress.report("decimate, then Draco: measure",
                    static_cast<double>(points.size()) / static_cast<double>(kept.size()));
    Progress silent;
    points.push_back(named(meter.measure(anchor.decoded, anchor.bytes, samples, silent), anchor.quantization_bits));
  }
  return points;
}

}  // namespace gsp

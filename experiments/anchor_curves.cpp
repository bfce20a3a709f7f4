#include "experiments/anchor_curves.h"

#include <algorithm>
#include <cmath>

#include "coder/anchors.h"
#include "experiments/rate_curve.h"

namespace gsp {

namespace {

// Enough to tell which of two combinations lies higher: the points that are kept are measured again.
constexpr std::size_t kSamplesToChoose = 20000;

CurvePoint named(CurvePoint point, const char* method, int quantization_bits) {
  point.method = method;
  point.coder = "draco-qp" + std::to_string(quantization_bits);
  return point;
}

}  // namespace

std::vector<CurvePoint> draco_curve(const Meter& meter, std::size_t samples, Progress& progress) {
  constexpr int kFirst = 7, kLast = 13;
  std::vector<CurvePoint> points;
  Progress silent;
  for (int bits = kFirst; bits <= kLast; ++bits) {
    progress.report("Draco on the input", static_cast<double>(bits - kFirst) / (kLast - kFirst + 1));
    const AnchorPoint anchor = draco_round_trip(meter.mesh(), bits);
    points.push_back(named(meter.measure(anchor.decoded, anchor.bytes, samples, silent), "draco", bits));
  }
  return points;
}

std::vector<int> decimation_sizes(int faces) {
  constexpr double kRatio = 0.75;
  constexpr int kSmallest = 64;
  std::vector<int> sizes;
  for (double size = 0.5 * faces; size >= kSmallest; size *= kRatio) sizes.push_back(static_cast<int>(std::lround(size)));
  return sizes;
}

std::vector<CurvePoint> decimate_draco_curve(const Meter& meter, std::size_t samples, Progress& progress) {
  constexpr int kFirst = 7, kLast = 12;
  Progress silent;
  struct Candidate {
    AnchorPoint anchor;
    double psnr_db;
  };
  std::vector<Candidate> candidates;
  RateCurve all;
  const std::vector<Mesh> sizes = decimate(meter.mesh(), decimation_sizes(meter.mesh().face_count()), progress);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    progress.report("decimate, then Draco", 0.5 * static_cast<double>(i) / static_cast<double>(sizes.size()));
    for (int bits = kFirst; bits <= kLast; ++bits) {
      AnchorPoint anchor = draco_round_trip(sizes[i], bits);
      if (anchor.decoded.faces.empty()) continue;
      const double psnr = meter.measure(anchor.decoded, anchor.bytes, kSamplesToChoose, silent).psnr_db;
      all.push_back({static_cast<double>(anchor.bytes), psnr});
      candidates.push_back({std::move(anchor), psnr});
    }
  }
  std::vector<CurvePoint> points;
  const RateCurve envelope = upper_envelope(all);
  for (const RatePoint& kept : envelope) {
    progress.report("decimate, then Draco",
                    0.5 + 0.5 * static_cast<double>(points.size()) / static_cast<double>(envelope.size()));
    const auto candidate = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& c) {
      return static_cast<double>(c.anchor.bytes) == kept.bytes && c.psnr_db == kept.psnr_db;
    });
    const AnchorPoint& anchor = candidate->anchor;
    points.push_back(named(meter.measure(anchor.decoded, anchor.bytes, samples, silent), "decimate-draco",
                           anchor.quantization_bits));
  }
  return points;
}

}  // namespace gsp

#include "coder/displaced/control_points.h"

#include <cmath>
#include <cstdlib>

#include "coder/bit_model.h"
#include "coder/coding_sides.h"
#include "coder/context_values.h"
#include "mesh/error.h"
#include "remesh/semiregular.h"

namespace gsp {

namespace {

[[noreturn]] void refuse_control() {
  throw Error(Cause::BadStream, "the control points of the coded mesh are damaged");
}

/// Where the points before a vertex lead it to be.
struct Prediction {
  std::array<std::int64_t, 3> point;
  int trust;  ///< parallelograms, at most kMostTrust
};
constexpr int kMostTrust = 2;

template <class Side>
class ControlCoder {
 public:
  ControlCoder(const CodedBase& base, int planes, Side& side)
      : base_(base_level(base.vertices, base.faces)), faces_at_(base.vertices), planes_(planes), side_(side) {
    for (int f = 0; f < base_.face_count(); ++f)
      for (int v : base_.faces[f]) faces_at_[v].push_back(f);
    side_.count_as_base();
  }

  /// `actual`: null to decode.
  std::vector<ControlSteps> run(const std::vector<ControlSteps>* actual) {
    for (int v = 0; v < base_.vertex_count; ++v) {
      const Prediction prediction = predict(v);
      ControlSteps point;
      for (int k = 0; k < 3; ++k) {
        const std::int64_t left = actual ? (*actual)[v][k] - prediction.point[k] : 0;
        const std::int64_t x = prediction.point[k] + code(left, prediction.trust);
        if (x < 0 || x >> planes_ != 0) refuse_control();
        point[k] = static_cast<std::uint32_t>(x);
      }
      points_.push_back(point);
    }
    return std::move(points_);
  }

 private:
  Prediction predict(int v) const {
    std::array<std::int64_t, 3> parallelograms = {0, 0, 0}, neighbours = {0, 0, 0};
    int count = 0, known = 0;
    for (int f : faces_at_[v]) {
      int edge = 0;
      for (int k = 0; k < 3; ++k)
        if (base_.faces[f][k] == v) edge = base_.face_edges[f][(k + 1) % 3];
      const auto [a, b] = base_.edges[edge];
      for (int w : {a, b})
        if (w < v) {
          ++known;
          for (int k = 0; k < 3; ++k) neighbours[k] += points_[w][k];
        }
      const int across = base_.other_face(edge, f);
      const int opposite = across < 0 ? v : base_.opposite_vertex(across, edge);
      if (a >= v || b >= v || opposite >= v) continue;
      ++count;
      for (int k = 0; k < 3; ++k)
        parallelograms[k] += std::int64_t{points_[a][k]} + points_[b][k] - points_[opposite][k];
    }
    Prediction prediction{{}, std::min(count, kMostTrust)};
    const std::int64_t last = (std::int64_t{1} << planes_) - 1;
    for (int k = 0; k < 3; ++k) {
      // A fraction. Coarse meshes bend more than parallelograms do: a half to three tenths of them code within 1%.
      std::int64_t sum = v == 0 ? (last + 1) / 2 : points_[v - 1][k], of = 1;
      if (known > 0) {
        sum = neighbours[k];
        of = known;
      }
      if (count > 0) {
        sum = parallelograms[k] * known + 2 * neighbours[k] * count;
        of = 3 * std::int64_t{count} * known;
      }
      prediction.point[k] = std::clamp<std::int64_t>(floor_of(2 * sum + of, 2 * of), 0, last);
    }
    return prediction;
  }

  static std::int64_t floor_of(std::int64_t a, std::int64_t b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

  /// Its width in unary, the sign, then the bits below the top one.
  std::int64_t code(std::int64_t actual, int trust) {
    const auto magnitude = static_cast<std::uint64_t>(std::llabs(actual));
    const int actual_width = bit_width(magnitude);
    int width = 0;
    while (width <= planes_ && decide(widths_[trust][width], actual_width > width)) ++width;
    if (width == 0) return 0;
    const bool negative = side_.decide(actual < 0, kEven);
    std::uint64_t value = 1;
    for (int bit = width - 2; bit >= 0; --bit) {
      const bool set = magnitude >> bit & 1;
      value = 2 * value + (bit == width - 2 ? decide(second_[width], set) : side_.decide(set, kEven));
    }
    return negative ? -static_cast<std::int64_t>(value) : static_cast<std::int64_t>(value);
  }

  bool decide(AdaptiveBit& context, bool actual) {
    // Of the order of the control points that there are, so that the probabilities are means of all that was coded.
    constexpr int kMemory = 200;
    const bool bit = side_.decide(actual, context.set);
    context.update(bit, kMemory);
    return bit;
  }

  static constexpr Probability kEven = 32768;
  const SubdivisionLevel base_;
  std::vector<std::vector<int>> faces_at_;
  const int planes_;
  Side& side_;
  std::vector<ControlSteps> points_;
  std::array<std::array<AdaptiveBit, kMostControlPlanes + 2>, kMostTrust + 1> widths_;
  std::array<AdaptiveBit, kMostControlPlanes + 2> second_;
};

}  // namespace

void encode_control(const CodedBase& base, int planes, const std::vector<ControlSteps>& points, Bytes& out) {
  EncodingSide side(out);
  ControlCoder<EncodingSide>(base, planes, side).run(&points);
  side.finish();
}

std::vector<ControlSteps> decode_control(const CodedBase& base, int planes, const std::uint8_t* begin,
                                         const std::uint8_t* end) {
  DecodingSide side(begin, end);
  try {
    return ControlCoder<DecodingSide>(base, planes, side).run(nullptr);
  } catch (const StreamEnd&) {
    refuse_control();
  }
}

}  // namespace gsp

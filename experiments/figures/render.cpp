#include "experiments/figures/render.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/error.h"
#include "mesh/parallel.h"
#include "mesh/topology.h"

namespace gsp {

namespace {

/// Samples a pixel in each direction.
constexpr int kSamples = 3;
/// Rows of pixels that are drawn at once.
constexpr std::size_t kBandRows = 32;
/// Empty border as a share of the picture's longer side.
constexpr double kMargin = 0.03;
constexpr int kSmallest = 16, kLargest = 8192;

/// The surface in the picture: x to the right and y down in pixels, z toward the eye in the same unit.
struct Projected {
  int width = 0, height = 0;
  std::vector<Vec3> points;
};

Projected project(const Mesh& mesh, const Camera& camera, int size) {
  Projected result;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& p : mesh.positions)
    result.points.emplace_back(camera.right.dot(p), -camera.up.dot(p), camera.toward.dot(p));
  for (const Triangle& face : mesh.faces)
    for (int v : face) {
      low = low.cwiseMin(result.points[v]);
      high = high.cwiseMax(result.points[v]);
    }
  const double longest = std::max(high.x() - low.x(), high.y() - low.y());
  const double scale = longest > 0.0 ? size * (1.0 - 2.0 * kMargin) / longest : 1.0;
  const double border = kMargin * size;
  const auto pixels = [&](double extent) {
    return std::clamp(static_cast<int>(std::ceil(extent * scale + 2.0 * border)), 1, size);
  };
  result.width = pixels(high.x() - low.x());
  result.height = pixels(high.y() - low.y());
  for (Vec3& p : result.points) p = scale * (p - low) + Vec3(border, border, 0.0);
  return result;
}

/// What a sample sees: the nearest face and where in it.
struct Sample {
  double depth = -std::numeric_limits<double>::infinity();
  int face = -1;
  double w0 = 0.0, w1 = 0.0;
};

class Renderer {
 public:
  Renderer(const Mesh& mesh, const Camera& camera, const Paint& paint, const RenderOptions& options)
      : mesh_(mesh),
        camera_(camera),
        paint_(paint),
        outward_(orientation(mesh)),
        projected_(project(mesh, camera, options.size)) {
    if (options.smooth) normals_ = vertex_normals(mesh);
  }

  Image draw() {
    Image image;
    image.width = projected_.width;
    image.height = projected_.height;
    image.rgb.resize(static_cast<std::size_t>(3) * image.width * image.height);
    parallel_for(static_cast<std::size_t>(image.height), kBandRows, [&](std::size_t begin, std::size_t end) {
      draw_band(static_cast<int>(begin), static_cast<int>(end), image);
    });
    return image;
  }

 private:
  void draw_band(int begin, int end, Image& image) const {
    const int columns = image.width * kSamples;
    std::vector<Sample> samples(static_cast<std::size_t>(columns) * (end - begin) * kSamples);
    for (int f = 0; f < mesh_.face_count(); ++f) scan(f, begin * kSamples, end * kSamples, columns, samples);
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < image.width; ++x) {
        std::array<Sample, kSamples * kSamples> inside;
        for (int k = 0; k < kSamples * kSamples; ++k)
          inside[k] = samples[static_cast<std::size_t>((y - begin) * kSamples + k / kSamples) * columns + x * kSamples +
                              k % kSamples];
        const Colour colour = pixel(inside);
        for (int k = 0; k < 3; ++k)
          image.rgb[3 * (static_cast<std::size_t>(y) * image.width + x) + k] =
              static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(colour[k], 0.0, 1.0)));
      }
  }

  /// Mean colour of a pixel's samples. Those of one face are shaded once, in their middle: paint blurs its own lines.
  Colour pixel(std::array<Sample, kSamples * kSamples>& samples) const {
    std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.face < b.face; });
    Colour sum = Colour::Zero();
    for (std::size_t i = 0; i < samples.size();) {
      Sample mean = samples[i];
      std::size_t end = i + 1;
      for (; end < samples.size() && samples[end].face == mean.face; ++end) {
        mean.w0 += samples[end].w0;
        mean.w1 += samples[end].w1;
      }
      const double count = static_cast<double>(end - i);
      mean.w0 /= count;
      mean.w1 /= count;
      sum += count * shade(mean);
      i = end;
    }
    return sum / static_cast<double>(samples.size());
  }

  /// Weights of the corners as functions of the pixel: w_k = value_k + slope_k · (x, y). False where seen edge-on.
  bool weights(int face, std::array<double, 3>& value, std::array<Eigen::Vector2d, 3>& slope) const {
    const Triangle& t = mesh_.faces[face];
    const auto p = [&](int k) -> const Vec3& { return projected_.points[t[k % 3]]; };
    const double area = (p(1).x() - p(0).x()) * (p(2).y() - p(0).y()) - (p(1).y() - p(0).y()) * (p(2).x() - p(0).x());
    if (area == 0.0) return false;
    for (int k = 0; k < 3; ++k) {
      const Vec3 &a = p(k + 1), &b = p(k + 2);
      slope[k] = Eigen::Vector2d(a.y() - b.y(), b.x() - a.x()) / area;
      value[k] = -slope[k].dot(a.head<2>());
    }
    return true;
  }

  void scan(int face, int first_row, int end_row, int columns, std::vector<Sample>& samples) const {
    const Triangle& t = mesh_.faces[face];
    const Vec3 &a = projected_.points[t[0]], &b = projected_.points[t[1]], &c = projected_.points[t[2]];
    const auto row_of = [](double y) { return static_cast<int>(std::floor(y * kSamples)); };
    const int low = std::max(first_row, row_of(std::min({a.y(), b.y(), c.y()})));
    const int high = std::min(end_row - 1, row_of(std::max({a.y(), b.y(), c.y()})));
    if (low > high) return;
    std::array<double, 3> value;
    std::array<Eigen::Vector2d, 3> slope;
    if (!weights(face, value, slope)) return;
    const int left = std::max(0, row_of(std::min({a.x(), b.x(), c.x()})));
    const int right = std::min(columns - 1, row_of(std::max({a.x(), b.x(), c.x()})));
    for (int row = low; row <= high; ++row)
      for (int column = left; column <= right; ++column) {
        const Eigen::Vector2d at((column + 0.5) / kSamples, (row + 0.5) / kSamples);
        const double w0 = value[0] + slope[0].dot(at), w1 = value[1] + slope[1].dot(at), w2 = 1.0 - w0 - w1;
        if (w0 < 0.0 || w1 < 0.0 || w2 < 0.0) continue;
        const double depth = w0 * a.z() + w1 * b.z() + w2 * c.z();
        Sample& sample = samples[static_cast<std::size_t>(row - first_row) * columns + column];
        if (depth > sample.depth) sample = {depth, face, w0, w1};
      }
  }

  Colour shade(const Sample& sample) const {
    if (sample.face < 0) return Colour::Ones();
    Fragment fragment;
    fragment.face = sample.face;
    fragment.weights = {sample.w0, sample.w1, 1.0 - sample.w0 - sample.w1};
    std::array<double, 3> value;
    weights(sample.face, value, fragment.slopes);
    return light(fragment, paint_(fragment));
  }

  Colour light(const Fragment& fragment, const Colour& colour) const {
    static const Vec3 kKey = Vec3(-0.45, 0.6, 0.75).normalized(), kFill = Vec3(0.8, -0.1, 0.6).normalized();
    const Triangle& t = mesh_.faces[fragment.face];
    const Vec3 flat =
        (mesh_.positions[t[1]] - mesh_.positions[t[0]]).cross(mesh_.positions[t[2]] - mesh_.positions[t[0]]);
    Vec3 normal = Vec3::Zero();
    if (!normals_.empty())
      for (int k = 0; k < 3; ++k) normal += fragment.weights[k] * normals_[t[k]];
    if (!(normal.norm() > 0.0)) normal = flat;
    const double facing = flat.dot(camera_.toward);
    const bool inside = outward_ * facing < 0.0;
    // Lit from the side that is seen, outside or inside.
    const double length = facing < 0.0 ? -normal.norm() : normal.norm();
    if (length == 0.0) return colour;
    const Vec3 n = Vec3(normal.dot(camera_.right), normal.dot(camera_.up), normal.dot(camera_.toward)) / length;
    const double diffuse = 0.36 + 0.56 * std::max(0.0, n.dot(kKey)) + 0.16 * std::max(0.0, n.dot(kFill));
    const double gloss = 0.10 * std::pow(std::max(0.0, n.dot((kKey + Vec3::UnitZ()).normalized())), 40.0);
    return inside ? Colour(0.55 * diffuse * colour) : Colour(diffuse * colour + gloss);
  }

  const Mesh& mesh_;
  const Camera& camera_;
  const Paint& paint_;
  double outward_;
  Projected projected_;
  std::vector<Vec3> normals_;  ///< #V, not of unit length; empty for flat light
};

}  // namespace

Image render(const Mesh& mesh, const Camera& camera, const Paint& paint, const RenderOptions& options) {
  require_finite_surface(mesh);
  if (options.size < kSmallest || options.size > kLargest)
    throw Error(Cause::BadOption, "the size of a picture is not in 16..8192");
  return Renderer(mesh, camera, paint, options).draw();
}

double orientation(const Mesh& mesh) {
  Vec3 middle = Vec3::Zero();
  for (const Triangle& t : mesh.faces)
    middle += (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
  middle /= static_cast<double>(mesh.faces.size());
  double volume = 0.0;
  for (const Triangle& t : mesh.faces)
    volume += (mesh.positions[t[0]] - middle).cross(mesh.positions[t[1]] - middle).dot(mesh.positions[t[2]] - middle);
  return volume < 0.0 ? -1.0 : 1.0;
}

double line_ink(const std::array<double, 3>& values, const Fragment& fragment, double width) {
  double value = 0.0;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  for (int k = 0; k < 3; ++k) {
    value += fragment.weights[k] * values[k];
    slope += values[k] * fragment.slopes[k];
  }
  const double per_pixel = slope.norm();
  if (per_pixel == 0.0) return 0.0;
  const double distance = std::abs(value - std::round(value)) / per_pixel;
  const double ink = std::clamp(0.5 * width + 0.5 - distance, 0.0, 1.0);
  // Spacing in pixels at which lines are drawn in full; below, their mean takes over.
  const double full = std::max(5.0, 1.25 * width);
  const double spacing = 1.0 / per_pixel;
  const double mean = std::min(1.0, width / spacing);
  const double share = std::clamp((spacing - width) / (full - width), 0.0, 1.0);
  return share * ink + (1.0 - share) * mean;
}

}  // namespace gsp

#include "experiments/report/view_data.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include <Eigen/Geometry>

#include "coder/codec.h"
#include "experiments/figures/map_measures.h"
#include "experiments/figures/paint.h"
#include "experiments/figures/remesh_map.h"
#include "experiments/output/base64.h"
#include "experiments/output/decibels.h"
#include "experiments/output/quoting.h"
#include "experiments/output/stream_file.h"
#include "experiments/play/view_frame.h"
#include "mesh/io.h"
#include "mesh/read_file.h"
#include "metrics/surface_distance.h"
#include "remesh/chart_samples.h"

namespace gsp {

namespace {

using Json = nlohmann::ordered_json;

constexpr long long kMostFaces = 70'000;
constexpr std::size_t kMostSizes = 8;
/// Below this a decoded surface is hardly one.
constexpr std::size_t kLeastBytes = 512;

template <class Number>
std::string base64_little_endian(const std::vector<Number>& numbers) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(numbers.size() * sizeof(Number));
  for (Number number : numbers)
    for (std::size_t k = 0; k < sizeof(Number); ++k) bytes.push_back(static_cast<std::uint8_t>(number >> (8 * k)));
  return base64(bytes);
}

/// For each patch the vertices at (i + jω) / n of its chart, row by row.
std::vector<std::uint32_t> patch_grid(const Parameterization& map, int level) {
  const int n = 1 << level;
  const std::size_t in_patch = lattice_index(n, 0, n) + 1;
  std::vector<std::uint32_t> grid(in_patch * map.base.faces.size());
  for (int f = 0; f < map.surface.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const std::array<double, 3> w = chart_barycentric(map.face_corners[f][k]);
      const int i = static_cast<int>(std::lround(n * w[1])), j = static_cast<int>(std::lround(n * w[2]));
      grid[in_patch * map.face_chart[f] + lattice_index(n, i, j)] = static_cast<std::uint32_t>(map.surface.faces[f][k]);
    }
  return grid;
}

/// Shares of the way from neutral to full, in 1/255.
std::vector<std::uint8_t> shares(const std::vector<double>& values, const ColourScale& scale) {
  std::vector<std::uint8_t> result;
  const double range = scale.full - scale.neutral;
  for (double value : values)
    result.push_back(static_cast<std::uint8_t>(
        std::lround(255.0 * (range > 0.0 ? std::clamp((value - scale.neutral) / range, 0.0, 1.0) : 0.0))));
  return result;
}

std::vector<double> vertex_means(const Mesh& mesh, const std::vector<double>& faces) {
  std::vector<double> sum(mesh.positions.size(), 0.0), count(mesh.positions.size(), 0.0);
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (int v : mesh.faces[f]) {
      sum[v] += faces[f];
      count[v] += 1.0;
    }
  for (std::size_t v = 0; v < sum.size(); ++v) sum[v] /= std::max(count[v], 1.0);
  return sum;
}

Json measures_json(const Parameterization& map) {
  const std::map<std::string, std::string> texts = {
      {"anisotropy", "Γ_a, the larger over the smaller singular value; 1 is neutral."},
      {"area", "Γ_d, the product of the singular values, of mean 1."},
      {"smoothness", "Jump of the first derivative between neighbouring faces; 0 is smooth."}};
  Json result;
  for (const MapMeasure& measure : map_measures(map, distortion(map), smoothness(map))) {
    const auto text = texts.find(measure.column.name);
    if (text == texts.end()) continue;
    result[text->first] = {{"gray", measure.scale.neutral},
                           {"red", measure.scale.full},
                           {"text", text->second},
                           {"values", base64(shares(vertex_means(map.surface, measure.column.values), measure.scale))}};
  }
  return result;
}

/// At most kMostSizes of the measured sizes, the largest included, evenly spread over them. Sizes under kLeastBytes are
/// shown where there are no others.
std::vector<CurvePoint> shown_points(const StoredCell& cell) {
  std::vector<CurvePoint> points = cell.points();
  const auto small = [](const CurvePoint& p) { return p.bytes < kLeastBytes; };
  if (!std::all_of(points.begin(), points.end(), small)) std::erase_if(points, small);
  std::sort(points.begin(), points.end(), [](const CurvePoint& a, const CurvePoint& b) { return a.bytes < b.bytes; });
  std::vector<CurvePoint> shown;
  const std::size_t count = std::min(kMostSizes, points.size());
  for (std::size_t i = 0; i < count; ++i)
    shown.push_back(points[count == 1 ? points.size() - 1 : i * (points.size() - 1) / (count - 1)]);
  return shown;
}

SemiregularMesh decoded_point(const StoredCell& cell, const CurvePoint& point) {
  return decode(read_stream(cell.stream_file(point.bytes)), point.bytes);
}

std::string positions_text(const std::vector<Vec3>& positions, const Eigen::AlignedBox3d& box) {
  constexpr double kSteps = 65535.0;
  std::vector<std::uint16_t> numbers;
  for (const Vec3& p : positions)
    for (int k = 0; k < 3; ++k) {
      const double extent = box.sizes()[k];
      numbers.push_back(static_cast<std::uint16_t>(
          extent > 0.0 ? std::lround(kSteps * std::clamp((p[k] - box.min()[k]) / extent, 0.0, 1.0)) : 0));
    }
  return base64_little_endian(numbers);
}

/// The streams of the shown sizes, and of each size which of them it is a prefix of.
struct Streams {
  std::vector<std::string> texts;  ///< base64
  std::vector<std::size_t> of_size;

  Streams(const StoredCell& cell, const std::vector<CurvePoint>& points) {
    std::vector<std::string> paths;
    for (const CurvePoint& point : points) {
      const std::string path = cell.stream_file(point.bytes);
      const auto known = std::find(paths.begin(), paths.end(), path);
      of_size.push_back(static_cast<std::size_t>(known - paths.begin()));
      if (known != paths.end()) continue;
      paths.push_back(path);
      texts.push_back(base64(read_file(path)));
    }
  }
};

Json size_json(const CurvePoint& point, const Mesh& decoded, const SurfaceTree& input, double diagonal) {
  std::vector<double> distances = vertex_distances(decoded, input);
  for (double& d : distances) d /= diagonal;
  std::vector<Weighted> weighted;
  for (double d : distances) weighted.push_back({d, 1.0});
  const double p95 = statistics(std::move(weighted)).p95;
  Json size = {{"bytes", point.bytes}};
  put_db(size, "psnr_db", point.psnr_db);
  size.update({{"distance", base64(shares(distances, {0.0, p95}))}, {"distance_scale", p95}});
  return size;
}

}  // namespace

std::string view_json(const StoredModel& model, const StoredCell& cell, bool with_streams, Progress& progress) {
  const Mesh input = read_mesh(model.path);
  const SurfaceTree tree(input);
  const double diagonal = bounding_box_diagonal(input);
  const std::vector<CurvePoint> points = shown_points(cell);

  const SemiregularMesh whole = decoded_point(cell, points.back());
  const int level = level_within(whole, kMostFaces);
  std::vector<Mesh> decoded;
  Eigen::AlignedBox3d box;
  for (const CurvePoint& point : points) {
    progress.report("decode for the 3D view", static_cast<double>(decoded.size()) / static_cast<double>(points.size()));
    decoded.push_back(at_level(decoded_point(cell, point), level).mesh());
    for (const Vec3& p : decoded.back().positions) box.extend(p);
  }

  const Parameterization map = remesh_as_map(at_level(whole, level));
  Json view = view_frame(input, map.base, box, level);
  Json sizes = Json::array();
  for (std::size_t i = 0; i < points.size(); ++i) sizes.push_back(size_json(points[i], decoded[i], tree, diagonal));
  if (with_streams) {
    const Streams streams(cell, points);
    for (std::size_t i = 0; i < points.size(); ++i) sizes[i]["stream"] = streams.of_size[i];
    view["streams"] = streams.texts;
  } else {
    for (std::size_t i = 0; i < points.size(); ++i) sizes[i]["positions"] = positions_text(decoded[i].positions, box);
    view["grid"] = base64_little_endian(patch_grid(map, level));
  }
  view.update({{"model", printable(model.name)},
               {"label", printable(cell.label)},
               {"measures", measures_json(map)},
               {"sizes", sizes}});
  return view.dump();
}

}  // namespace gsp

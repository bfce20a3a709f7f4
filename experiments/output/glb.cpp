#include "experiments/output/glb.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "mesh/atomic_file.h"
#include "mesh/error.h"
#include "mesh/mesh.h"

namespace gsp {

namespace {

using Json = nlohmann::ordered_json;

// glTF 2.0, §3.6 and §4.4.
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr int kFloat = 5126, kUnsignedInt = 5125, kVertexData = 34962, kIndexData = 34963;

/// Little endian.
void put(std::string& bytes, std::uint32_t word) {
  for (int k = 0; k < 4; ++k) bytes += static_cast<char>(word >> (8 * k));
}

void put(std::string& bytes, const Vec3& v) {
  for (int k = 0; k < 3; ++k) put(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(v[k])));
}

void require_single_precision(const std::vector<Vec3>& positions) {
  Vec3 low = positions.front(), high = low;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (!(positions[v].cwiseAbs().maxCoeff() <= std::numeric_limits<float>::max()))
      throw Error(Cause::NonFinite, "a coordinate is no number of single precision, which glTF has", Element::Vertex,
                  static_cast<long long>(v));
    low = low.cwiseMin(positions[v]);
    high = high.cwiseMax(positions[v]);
  }
  if (low != high && low.cast<float>() == high.cast<float>())
    throw Error(Cause::TooSmall, "the surface is a point in single precision, which glTF has");
}

class Document {
 public:
  Document(const SemiregularMesh& mesh, bool levels) {
    const std::vector<SubdivisionLevel> all = mesh.levels();
    require_single_precision(mesh.positions);
    const int vertex_view = view(12 * mesh.positions.size(), kVertexData);
    for (const Vec3& p : mesh.positions) put(binary_, p);
    if (mesh.creases.empty()) {
      normal_view_ = view(12 * mesh.positions.size(), kVertexData);
      for (const Vec3& n : vertex_normals(mesh.mesh())) {
        const double length = n.stableNorm();
        put(binary_, length > 0.0 ? Vec3(n / length) : Vec3::UnitZ());
      }
    }
    for (int l = mesh.level; l >= (levels ? 0 : mesh.level); --l) add_level(all[l], vertex_view, mesh.positions);
    if (json_["nodes"].size() > 1) add_levels_of_detail();
    json_["buffers"] = {{{"byteLength", binary_.size()}}};
  }

  std::string bytes() const {
    std::string text = json_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t total = 12 + 8 + text.size() + 8 + binary_.size();
    if (total > std::numeric_limits<std::uint32_t>::max())
      throw Error(Cause::CannotWrite, "binary glTF holds at most 4 GB");
    std::string result;
    for (std::size_t word : {std::size_t{kMagic}, std::size_t{kVersion}, total, text.size(), std::size_t{kJsonChunk}})
      put(result, static_cast<std::uint32_t>(word));
    result += text;
    put(result, static_cast<std::uint32_t>(binary_.size()));
    put(result, kBinaryChunk);
    return result + binary_;
  }

 private:
  /// Of what is put next. All contents are multiples of four bytes.
  int view(std::size_t length, int target) {
    Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", length}};
    if (target == kVertexData) view["byteStride"] = 12;
    view["target"] = target;
    json_["bufferViews"].push_back(view);
    return static_cast<int>(json_["bufferViews"].size()) - 1;
  }

  int accessor(int view, int type, std::size_t count, const char* shape) {
    json_["accessors"].push_back({{"bufferView", view}, {"componentType", type}, {"count", count}, {"type", shape}});
    return static_cast<int>(json_["accessors"].size()) - 1;
  }

  void add_level(const SubdivisionLevel& level, int vertex_view, const std::vector<Vec3>& positions) {
    const auto count = static_cast<std::size_t>(level.vertex_count);
    Eigen::Vector3f low = positions.front().cast<float>(), high = low;
    for (std::size_t v = 0; v < count; ++v) {
      low = low.cwiseMin(positions[v].cast<float>());
      high = high.cwiseMax(positions[v].cast<float>());
    }
    Json attributes = {{"POSITION", accessor(vertex_view, kFloat, count, "VEC3")}};
    json_["accessors"].back()["min"] = {low.x(), low.y(), low.z()};
    json_["accessors"].back()["max"] = {high.x(), high.y(), high.z()};
    if (normal_view_) attributes["NORMAL"] = accessor(*normal_view_, kFloat, count, "VEC3");

    const int index_view = view(12 * level.faces.size(), kIndexData);
    for (const Triangle& t : level.faces)
      for (int v : t) put(binary_, static_cast<std::uint32_t>(v));
    const int indices = accessor(index_view, kUnsignedInt, 3 * level.faces.size(), "SCALAR");
    const std::size_t number = json_["nodes"].size();
    json_["meshes"].push_back({{"primitives", {{{"attributes", attributes}, {"indices", indices}, {"material", 0}}}}});
    json_["nodes"].push_back({{"mesh", number}});
  }

  void add_levels_of_detail() {
    Json& nodes = json_["nodes"];
    Json coarser = Json::array(), coverage = Json::array();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (k > 0) coarser.push_back(k);
      // Of the screen, from which on the level is shown. Faces stay as large on it as those of the finest level.
      coverage.push_back(k + 1 < nodes.size() ? std::ldexp(1.0, -2 * static_cast<int>(k + 1)) : 0.0);
    }
    nodes[0]["extensions"]["MSFT_lod"]["ids"] = coarser;
    nodes[0]["extras"]["MSFT_screencoverage"] = coverage;
    json_["extensionsUsed"] = {"MSFT_lod"};
  }

  Json json_ = {
      {"asset", {{"version", "2.0"}, {"generator", "gsp"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", Json::array()},
      {"meshes", Json::array()},
      {"materials",
       {{{"doubleSided", true}, {"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 0.8}}}}}},
      {"bufferViews", Json::array()},
      {"accessors", Json::array()}};
  std::string binary_;
  std::optional<int> normal_view_;
};

}  // namespace

void write_glb(const std::string& path, const SemiregularMesh& mesh, bool levels) {
  write_file(path, Document(mesh, levels).bytes());
}

}  // namespace gsp

#include <draco/compression/decode.h>
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>

#include <cmath>
#include <memory>
#include <string>

#include "coder/anchors.h"
#include "mesh/error.h"

namespace gsp {

namespace {

/// Single precision, as Draco's own tool reads every file.
std::unique_ptr<draco::Mesh> to_draco(const Mesh& mesh) {
  auto result = std::make_unique<draco::Mesh>();
  result->set_num_points(mesh.vertex_count());
  draco::GeometryAttribute position;
  position.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 3 * sizeof(float), 0);
  const int id = result->AddAttribute(position, true, mesh.vertex_count());
  draco::PointAttribute* attribute = result->attribute(id);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Eigen::Vector3f p = mesh.positions[v].cast<float>();
    attribute->SetAttributeValue(draco::AttributeValueIndex(v), p.data());
  }
  result->SetNumFaces(mesh.faces.size());
  for (int f = 0; f < mesh.face_count(); ++f) {
    draco::Mesh::Face face;
    for (int k = 0; k < 3; ++k) face[k] = draco::PointIndex(mesh.faces[f][k]);
    result->SetFace(draco::FaceIndex(f), face);
  }
  // Draco's tool does the same to what it loads: vertices at one position are one vertex.
  result->DeduplicateAttributeValues();
  result->DeduplicatePointIds();
  return result;
}

Mesh from_draco(const draco::Mesh& coded) {
  Mesh mesh;
  const draco::PointAttribute* attribute = coded.GetNamedAttribute(draco::GeometryAttribute::POSITION);
  for (draco::PointIndex p(0); p < coded.num_points(); ++p) {
    Eigen::Vector3f position;
    attribute->GetMappedValue(p, position.data());
    mesh.positions.push_back(position.cast<double>());
  }
  for (draco::FaceIndex f(0); f < coded.num_faces(); ++f) {
    const draco::Mesh::Face& face = coded.face(f);
    mesh.faces.push_back(
        {static_cast<int>(face[0].value()), static_cast<int>(face[1].value()), static_cast<int>(face[2].value())});
  }
  return mesh;
}

void require(const draco::Status& status) {
  if (!status.ok()) throw Error(Cause::Internal, std::string("Draco failed: ") + status.error_msg());
}

}  // namespace

AnchorPoint draco_round_trip(const Mesh& mesh, std::optional<int> quantization_bits) {
  if (quantization_bits && (*quantization_bits < 1 || *quantization_bits > 30))
    throw Error(Cause::BadOption,
                "Draco's quantization of " + std::to_string(*quantization_bits) + " bits is not in 1..30");
  if (mesh.faces.empty()) throw Error(Cause::NoFaces, "Draco codes surfaces with at least one face");
  const std::unique_ptr<draco::Mesh> input = to_draco(mesh);
  draco::Encoder encoder;
  encoder.SetSpeedOptions(0, 0);
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  if (quantization_bits) encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, *quantization_bits);
  draco::EncoderBuffer coded;
  require(encoder.EncodeMeshToBuffer(*input, &coded));

  draco::DecoderBuffer bytes;
  bytes.Init(coded.data(), coded.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&bytes);
  require(decoded.status());
  AnchorPoint point;
  point.bytes = coded.size();
  point.quantization_bits = quantization_bits;
  point.decoded = from_draco(*decoded.value());
  point.faces = point.decoded.face_count();
  return point;
}

}  // namespace gsp

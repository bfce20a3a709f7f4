#pragma once

#include <vector>

#include "coder/codec.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace gsp {

/// What someone would use instead: one coded size and the surface that comes back.
struct AnchorPoint {
  std::size_t bytes = 0;
  int quantization_bits = 0;
  int faces = 0;
  Mesh decoded;
};

/// Codes a triangle mesh by Draco's edgebreaker at its best compression (speed 0, the tool's -cl 10) and decodes it
/// again.
AnchorPoint draco_round_trip(const Mesh& mesh, int quantization_bits);

/// Quadric-error decimation (OpenMesh's decimater) to several face counts, largest first, in one pass.
std::vector<Mesh> decimate(const Mesh& mesh, const std::vector<int>& face_counts, Progress& progress);

}  // namespace gsp

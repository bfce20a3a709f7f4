#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

#include "coder/codec.h"
#include "mesh/io.h"
#include "remesh/semiregular_file.h"
#include "tests/coder/crease_meshes.h"

using namespace gsp;

namespace {

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Whole streams of small meshes and prefixes of them, with every wavelet.
void decoder_seeds(const std::filesystem::path& folder) {
  Progress silent;
  int number = 0;
  for (const SemiregularMesh& mesh :
       {samples::noise(shapes::tetrahedron(), 2), samples::bumpy_sphere(1), samples::wavy_sheet(1),
        samples::noise(shapes::torus(4, 3), 0), samples::creased_cube(2, 0.2), samples::lens(1)})
    for (Wavelet wavelet : kWavelets) {
      EncodeOptions options;
      options.wavelet = wavelet;
      options.precision_bits = 8;
      const Bytes stream = encode(mesh, options, silent);
      const std::string bytes(stream.begin(), stream.end());
      const std::size_t header = header_bytes(stream);
      for (std::size_t size : {header, (header + bytes.size()) / 2, bytes.size()})
        write(folder / std::to_string(number++), bytes.substr(0, size));
    }
}

/// A small mesh in every format, behind the byte that chooses it.
void mesh_seeds(const std::filesystem::path& folder) {
  const SemiregularMesh mesh = samples::noise(shapes::tetrahedron(), 1);
  const char* const endings[] = {".ply", ".obj", ".off", ".stl", ".sr.ply"};
  for (int format = 0; format < 5; ++format) {
    const std::filesystem::path path = folder / (std::string("seed") + endings[format]);
    if (format == 4)
      write_semiregular(path, mesh);
    else
      write_mesh(path, mesh.mesh());
    write(path, static_cast<char>(format) + contents(path));
  }
  const std::filesystem::path creased = folder / "seed-creased.sr.ply";
  write_semiregular(creased, samples::creased_cube(1));
  write(creased, static_cast<char>(4) + contents(creased));
}

}  // namespace

/// fuzz_seeds FOLDER: writes what fuzzing starts from into FOLDER/decoder and FOLDER/mesh.
int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: fuzz_seeds FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  for (const char* target : {"decoder", "mesh"}) std::filesystem::create_directories(folder / target);
  decoder_seeds(folder / "decoder");
  mesh_seeds(folder / "mesh");
}

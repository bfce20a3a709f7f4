#include "tests/coder/golden/golden.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "tests/coder/crease_meshes.h"
#include "tests/coder/displaced_meshes.h"
#include "tests/coder/scalar_meshes.h"

using namespace gsp;

namespace {

const std::string kFolder = "tests/coder/golden/";

/// Streams of versions 6 to 9, as gsp wrote them then, with the hashes of that time: they decode to the same bits for
/// good.
const std::vector<std::string> kOlder = {
    "version-6/sphere-loop.pgc e3b41426e84996bd abe35b8c765a575b",
    "version-6/sheet-butterfly-lifted.pgc 225103e59852c3b2 644457527c064f70",
    "version-6/sphere-butterfly-lifted-fixed.pgc e61f47b35374c6ef 1331f24afefdcb63",
    "version-7/sheet-loop.pgc 39170797c4b2e704 ac1320eb5ec66c4e",
    "version-7/scalar-butterfly.pgc 71094375753149f2 b175eaa3b8303956",
    "version-7/displaced-torus.pgc 4e6710b125d21ab8 ace971a5b1d727fd",
    "version-8/creases-corners.pgc 26d0467d6fc08800 bb8af0203ff2b454",
    "version-8/creases-lens.pgc 2f40b4cb4f5a80d2 ea2f299d8fc8ea7e",
    "version-8/noise-loop.pgc a1bf0bbdb2a77446 dfe2f5eecd5843d4",
    "version-8/scalar-butterfly.pgc 71094375753149f2 b175eaa3b8303956",
    "version-9/displaced-sheet.pgc 3a77934e25d8b37d d185ae7cb51613b0",
};

struct Golden {
  std::string name;
  SemiregularMesh mesh;
  EncodeOptions options;
  std::size_t fixed_bytes = 0;  ///< 0: the embedded stream

  Bytes stream() const {
    Progress silent;
    return fixed_bytes == 0 ? encode(mesh, options, silent) : encode_fixed(mesh, options, fixed_bytes, silent);
  }
};

/// One stream of each wavelet, kind and mode, with and without boundary.
std::vector<Golden> golden_streams() {
  std::vector<Golden> all;
  for (Wavelet wavelet : kWavelets) {
    EncodeOptions options;
    options.wavelet = wavelet;
    options.precision_bits = 14;
    const std::string name = wavelet_name(wavelet);
    all.push_back({"sphere-" + name + ".pgc", samples::bumpy_sphere(4), options});
    all.push_back({"sheet-" + name + ".pgc", samples::wavy_sheet(3), options});
    all.push_back({"sphere-" + name + "-fixed.pgc", samples::bumpy_sphere(4), options, 900});
  }
  EncodeOptions options;
  options.precision_bits = 14;
  for (Wavelet wavelet : {Wavelet::Butterfly, Wavelet::ButterflyLifted})
    all.push_back({"scalar-" + std::string(wavelet_name(wavelet)) + ".pgc",
                   samples::scalar(shapes::grid(3, 4), 3, 0.3, wavelet),
                   {wavelet, 14}});
  all.push_back(
      {"scalar-butterfly-fixed.pgc", samples::scalar(shapes::grid(3, 4), 3, 0.3), {Wavelet::Butterfly, 14}, 500});
  all.push_back({"displaced-torus.pgc", samples::displaced(shapes::torus(6, 4), 3), {Wavelet::ButterflyLifted, 14}});
  all.push_back({"displaced-sheet.pgc", samples::displaced(shapes::grid(3, 4), 3), {Wavelet::ButterflyLifted, 14}});
  all.push_back({"displaced-loop.pgc", samples::displaced(shapes::icosahedron(), 3), {Wavelet::Loop, 14}});
  all.push_back({"creases-cylinder.pgc", samples::cylinder(6, 3), {Wavelet::Loop, 14}});
  SemiregularMesh bent = samples::cylinder(5, 3);
  bent.corners = {bent.creases.front()[0], bent.creases.back()[1]};
  all.push_back({"creases-corners.pgc", bent, {Wavelet::Loop11, 14}});
  all.push_back({"creases-lens.pgc", samples::lens(4), {Wavelet::ButterflyLifted, 14}});
  all.push_back({"creases-cube-fixed.pgc", samples::creased_cube(4, 0.2), {Wavelet::Butterfly, 14}, 400});
  all.push_back({"noise-loop.pgc", samples::noise(shapes::icosahedron(), 3), options});
  return all;
}

}  // namespace

TEST_CASE("golden streams decode to the bits that are kept of them") {
  std::ifstream kept(kFolder + "hashes.txt");
  std::string name;
  std::uint64_t whole, half;
  std::size_t streams = 0;
  while (kept >> name >> std::hex >> whole >> half) {
    INFO(name);
    CHECK(golden::hashes(golden::read(kFolder + name)) == std::vector<std::uint64_t>{whole, half});
    ++streams;
  }
  CHECK(streams == golden_streams().size() + kOlder.size());
}

TEST_CASE("displaced streams, which have no frames, are those of version 7 but for the version and the checksum") {
  const Bytes before = golden::read(kFolder + "version-7/displaced-torus.pgc"),
              now = golden::read(kFolder + "displaced-torus.pgc");
  REQUIRE(before.size() == now.size());
  CHECK(std::equal(before.begin() + 8, before.end(), now.begin() + 8));
}

TEST_CASE("a golden stream with any byte of its payload altered is noticed or differs") {
  const Bytes stream = golden::read(kFolder + "noise-loop.pgc");
  const auto expected = golden::hashes(stream);
  int noticed = 0, tried = 0;
  for (std::size_t byte = header_bytes(stream); byte < stream.size(); byte += 7, ++tried) {
    Bytes damaged = stream;
    damaged[byte] ^= 0x10;
    try {
      const auto found = golden::hashes(damaged);
      CHECK(found != expected);
    } catch (const Error& error) {
      CHECK(error.cause() == Cause::BadStream);
      ++noticed;
    }
  }
  CHECK(noticed > tried / 2);
}

/// Makes the streams anew where the format has changed: GSP_MAKE_GOLDEN=1 test_coder "[make-golden]".
TEST_CASE("golden streams are made", "[.make-golden]") {
  if (!std::getenv("GSP_MAKE_GOLDEN")) return;
  std::ofstream kept(kFolder + "hashes.txt");
  for (const std::string& line : kOlder) kept << line << '\n';
  for (const Golden& golden : golden_streams()) {
    const Bytes stream = golden.stream();
    std::ofstream(kFolder + golden.name, std::ios::binary)
        .write(reinterpret_cast<const char*>(stream.data()), static_cast<std::streamsize>(stream.size()));
    kept << golden.name;
    for (std::uint64_t hash : golden::hashes(stream)) {
      std::ostringstream text;
      text << std::hex << std::setw(16) << std::setfill('0') << hash;
      kept << ' ' << text.str();
    }
    kept << '\n';
  }
}

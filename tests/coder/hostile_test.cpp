#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "coder/codec.h"
#include "coder/header.h"
#include "tests/coder/sample_meshes.h"

using namespace gsp;

namespace {

/// A stream whose header claims `level` and whose body is `body` bytes of a constant.
Bytes hostile(const Mesh& base, int level, std::size_t body, std::uint8_t value) {
  StreamHeader header;
  header.level = level;
  header.base_planes = 31;
  header.detail_planes = 31;
  Bytes connectivity;
  header.base = encode_connectivity(base.faces, connectivity);
  Bytes stream = write_header(header, connectivity);
  stream.insert(stream.end(), body, value);
  return stream;
}

/// Peak memory in bytes that decoding adds to a process of its own.
long decode_peak(const Bytes& stream) {
  int pipes[2];
  REQUIRE(pipe(pipes) == 0);
  const pid_t child = fork();
  if (child == 0) {
    rusage before{}, after{};
    getrusage(RUSAGE_SELF, &before);
    try {
      decode(stream, stream.size());
    } catch (const Error&) {
    }
    getrusage(RUSAGE_SELF, &after);
    const long added = 1024 * (after.ru_maxrss - before.ru_maxrss);
    _exit(write(pipes[1], &added, sizeof added) == sizeof added ? 0 : 1);
  }
  long added = -1;
  const bool complete = read(pipes[0], &added, sizeof added) == sizeof added;
  int status = 0;
  waitpid(child, &status, 0);
  close(pipes[0]);
  close(pipes[1]);
  REQUIRE(complete);
  return added;
}

}  // namespace

// Left out under sanitizers, whose own bookkeeping is most of what would be measured.
TEST_CASE("a header that claims a huge mesh takes under 100 MB", "[slow]") {
  const Mesh tetrahedron = shapes::tetrahedron(), torus = shapes::torus(6, 4);
  for (const auto& [base, level] : {std::pair{tetrahedron, 10}, std::pair{tetrahedron, 8}, std::pair{torus, 10}})
    for (std::size_t body : {0, 20, 100})
      for (int value : {0, 0x55, 0xff})
        CHECK(decode_peak(hostile(base, level, body, static_cast<std::uint8_t>(value))) < 100'000'000);
}

TEST_CASE("bodies of constant bytes decode, or end with a named error") {
  Bytes stream;
  for (const Mesh& base : {shapes::tetrahedron(), shapes::torus(6, 4)})
    for (std::size_t body : {0, 20, 100})
      for (int value : {0, 0x55, 0xff}) {
        stream = hostile(base, 5, body, static_cast<std::uint8_t>(value));
        try {
          CHECK(decode(stream, stream.size()).level <= 5);
        } catch (const Error& error) {
          CHECK(error.cause() == Cause::BadStream);
        }
      }
}

TEST_CASE("a prefix too short for the finest level decodes to a coarser one, and says the same", "[slow]") {
  const SemiregularMesh mesh = samples::bumpy_sphere(8);
  Progress silent;
  EncodeOptions options;
  options.wavelet = Wavelet::Butterfly;
  options.precision_bits = 8;
  const Bytes stream = encode(mesh, options, silent);
  const std::size_t header = header_bytes(stream);
  const SemiregularMesh coarse = decode(stream, header + 200), fine = decode(stream, header + 1000);
  CHECK(coarse.level == 7);
  CHECK(fine.level == 8);
  for (std::size_t v = 0; v < coarse.positions.size(); v += 97)
    CHECK((coarse.positions[v] - fine.positions[v]).norm() < 0.1);
}

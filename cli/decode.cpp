#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/options.h"
#include "cli/print.h"
#include "coder/codec.h"
#include "remesh/semiregular_file.h"

namespace gsp::cli {

namespace {

struct DecodeArguments {
  std::string stream, output;
  std::size_t bytes = 0;
};

Bytes read_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(Cause::CannotOpen, "cannot open " + path + ": " + std::strerror(errno));
  Bytes bytes{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) throw Error(Cause::CannotOpen, "cannot read " + path);
  return bytes;
}

int run_decode(const DecodeArguments& options, Context& context) {
  const Bytes stream = read_bytes(options.stream);
  const std::size_t budget = options.bytes == 0 ? stream.size() : std::min(options.bytes, stream.size());
  const SemiregularMesh mesh = decode(stream, budget);
  write_semiregular(options.output, mesh);
  print_report(context, {{"bytes", budget},
                         {"level", mesh.level},
                         {"vertices", mesh.positions.size()},
                         {"crease_edges", mesh.creases.size()},
                         {"output", options.output}});
  return 0;
}

}  // namespace

void add_decode(CLI::App& app, Context& context) {
  Command command(app, context, "decode", "the mesh of a stream, or of a prefix of it");
  auto options = std::make_shared<DecodeArguments>();
  command.argument("STREAM", options->stream, "stream: *.pgc");
  command.output("MESH", options->output, Content::Ply, "the mesh, *.sr.ply");
  command.size("--bytes", options->bytes, 0, std::numeric_limits<std::size_t>::max(),
               "decode the first N bytes; 0 decodes all");
  command.on_run([options, &context] { return run_decode(*options, context); });
}

}  // namespace gsp::cli

#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/options.h"
#include "cli/print.h"
#include "coder/codec.h"
#include "experiments/output/glb.h"
#include "experiments/output/stream_file.h"
#include "remesh/semiregular_file.h"

namespace gsp::cli {

namespace {

struct DecodeArguments {
  std::string stream, output;
  std::size_t bytes = 0;
  bool levels = false;
};

int run_decode(const DecodeArguments& options, Context& context) {
  const bool glb = has_ending(options.output, Content::Glb);
  if (options.levels && !glb)
    throw Error(Cause::BadOption, "--levels: only binary glTF holds levels of detail, a MESH *.glb");
  const Bytes stream = read_stream(options.stream);
  const std::size_t budget = options.bytes == 0 ? stream.size() : std::min(options.bytes, stream.size());
  const SemiregularMesh mesh = decode(stream, budget);
  if (glb)
    write_glb(options.output, mesh, options.levels);
  else
    write_semiregular(options.output, mesh);
  print_report(context, {{"bytes", budget},
                         {"level", mesh.level},
                         {"levels", options.levels ? mesh.level + 1 : 1},
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
  command.output("MESH", options->output, Content::PlyOrGlb, "the mesh: *.sr.ply, or *.glb for binary glTF");
  command.size("--bytes", options->bytes, 0, std::numeric_limits<std::size_t>::max(),
               "decode the first N bytes; 0 decodes all");
  command.flag("--levels", options->levels, "of *.glb: coarser levels too, as levels of detail (MSFT_lod)");
  command.on_run([options, &context] { return run_decode(*options, context); });
}

}  // namespace gsp::cli

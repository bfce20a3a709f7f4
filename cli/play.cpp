#include "experiments/play/play.h"

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/options.h"
#include "cli/print.h"
#include "experiments/output/stream_file.h"
#include "mesh/atomic_file.h"

namespace gsp::cli {

namespace {

struct PlayArguments {
  std::string stream, output, title;
};

int run_play(const PlayArguments& options, Context& context) {
  const Bytes stream = read_stream(options.stream);
  const std::string title =
      options.title.empty() ? std::filesystem::path(options.stream).stem().string() : options.title;
  const PlayPage page = play_page(stream, title);
  write_file(options.output, page.html);
  print_report(context, {{"bytes", stream.size()},
                         {"header_bytes", page.header_bytes},
                         {"level", page.level},
                         {"shown_level", page.shown_level},
                         {"vertices", page.vertices},
                         {"page_bytes", page.html.size()},
                         {"output", options.output}});
  return 0;
}

}  // namespace

void add_play(CLI::App& app, Context& context) {
  Command command(app, context, "play",
                  "a page that plays a stream: a slider over its bytes beside the decoded surface");
  auto options = std::make_shared<PlayArguments>();
  command.argument("STREAM", options->stream, "stream: *.pgc");
  command.output("PAGE", options->output, Content::Page, "the page, *.html, which opens from disk without a network");
  command.text("--title", options->title, "what the page is called", "the stream's file name");
  command.on_run([options, &context] { return run_play(*options, context); });
}

}  // namespace gsp::cli

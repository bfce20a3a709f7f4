#include "experiments/figures/picture.h"

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/options.h"
#include "cli/print.h"
#include "experiments/figures/map_measures.h"

namespace gsp::cli {

namespace {

struct PictureArguments {
  std::string surface, output, what = subject_name(Subject::Patches);
  PictureOptions picture;
};

std::vector<std::string> subject_words() {
  std::vector<std::string> words;
  for (Subject subject : kSubjects) words.emplace_back(subject_name(subject));
  return words;
}

Subject subject_of(const std::string& word) {
  for (Subject subject : kSubjects)
    if (word == subject_name(subject)) return subject;
  throw Error(Cause::BadOption, "unknown subject " + word);
}

int run_picture(PictureArguments& options, Context& context) {
  Progress progress = context.console.progress();
  options.picture.subject = subject_of(options.what);
  const Picture picture = file_picture(options.surface, options.picture, progress);
  write_png(options.output, picture.image);
  Json report = {{"width", picture.image.width}, {"height", picture.image.height}};
  if (picture.scale) report["colours"] = {{"gray", picture.scale->neutral}, {"red", picture.scale->full}};
  report["output"] = options.output;
  print_report(context, report);
  return 0;
}

}  // namespace

void add_picture(CLI::App& app, Context& context) {
  Command command(app, context, "picture", "a surface or map as PNG: patches, iso-lines, distortion, remesh, distance");
  auto options = std::make_shared<PictureArguments>();
  command.argument("FILE", options->surface, "map (*.param.ply), semi-regular mesh (*.sr.ply) or any surface");
  command.output("PNG", options->output, Content::Picture, "the picture");
  command.choice("--what", options->what, subject_words(),
                 "what is shown; wireframe, surface and distance do with any surface, the others want a map");
  std::vector<std::string> measures = map_measure_names();
  std::erase(measures, subject_name(Subject::Smoothness));  // a subject of its own
  command.choice("--measure", options->picture.measure, measures, "of distortion: gray is neutral, red the worst 5%");
  command.integer("--lines", options->picture.density, 1, 1024, "of isolines: lines across a patch, each way");
  command.read_options(options->picture.read);
  command.remesh_options(options->picture.remesh);
  command.kind_option(options->picture.remesh);
  command.optional_input("--to", options->picture.other, "of distance: the surface to measure to");
  command.direction("--view", options->picture.view.toward, "from where it is seen; auto shows the broadest side");
  command.direction("--up", options->picture.view.up, "what points up; auto takes y or z");
  command.integer("--size", options->picture.render.size, 16, 8192, "pixels of the longer side");
  command.on_run([options, &context] { return run_picture(*options, context); });
}

}  // namespace gsp::cli

#pragma once

#include <string>
#include <vector>

namespace gsp {

// NAME is a `file_stem` (output/quoting.h).

/// The program that draws NAME.png and NAME.svg in its working folder: `setup` (settings and data), then `commands`
/// once for each of the two. Width and height in pixels.
std::string figure_script(const std::string& name, const std::string& setup, const std::string& commands, int width,
                          int height);

/// The names of a figure's files: NAME.png, NAME.svg, NAME.gp.
std::vector<std::string> figure_files(const std::string& name);

/// The program of a figure (`figure_script`).
struct FigureProgram {
  std::string name;
  std::string script;
};

/// Draws figures of different names in one run of gnuplot, whose start takes longer than most figures. Writes
/// FOLDER/NAME.gp for each, so that it can be restyled and drawn again; the figures appear whole or not at all, and are
/// the same bits as alone where all are of one kind. Throws Error: ToolMissing where gnuplot is absent or fails,
/// CannotWrite.
void draw_figures(const std::string& folder, const std::vector<FigureProgram>& figures);

/// `draw_figures` of one. Returns `figure_files`.
std::vector<std::string> draw_figure(const std::string& folder, const std::string& name, const std::string& script);

}  // namespace gsp

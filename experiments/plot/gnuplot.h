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

/// Writes FOLDER/NAME.gp, so that a figure can be restyled and drawn again, and runs gnuplot on it; the figures appear
/// whole or not at all. Returns `figure_files`.
/// Throws Error: ToolMissing where gnuplot is absent or fails, CannotWrite.
std::vector<std::string> draw_figure(const std::string& folder, const std::string& name, const std::string& script);

}  // namespace gsp

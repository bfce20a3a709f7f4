#pragma once

#include <string>
#include <vector>

#include "experiments/store/store.h"

namespace gsp {

/// What other tools read.
enum class ExportFormat {
  Csv,          ///< curve.csv of one recipe
  CompressAI,   ///< one file a model and curve, in the shape of CompressAI's results: bpp (bits per input vertex), psnr
  CodecCompare  ///< one batch a curve over all models, as webmproject/codec-compare reads them
};

/// "csv", "compressai", "codec-compare".
std::vector<std::string> export_format_words();
/// Throws Error(BadOption).
ExportFormat export_format_of(const std::string& word);

/// Writes the cells that are done into a folder, which is made; returns the files. Points that meet the surface exactly
/// have no finite PSNR and are left out of the JSON formats. Throws Error(CannotWrite).
std::vector<std::string> export_cells(const std::vector<StoredCell>& cells, const std::string& recipe,
                                      ExportFormat format, const std::string& folder);

}  // namespace gsp

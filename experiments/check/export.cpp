#include "experiments/check/export.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/curve/curve_csv.h"
#include "experiments/curve/summary.h"
#include "experiments/output/quoting.h"
#include "experiments/store/json_file.h"
#include "experiments/sweep/sweep.h"
#include "experiments/version.h"
#include "mesh/atomic_file.h"

namespace gsp {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kPsnrDefinition = "20 log10(bounding-box diagonal of the input / larger RMS distance)";

struct Format {
  const char* word;
  ExportFormat format;
};
constexpr Format kFormats[] = {{"csv", ExportFormat::Csv},
                               {"compressai", ExportFormat::CompressAI},
                               {"codec-compare", ExportFormat::CodecCompare}};

std::string file_name(const std::string& text, const std::string& ending) {
  std::string stem = file_stem(text);
  std::replace(stem.begin(), stem.end(), ' ', '-');
  return stem + ending;
}

// Other tools have no place for an infinite PSNR.
bool exported(const CurvePoint& point) { return on_a_curve(point) && std::isfinite(point.psnr_db); }

Json compressai_json(const StoredCell& cell) {
  Json bpp = Json::array(), psnr = Json::array();
  for (const CurvePoint& point : cell.points()) {
    if (!exported(point)) continue;
    bpp.push_back(point.bits_per_vertex);
    psnr.push_back(point.psnr_db);
  }
  return {
      {"name", cell.title()},
      {"description", cell.model + ": bpp is bits per input vertex, psnr is " + kPsnrDefinition + "; gsp " + version()},
      {"results", {{"psnr", psnr}, {"bpp", bpp}}}};
}

Json batch_json(const std::string& label, const std::vector<StoredCell>& cells) {
  Json rows = Json::array();
  for (const StoredCell& cell : cells) {
    // Streams of their own for each size are made while they are measured, without a time of their own.
    const StageResult* encode = cell.options.mode == StreamMode::Fixed ? nullptr : cell.stage(StageKind::Encode);
    for (const CurvePoint& point : cell.points())
      if (cell.title() == label && exported(point))
        rows.push_back(
            {cell.model, point.bytes, point.psnr_db, encode ? Json(encode->seconds) : Json(0.0), point.bytes});
  }
  return {{"constant_descriptions",
           {{{"name", "Name of this experiment"}},
            {{"codec", "Name of the codec used to generate this data"}},
            {{"version", "Version of the codec used to generate this data"}}}},
          {"constant_values", {label, label.substr(0, label.find(' ')), version()}},
          {"field_descriptions",
           {{{"original_name", "Original surface"}},
            {{"quality", "Bytes that were decoded"}},
            {{"psnr", std::string("Distortion: ") + kPsnrDefinition}},
            {{"encoding_time", "Encoding duration of the whole embedded stream in seconds, 0 for other coders"}},
            {{"encoded_size", "Size of the encoded surface in bytes"}}}},
          {"field_values", rows}};
}

// Replicates are curves of their own: the formats know no repetition.
std::vector<std::string> labels_of(const std::vector<StoredCell>& cells) {
  std::vector<std::string> labels;
  for (const StoredCell& cell : cells)
    if (cell.status == CellStatus::Done && std::find(labels.begin(), labels.end(), cell.title()) == labels.end())
      labels.push_back(cell.title());
  return labels;
}

}  // namespace

std::vector<std::string> export_format_words() {
  std::vector<std::string> words;
  for (const Format& format : kFormats) words.emplace_back(format.word);
  return words;
}

ExportFormat export_format_of(const std::string& word) {
  for (const Format& format : kFormats)
    if (word == format.word) return format.format;
  throw Error(Cause::BadOption, "unknown format " + word);
}

std::vector<std::string> export_cells(const std::vector<StoredCell>& cells, const std::string& recipe,
                                      ExportFormat format, const std::string& folder) {
  make_folder(folder);
  std::vector<std::string> files;
  const auto next = [&](const std::string& name, const std::string& ending) {
    return files.emplace_back(folder + '/' + file_name(name, ending));
  };
  switch (format) {
    case ExportFormat::Csv:
      write_curve_csv(next(recipe, ".csv"), points_of(cells));
      break;
    case ExportFormat::CompressAI:
      for (const StoredCell& cell : cells)
        if (cell.status == CellStatus::Done)
          write_json(next(cell.model + ' ' + cell.title(), ".json"), compressai_json(cell));
      break;
    case ExportFormat::CodecCompare:
      for (const std::string& label : labels_of(cells)) write_json(next(label, ".json"), batch_json(label, cells));
      break;
  }
  return files;
}

}  // namespace gsp

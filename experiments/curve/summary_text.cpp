#include "experiments/curve/summary.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <ostream>

#include "experiments/cells/cell_options.h"
#include "experiments/output/decibels.h"
#include "experiments/output/quoting.h"

namespace gsp {

namespace {

std::string cell(const std::optional<double>& value, int precision) {
  return value ? fmt::format("{:.{}f}", *value, precision) : "-";
}

int name_width(const CurveSummary& summary) {
  std::size_t width = 14;
  for (const MethodSummary& m : summary.methods) width = std::max(width, m.method.size());
  return static_cast<int>(width) + 2;
}

std::string interval_text(const MeanInterval& interval, int precision) {
  return fmt::format("{:+.{}f} to {:+.{}f}", interval.low, precision, interval.high, precision);
}

// What stands behind a mean of replicates.
std::string certainty(const std::optional<MeanInterval>& interval, int precision) {
  return interval ? interval_text(*interval, precision) : "one run";
}

void print_bd(std::ostream& out, const std::string& first, const MethodSummary& m) {
  if (!m.bd) {
    fmt::print(out, "  BD-rate of {} over {}: none, {}\n", first, m.method, m.no_bd);
    return;
  }
  const std::string sure = m.bd_interval ? interval_text(*m.bd_interval, 1) + "%" : "one run";
  const BdAverage &rate = m.bd->rate, &psnr = m.bd->psnr;
  fmt::print(out, "  BD-rate of {} over {}: {:+.1f}% ({}; {:.1f}..{:.1f} dB, {:.0f}% shared), BD-PSNR {:+.2f} dB",
             first, m.method, rate.value, sure, rate.from, rate.to, 100.0 * rate.overlap_share, psnr.value);
  fmt::print(out, " ({:.0f}..{:.0f} bytes, {:.0f}% shared)\n", psnr.from, psnr.to, 100.0 * psnr.overlap_share);
  for (const std::string& warning : {rate.warning, psnr.warning})
    if (!warning.empty()) fmt::print(out, "    warning: {}\n", warning);
}

void print_model(std::ostream& out, const CurveSummary& summary) {
  out << printable(summary.model) << '\n';
  if (!summary.failure.empty()) fmt::print(out, "  FAILED ({}): {}\n", summary.cause, printable(summary.failure));
  if (summary.methods.empty()) return;
  const int width = name_width(summary);
  fmt::print(out, "  {:<{}}{:>6}{:>6}{:>11}{:>9}", "method", width, "base", "level", "positions", "ceiling");
  for (double level : kTableLevelsDb) fmt::print(out, "{:>9}", fmt::format("{:.0f} dB", level));
  fmt::print(out, "{:>10}{:>17}{:>20}{:>10}\n", "gain", "95% interval", "over bytes", "ratio");
  for (const MethodSummary& m : summary.methods) {
    const bool anchor = m.base_vertices == 0;
    fmt::print(out, "  {:<{}}{:>6}{:>6}{:>11}{:>9}", m.method, width, anchor ? "-" : std::to_string(m.base_vertices),
               anchor ? "-" : std::to_string(m.level), m.positions.empty() ? "-" : m.positions,
               m.ceiling_db ? db_text(*m.ceiling_db, 1) : "-");
    for (const auto& bytes : m.bytes_at) fmt::print(out, "{:>9}", cell(bytes, 0));
    const std::string range = m.gain ? fmt::format("{:.0f}..{:.0f}", m.gain->from_bytes, m.gain->to_bytes) : "-";
    fmt::print(out, "{:>10}{:>17}{:>20}{:>10}\n", m.gain ? fmt::format("{:+.2f} dB", m.gain->mean_db) : "-",
               m.gain ? certainty(m.gain_interval, 2) : "-", range,
               m.bytes_ratio ? fmt::format("{:.2f}x", *m.bytes_ratio) : "-");
  }
  for (const MethodSummary& m : summary.methods)
    if (m.exact_from_bytes) fmt::print(out, "  {} is exact from {:.0f} bytes on\n", m.method, *m.exact_from_bytes);
  for (std::size_t i = 1; i < summary.methods.size(); ++i)
    print_bd(out, summary.methods.front().method, summary.methods[i]);
  for (const MethodSummary& m : summary.methods)
    if (m.lossless_bytes)
      fmt::print(out, "  {} codes the input without loss in {} bytes, from where on no other connectivity can win\n",
                 m.method, *m.lossless_bytes);
}

// "+4.10 dB (+2.90 to +5.30; here alone +3.95 to +4.25; 4 of 4 models, 8 replicates)".
std::string mean_text(const ModelsMean& mean, int precision, const char* unit, std::size_t models) {
  std::string text = fmt::format("{:+.{}f}{} (", mean.value, precision, unit);
  if (mean.of_surfaces) text += interval_text(*mean.of_surfaces, precision) + "; ";
  if (mean.of_models && mean.models > 1)
    text += "on these models alone " + interval_text(*mean.of_models, precision) + "; ";
  text += fmt::format("{} of {} models, ", mean.models, models);
  return text + (mean.replicates > 1 ? fmt::format("{} replicates)", mean.replicates) : "one run)");
}

void print_means(std::ostream& out, const std::vector<CurveSummary>& summaries, const std::string& first) {
  bool any = false;
  for (const std::string& other : compared_methods(summaries)) {
    const MeanGain mean = mean_gain_over(summaries, other);
    if (!mean.gain_db && !mean.bd_rate) continue;
    if (!any) out << "mean over the models\n";
    any = true;
    fmt::print(out, "  {} over {}:", first, other);
    if (mean.gain_db) out << ' ' << mean_text(*mean.gain_db, 2, " dB", summaries.size());
    if (mean.bd_rate)
      out << (mean.gain_db ? ", BD-rate " : " BD-rate ") << mean_text(*mean.bd_rate, 1, "%", summaries.size());
    out << '\n';
  }
}

void print_definitions(std::ostream& out, const std::string& first, bool fixed) {
  fmt::print(
      out,
      "PSNR = 20 log10(bounding-box diagonal of the input / RMS distance), RMS the larger of both directions.\n"
      "A surface that is met exactly has an infinite PSNR, which is written as exact and in no mean.\n"
      "positions: what the remesh's vertices are; the paper's are sampled. ceiling: PSNR of the uncoded remesh.\n"
      "50 dB ...: bytes at which the curve reaches it; - where it starts above, or does not.\n"
      "gain: PSNR of {} less that of the row's method, mean over log-bytes from {:.0f} bytes up to where the first\n"
      "of the two curves is within {:.0f} dB of its own ceiling. ratio: the row's bytes over those of {} at {:.0f} "
      "dB. Neither is said where the curves have nothing of it in common.\n"
      "Curves are linear in log-bytes between their points. decimate-draco: decimated by quadrics, then Draco; "
      "lindstrom-turk-draco:\n"
      "by the collapses that keep the volume, then Draco. Without loss: coordinates in single precision.\n"
      "BD-rate, BD-PSNR: mean bytes of {} at equal PSNR less the other's, and mean PSNR at equal bytes, by PCHIP on "
      "the\n"
      "logarithm of bytes, where both curves are known and under their ceilings less {:.0f} dB; shared: of the range "
      "that\n"
      "either covers.\n"
      "Means over models and replicates: of gains arithmetic, of BD-rates geometric (of bytes over bytes). Intervals: "
      "95%,\n"
      "bootstrap, replicates paired by their base; those of a mean are about other surfaces too, \"on these models "
      "alone\" about\n"
      "chance only. one run: --replicates N says how much of it is chance.\n",
      first, kCompareFromBytes, kCeilingMarginDb, first, kRatioLevelDb, first, kCeilingMarginDb);
  if (fixed)
    fmt::print(
        out,
        "mode=fixed: a stream for each size alone (gsp encode --mode fixed); the other curves are prefixes of one "
        "stream.\n");
}

}  // namespace

void print_summaries(std::ostream& out, const std::vector<CurveSummary>& summaries) {
  std::string first;
  bool fixed = false;
  for (const CurveSummary& summary : summaries) {
    print_model(out, summary);
    for (const MethodSummary& m : summary.methods) fixed = fixed || m.coder == coder_name(StreamMode::Fixed);
    if (first.empty() && !summary.methods.empty()) first = summary.methods.front().method;
  }
  if (first.empty()) return;
  print_means(out, summaries, first);
  print_definitions(out, first, fixed);
}

}  // namespace gsp

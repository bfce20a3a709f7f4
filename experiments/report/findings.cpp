#include "experiments/report/findings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/curve/summary.h"

namespace gsp {

namespace {

/// The values of those options that differ from the defaults, of the axes that apply to the cell's method.
int distance_from_defaults(const CellOptions& options) {
  CellOptions defaults;
  defaults.method = options.method;
  defaults.external = options.external;
  defaults = normalized(defaults);
  int differing = 0;
  for (const Axis& axis : axes())
    if (axis.applies_to(options)) differing += axis.get(options) != axis.get(defaults);
  return differing;
}

/// The label of a method whose options are nearest to the defaults; empty where the run has none.
std::string standard_label(const Run& run, const std::string& method) {
  const StoredCell* best = nullptr;
  for (const StoredCell& cell : run.cells)
    if (cell.options.method == method &&
        (!best || distance_from_defaults(cell.options) < distance_from_defaults(best->options)))
      best = &cell;
  return best ? best->label : std::string();
}

std::string fewer_or_more(double saved) {
  return fmt::format("{:.{}f}% {} bytes", std::abs(saved), std::abs(saved) < 9.95 ? 1 : 0,
                     saved >= 0.0 ? "fewer" : "more");
}

/// "−41%" with the minus sign of typography; no sign before a zero.
std::string signed_percent(double value, int digits) {
  const std::string size = fmt::format("{:.{}f}%", std::abs(value), digits);
  const bool zero = size.find_first_of("123456789") == std::string::npos;
  return (zero ? "" : value < 0.0 ? "−" : "+") + size;
}

std::string models_word(int count) { return count == 1 ? "1 model" : fmt::format("{} models", count); }

/// "the mean of 4 models and 8 replicates", "the mean of 8 replicates".
std::string mean_of(const Standing& s) {
  if (s.models == 1 && s.replicates > 1) return fmt::format("the mean of {} replicates", s.replicates);
  std::string text = "the mean of " + models_word(s.models);
  if (s.replicates > 1) text += fmt::format(" and {} replicates", s.replicates);
  return text;
}

/// "−1.3%, −4.7 to +2.1%"; of one run the number alone.
std::string with_interval(double value, const std::optional<MeanInterval>& interval) {
  std::string text = signed_percent(value, 1);
  if (!interval) return text;
  const std::string low = signed_percent(interval->low, 1);
  return text + fmt::format(", {} to {}", low.substr(0, low.size() - 1), signed_percent(interval->high, 1));
}

/// " (22 to 29%)", of bytes that are fewer or more by as much as `saved` says; empty for one run.
std::string size_interval(double saved, const std::optional<MeanInterval>& bytes) {
  if (!bytes) return "";
  const int digits = std::abs(saved) < 9.95 ? 1 : 0;
  double low = saving(bytes->low), high = saving(bytes->high);
  if (saved < 0.0) low = -low, high = -high;
  return fmt::format(" ({:.{}f} to {:.{}f}%)", std::min(low, high), digits, std::max(low, high), digits);
}

/// "gsp needs 41% fewer bytes (36 to 45%) than maps at equal PSNR", or that no difference can be told.
std::string against(const std::string& reference, const Standing& other) {
  const double saved = saving(other.bd_rate);
  if (!other.interval || !other.interval->holds(0.0))
    return fmt::format("{} needs {}{} than {} at equal PSNR", reference, fewer_or_more(saved),
                       size_interval(saved, other.interval), other.label);
  const MeanInterval mirrored{-saved, -saving(other.interval->high), -saving(other.interval->low)};
  return fmt::format("Between {} and {} no difference in bytes at equal PSNR can be told ({})", reference, other.label,
                     with_interval(-saved, mirrored));
}

/// "gsp needs 41% fewer bytes (36 to 45%) than maps at equal PSNR, the mean of 2 models and 8 replicates (horse −44%,
/// venus −38%)."
void tell_method(const Findings& found, const std::string& label, std::vector<std::string>& sentences) {
  std::string each;
  std::vector<std::string> missing;
  bool elsewhere = false;
  for (const Comparison& c : found.comparisons) {
    if (c.label != label) continue;
    if (c.bd_rate)
      each += fmt::format("{}{} {}{}", each.empty() ? "" : ", ", c.model, signed_percent(-saving(*c.bd_rate), 0),
                          c.note.empty() ? "" : "*");
    else
      missing.push_back(c.model), elsewhere = c.note == kNoComparison;
  }
  const std::optional<Standing> mean = found.mean(label);
  if (!mean) {
    if (elsewhere)
      sentences.push_back(fmt::format("{} is drawn alone: {}.", label, kNoComparison));
    else if (!missing.empty())
      sentences.push_back(fmt::format("{} and {} reach no common PSNR below their ceilings.", found.reference, label));
    return;
  }
  std::string sentence = against(found.reference, *mean);
  if (mean->models > 1)
    sentence += fmt::format(", {} ({})", mean_of(*mean), each);
  else
    sentence +=
        " on " + each.substr(0, each.rfind(' ')) + (mean->replicates > 1 ? ", " + mean_of(*mean) : std::string());
  sentence += '.';
  if (each.find('*') != std::string::npos) sentence += " * The curves overlap by less than half.";
  if (!missing.empty()) sentence += fmt::format(" No common range on {}.", fmt::join(missing, ", "));
  sentences.push_back(sentence);
}

/// Settings of the reference's method with their means over the models, best first; those that lack a model that the
/// others have are left out and counted, since a mean over fewer models is another question.
std::vector<Standing> ranked_settings(const Run& run, const Findings& found, const std::string& method, int& left_out) {
  std::vector<Standing> settings;
  left_out = 0;
  for (const std::string& label : run.labels()) {
    const auto cell =
        std::find_if(run.cells.begin(), run.cells.end(), [&](const StoredCell& c) { return c.label == label; });
    if (cell->options.method != method || label == found.reference) continue;
    if (const auto mean = found.mean(label))
      settings.push_back(*mean);
    else
      ++left_out;
  }
  int most = 0, replicates = std::numeric_limits<int>::max();
  for (const Standing& s : settings) most = std::max(most, s.models);
  left_out += static_cast<int>(std::erase_if(settings, [&](const Standing& s) { return s.models < most; }));
  for (const Standing& s : settings) replicates = std::min(replicates, s.replicates);
  settings.push_back({found.reference, 0.0, std::nullopt, most, replicates});
  std::stable_sort(settings.begin(), settings.end(),
                   [](const Standing& a, const Standing& b) { return a.bd_rate < b.bd_rate; });
  return settings;
}

/// How the others stand against the best of the ranked settings. Their intervals hold all at once with 95%
/// (Bonferroni), since the best was chosen after it was seen.
std::vector<Standing> over_best(const Findings& found, const std::vector<Standing>& settings) {
  const auto name = [&](const Standing& s) { return s.label == found.reference ? std::string() : s.label; };
  const double confidence = 1.0 - 0.05 / static_cast<double>(settings.size() - 1);
  std::vector<Standing> others;
  for (std::size_t i = 1; i < settings.size(); ++i)
    if (auto over = standing(found.comparisons, name(settings[i]), name(settings.front()), confidence)) {
      over->label = settings[i].label;
      others.push_back(*over);
    }
  std::stable_sort(others.begin(), others.end(),
                   [](const Standing& a, const Standing& b) { return a.bd_rate < b.bd_rate; });
  return others;
}

/// "Best by model, against gsp gamma=2: horse: gsp gamma=4 (−3.1%); venus: the reference itself." Models on which
/// nothing compares with the reference are left out. Without replicates a difference that prints as 0.0% is none; with
/// them, one whose interval holds 0.
std::string best_by_model(const Run& run, const Findings& found, const std::vector<Standing>& settings) {
  constexpr double kLeastSaving = 0.05;
  std::string text;
  bool improved = false;
  for (const StoredModel& model : run.models) {
    const Comparison* best = nullptr;
    bool compared = false;
    for (const Standing& s : settings) {
      const Comparison* c = found.comparison(model.name, s.label);
      if (!c || !c->bd_rate) continue;
      compared = true;
      const bool better = c->interval ? c->interval->high < 0.0 : *c->bd_rate < -kLeastSaving;
      if (better && (!best || *c->bd_rate < *best->bd_rate)) best = c;
    }
    if (!compared) continue;
    improved = improved || best;
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", model.name, best ? best->label : "the reference itself");
    if (best) text += fmt::format(" ({})", with_interval(*best->bd_rate, best->interval));
  }
  if (!improved) return fmt::format("No setting is better than {} on any model.", found.reference);
  return fmt::format("Best by model, against {}: {}.", found.reference, text);
}

/// " (horse −3.1%, venus +0.4%)": what a mean is made of, empty for one model.
std::string by_model(const Findings& found, const std::string& label) {
  std::string text;
  int models = 0;
  for (const Comparison& c : found.comparisons) {
    if (c.label != label || !c.bd_rate) continue;
    text += fmt::format("{}{} {}", models ? ", " : "", c.model, signed_percent(*c.bd_rate, 1));
    ++models;
  }
  return models > 1 ? " (" + text + ")" : std::string();
}

/// Which of the settings cannot be told from the best, and how much more the others need.
std::string others_in_words(const std::vector<Standing>& others) {
  std::vector<std::string> alike;
  const Standing *next = nullptr, *worst = nullptr;
  int worse = 0;
  for (const Standing& s : others) {
    if (s.interval && s.interval->low <= 0.0) {
      alike.push_back(fmt::format("{} ({})", s.label, with_interval(s.bd_rate, s.interval)));
      continue;
    }
    ++worse;
    if (!next) next = &s;
    worst = &s;
  }
  const auto more = [](const Standing& s) {
    return fmt::format("{:.1f}% more{}", s.bd_rate,
                       s.interval ? fmt::format(" ({:.1f} to {:.1f}%)", s.interval->low, s.interval->high) : "");
  };
  std::string text;
  if (!alike.empty()) text = fmt::format("; {} cannot be told from it", fmt::join(alike, ", "));
  if (worse > 0 && alike.empty())
    text += fmt::format("; the next best, {}, needs {} than it", next->label, more(*next));
  else if (worse > 0)
    text += fmt::format("; {} need{} more for sure, the least of them {} {}", worse, worse == 1 ? "s" : "", next->label,
                        more(*next));
  if (worse > 1) text += fmt::format(", the worst, {}, {}", worst->label, more(*worst));
  return text;
}

/// Which setting of the reference's method is best, and by how much.
void tell_settings(const Run& run, const Findings& found, const std::string& method,
                   std::vector<std::string>& sentences) {
  int left_out = 0;
  const std::vector<Standing> settings = ranked_settings(run, found, method, left_out);
  if (settings.size() < 2) return;
  const Standing& best = settings.front();
  const std::vector<Standing> others = over_best(found, settings);
  const bool sure = std::none_of(others.begin(), others.end(),
                                 [](const Standing& s) { return s.interval && s.interval->low <= 0.0; });
  std::string sentence = fmt::format("Of {} settings{} {} needs the fewest bytes at equal PSNR, {}", settings.size(),
                                     sure ? "," : " none is best for sure:", best.label, mean_of(best));
  if (best.label != found.reference)
    sentence += fmt::format(": {:.1f}% fewer than {}{}", -best.bd_rate, found.reference, by_model(found, best.label));
  sentence += others_in_words(others);
  if (best.replicates > 1) sentence += "; the intervals hold all at once with 95%";
  if (left_out > 0)
    sentence += fmt::format("; {} more {} not compared, for want of a model", left_out, left_out == 1 ? "is" : "are");
  std::vector<std::string> without;
  for (const StoredModel& model : run.models) {
    const Comparison* c = found.comparison(model.name, best.label == found.reference ? settings[1].label : best.label);
    if (c && !c->bd_rate) without.push_back(model.name);
  }
  if (!without.empty())
    sentence += fmt::format("; on {} the curves share no PSNR below their ceilings", fmt::join(without, ", "));
  sentences.push_back(sentence + ".");
  sentences.push_back(best_by_model(run, found, settings));
}

/// "Exact on cube: gsp from 231 bytes, draco from 189 bytes." The curves that reach no PSNR in common for that reason.
void tell_exact(const Run& run, std::vector<std::string>& sentences) {
  for (const StoredModel& model : run.models) {
    std::string text;
    for (const CurveSeries& curve : run.curves(model.name))
      if (const auto bytes = exact_from(curve))
        text += fmt::format("{}{} from {:.0f} bytes", text.empty() ? "" : ", ", curve.name, *bytes);
    if (!text.empty()) sentences.push_back(fmt::format("Exact on {}, without any distance: {}.", model.name, text));
  }
}

void tell_certainty(const Findings& found, std::vector<std::string>& sentences) {
  const auto& all = found.comparisons;
  if (std::any_of(all.begin(), all.end(), [](const Comparison& c) { return c.log_rates.size() > 1; }))
    sentences.push_back(
        "Means are geometric, of bytes over bytes; intervals hold with 95%: those of several models are about other "
        "surfaces too, those of one about chance alone.");
  else if (std::any_of(all.begin(), all.end(), [](const Comparison& c) { return c.bd_rate.has_value(); }))
    sentences.push_back("Each number is of one run: how much of it is chance is not known without replicates.");
}

void tell_missing(const Run& run, std::vector<std::string>& sentences) {
  const auto count = [&](CellStatus status) {
    return std::count_if(run.cells.begin(), run.cells.end(), [&](const StoredCell& c) { return c.status == status; });
  };
  if (const auto failed = count(CellStatus::Failed))
    sentences.push_back(fmt::format("{} of {} cells failed; their causes are below.", failed, run.cells.size()));
  if (const auto waiting = count(CellStatus::Waiting))
    sentences.push_back(fmt::format("{} of {} cells have not run yet.", waiting, run.cells.size()));
}

}  // namespace

double saving(double bd_rate) { return 100.0 * (1.0 - 1.0 / (1.0 + bd_rate / 100.0)); }

const Comparison* Findings::comparison(const std::string& model, const std::string& label) const {
  for (const Comparison& c : comparisons)
    if (c.model == model && c.label == label) return &c;
  return nullptr;
}

std::optional<Standing> Findings::mean(const std::string& label) const { return standing(comparisons, label, ""); }

Findings findings(const Run& run) {
  Findings found;
  std::vector<std::string> methods;
  for (const StoredCell& cell : run.cells)
    if (std::find(methods.begin(), methods.end(), cell.options.method) == methods.end())
      methods.push_back(cell.options.method);
  if (methods.empty()) {
    found.sentences.push_back("The run has no cells.");
    return found;
  }
  const std::string gsp = method_name(Method::Gsp);
  const std::string method = std::find(methods.begin(), methods.end(), gsp) != methods.end() ? gsp : methods.front();
  found.reference = standard_label(run, method);
  found.comparisons = comparisons_with(run, found.reference);
  for (const std::string& other : methods)
    if (other != method) tell_method(found, standard_label(run, other), found.sentences);
  tell_settings(run, found, method, found.sentences);
  tell_exact(run, found.sentences);
  tell_certainty(found, found.sentences);
  tell_missing(run, found.sentences);
  return found;
}

}  // namespace gsp

#include "experiments/report/findings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "experiments/curve/summary.h"

namespace gsp {

namespace {

/// The values of those options that differ from the defaults, of the axes that apply to the cell's method.
int distance_from_defaults(const CellOptions& options) {
  CellOptions defaults;
  defaults.method = options.method;
  defaults = normalized(defaults);
  int differing = 0;
  for (const Axis& axis : axes())
    if (axis.applies_to(options.method)) differing += axis.get(options) != axis.get(defaults);
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

Comparison compare(const StoredCell& reference, const StoredCell& cell) {
  Comparison result{cell.model, cell.label, {}, {}};
  try {
    const BdResult bd = bd_compare(bd_curve(reference.points()), bd_curve(cell.points()), {});
    result.bd_rate = bd.rate.value;
    result.note = bd.rate.warning;
  } catch (const Error& error) {
    result.note = error.what();
  }
  return result;
}

std::vector<Comparison> compare_all(const Run& run, const std::string& reference) {
  std::vector<Comparison> all;
  for (const StoredCell& base : run.cells) {
    if (base.label != reference || base.status != CellStatus::Done) continue;
    for (const StoredCell& cell : run.cells)
      if (cell.model == base.model && cell.label != reference && cell.status == CellStatus::Done)
        all.push_back(compare(base, cell));
  }
  return all;
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

/// "gsp needs 41% fewer bytes than maps at equal PSNR: horse 44%, venus 38%."
void tell_method(const Findings& found, const std::string& label, std::vector<std::string>& sentences) {
  double sum = 0.0;
  int count = 0;
  std::string each;
  std::vector<std::string> missing;
  for (const Comparison& c : found.comparisons) {
    if (c.label != label) continue;
    if (!c.bd_rate) {
      missing.push_back(c.model);
      continue;
    }
    const double saved = saving(*c.bd_rate);
    sum += saved;
    ++count;
    each += fmt::format("{}{} {}{}", each.empty() ? "" : ", ", c.model, signed_percent(-saved, 0),
                        c.note.empty() ? "" : "*");
  }
  if (count == 0) {
    if (!missing.empty())
      sentences.push_back(fmt::format("{} and {} reach no common PSNR below their ceilings.", found.reference, label));
    return;
  }
  std::string sentence =
      fmt::format("{} needs {} than {} at equal PSNR", found.reference, fewer_or_more(sum / count), label);
  sentence += count == 1 ? fmt::format(" on {}.", each.substr(0, each.rfind(' ')))
                         : fmt::format(", the mean of {} ({}).", models_word(count), each);
  if (each.find('*') != std::string::npos) sentence += " * The curves overlap by less than half.";
  if (!missing.empty()) sentence += fmt::format(" No common range on {}.", fmt::join(missing, ", "));
  sentences.push_back(sentence);
}

struct Setting {
  std::string label;
  double bd_rate;
  int models;
};

/// Settings of the reference's method with their means over the models, best first; those that lack a model that the
/// others have are left out and counted, since a mean over fewer models is another question.
std::vector<Setting> ranked_settings(const Run& run, const Findings& found, const std::string& method, int& left_out) {
  std::vector<Setting> settings;
  left_out = 0;
  for (const std::string& label : run.labels()) {
    const auto cell =
        std::find_if(run.cells.begin(), run.cells.end(), [&](const StoredCell& c) { return c.label == label; });
    if (cell->options.method != method || label == found.reference) continue;
    int models = 0;
    if (const auto mean = found.mean_bd_rate(label, models))
      settings.push_back({label, *mean, models});
    else
      ++left_out;
  }
  int most = 0;
  for (const Setting& s : settings) most = std::max(most, s.models);
  left_out += static_cast<int>(std::erase_if(settings, [&](const Setting& s) { return s.models < most; }));
  settings.push_back({found.reference, 0.0, most});
  std::stable_sort(settings.begin(), settings.end(),
                   [](const Setting& a, const Setting& b) { return a.bd_rate < b.bd_rate; });
  return settings;
}

/// "Best by model, against gsp gamma=2: horse: gsp gamma=4 (−3.1%); venus: the reference itself." Models on which
/// nothing compares with the reference are left out; a difference that prints as 0.0% is none.
std::string best_by_model(const Run& run, const Findings& found, const std::vector<Setting>& settings) {
  constexpr double kLeastSaving = 0.05;
  std::string text;
  bool improved = false;
  for (const StoredModel& model : run.models) {
    std::string best = "the reference itself";
    double least = -kLeastSaving;
    bool compared = false, better = false;
    for (const Setting& s : settings) {
      const Comparison* c = found.comparison(model.name, s.label);
      if (!c || !c->bd_rate) continue;
      compared = true;
      if (*c->bd_rate >= least) continue;
      least = *c->bd_rate;
      best = s.label;
      better = true;
    }
    if (!compared) continue;
    improved = improved || better;
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", model.name, best);
    if (better) text += fmt::format(" ({})", signed_percent(least, 1));
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

/// Which setting of the reference's method is best, and by how much.
void tell_settings(const Run& run, const Findings& found, const std::string& method,
                   std::vector<std::string>& sentences) {
  int left_out = 0;
  const std::vector<Setting> settings = ranked_settings(run, found, method, left_out);
  if (settings.size() < 2) return;
  const Setting &best = settings.front(), &next = settings[1], &worst = settings.back();
  const auto over = [&](const Setting& s) { return 100.0 * ((100.0 + s.bd_rate) / (100.0 + best.bd_rate) - 1.0); };
  std::string sentence = fmt::format("Of {} settings, {} needs the fewest bytes at equal PSNR, the mean of {}",
                                     settings.size(), best.label, models_word(best.models));
  if (best.label != found.reference)
    sentence += fmt::format(": {:.1f}% fewer than {}{}", -best.bd_rate, found.reference, by_model(found, best.label));
  sentence += fmt::format("; the next best, {}, needs {:.1f}% more than it", next.label, over(next));
  if (settings.size() > 2) sentence += fmt::format(", the worst, {}, {:.1f}%", worst.label, over(worst));
  if (left_out > 0)
    sentence += fmt::format("; {} more {} not compared, for want of a model", left_out, left_out == 1 ? "is" : "are");
  std::vector<std::string> without;
  for (const StoredModel& model : run.models) {
    const Comparison* c = found.comparison(
        model.name, settings.front().label == found.reference ? settings[1].label : settings.front().label);
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
      if (const auto bytes = exact_from(envelope_of(curve.points)))
        text += fmt::format("{}{} from {:.0f} bytes", text.empty() ? "" : ", ", curve.name, *bytes);
    if (!text.empty()) sentences.push_back(fmt::format("Exact on {}, without any distance: {}.", model.name, text));
  }
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

std::optional<double> Findings::mean_bd_rate(const std::string& label, int& models) const {
  double sum = 0.0;
  models = 0;
  for (const Comparison& c : comparisons)
    if (c.label == label && c.bd_rate) {
      sum += *c.bd_rate;
      ++models;
    }
  if (models == 0) return std::nullopt;
  return sum / models;
}

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
  found.comparisons = compare_all(run, found.reference);
  for (const std::string& other : methods)
    if (other != method) tell_method(found, standard_label(run, other), found.sentences);
  tell_settings(run, found, method, found.sentences);
  tell_exact(run, found.sentences);
  tell_missing(run, found.sentences);
  return found;
}

}  // namespace gsp

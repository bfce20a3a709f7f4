#include "experiments/check/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/curve/summary.h"
#include "experiments/output/decibels.h"
#include "experiments/output/quoting.h"
#include "metrics/bd_rate.h"
#include "metrics/bootstrap.h"

namespace gsp {

namespace {

constexpr const char* kNone = "-";
// Share of checks that may fail by chance alone.
constexpr double kFalseAlarms = 0.05;

// The value of an option where nothing is said of it; "-" where there is no such option.
std::string default_text(const std::string& name) {
  const auto axis = std::find_if(axes().begin(), axes().end(), [&](const Axis& a) { return name == a.name; });
  return axis == axes().end() ? kNone : to_string(axis->get({}));
}

// Only decibels of an exact surface are infinite.
std::string text(double value) { return std::isinf(value) ? db_text(value, 0) : fmt::format("{:.6g}", value); }

class Checker {
 public:
  Checker(const Baseline& baseline, const Baseline& run, const CheckOptions& options)
      : baseline_(baseline), run_(run), options_(options) {}

  CheckResult result() {
    result_.rows = baseline_.rows;
    for (const BaselineRow& row : baseline_.rows) comparisons_ += static_cast<int>(row.numbers.size()) + 1;
    for (const BaselineRow& row : baseline_.rows) {
      before_ = &row;
      const BaselineRow* now = find(run_, row);
      now_ = now;
      if (!now)
        moved("row", "there", "missing", kNone, Verdict::Regressed);
      else
        compare(row, *now);
    }
    for (const BaselineRow& row : run_.rows) {
      before_ = &row;
      if (!find(baseline_, row)) moved("row", "missing", "there", kNone, Verdict::Added);
    }
    if (result_.compared == 0)
      result_.moved.push_back({kNone, kNone, "numbers compared", kNone, "0", kNone, Verdict::Regressed});
    return std::move(result_);
  }

 private:
  static const BaselineRow* find(const Baseline& where, const BaselineRow& row) {
    const auto found = std::find_if(where.rows.begin(), where.rows.end(), [&](const BaselineRow& other) {
      return other.model == row.model && other.label == row.label;
    });
    return found == where.rows.end() ? nullptr : &*found;
  }

  void moved(const std::string& what, const std::string& before, const std::string& after, const std::string& allowed,
             Verdict verdict) {
    result_.moved.push_back({before_->model, before_->label, what, before, after, allowed, verdict});
  }

  void compare(const BaselineRow& before, const BaselineRow& now) {
    if (before.cause != now.cause) {
      const auto state = [](const std::string& cause) { return cause.empty() ? "done" : "failed (" + cause + ")"; };
      moved("row", state(before.cause), state(now.cause), kNone,
            now.cause.empty() ? Verdict::Improved : Verdict::Regressed);
    }
    if (!before.surface.empty() && !now.surface.empty() && before.surface != now.surface) {
      // Its numbers say nothing about those of the surface before.
      moved("another surface", before.surface, now.surface, kNone, Verdict::Changed);
      return;
    }
    compare_options(before, now);
    compare_numbers(before.numbers, now.numbers);
    compare_bd(before, now);
    if (options_.times) compare_numbers(before.times, now.times);
  }

  void compare_options(const BaselineRow& before, const BaselineRow& now) {
    std::set<std::string> names;
    for (const auto* options : {&before.options, &now.options})
      for (const auto& [name, value] : *options) names.insert(name);
    // An option that is newer than the baseline had its default when that was measured.
    const auto value_of = [](const BaselineRow& row, const std::string& name) {
      const auto found = row.options.find(name);
      return found == row.options.end() ? default_text(name) : found->second;
    };
    for (const std::string& name : names)
      if (value_of(before, name) != value_of(now, name))
        moved("option " + name, value_of(before, name), value_of(now, name), "none", Verdict::Changed);
  }

  void compare_numbers(const std::map<std::string, double>& before, const std::map<std::string, double>& now) {
    for (const auto& [name, value] : before) {
      const auto found = now.find(name);
      if (found == now.end())
        moved(name, text(value), kNone, kNone, Verdict::Regressed);
      else
        compare_number(name, value, found->second);
    }
    for (const auto& [name, value] : now)
      if (!before.contains(name)) moved(name, kNone, text(value), kNone, Verdict::Added);
  }

  void compare_number(const std::string& name, double before, double now) {
    ++result_.compared;
    if (now == before) return;  // also where both are infinite
    const Quantity& quantity = quantity_of(name);
    const auto given = baseline_.tolerances.find(quantity.name);
    const Tolerance tolerance = given == baseline_.tolerances.end() ? quantity.tolerance : given->second;
    const double allowed =
        std::isfinite(before)
            ? std::max({tolerance.absolute, tolerance.relative * std::abs(before), explained_by_chance(name)})
            : 0.0;
    // What is no number any more has moved too.
    if (std::abs(now - before) <= allowed) return;
    Verdict verdict = Verdict::Changed;
    if (quantity.direction != Direction::MayNotChange && !std::isnan(now))
      verdict =
          (now > before) == (quantity.direction == Direction::HigherIsBetter) ? Verdict::Improved : Verdict::Regressed;
    moved(name, text(before), text(now), text(allowed), verdict);
  }

  /// How far a mean of the run's replicates lies from that of the baseline's by chance, so that of all comparisons of
  /// one check none passes it in 95% of the checks (Student's t, Bonferroni). 0 where the baseline has one replicate.
  double explained_by_chance(const std::string& name) const {
    const auto deviation = before_->deviations.find(name);
    if (deviation == before_->deviations.end() || before_->replicates < 2) return 0.0;
    const double both = 1.0 / before_->replicates + 1.0 / now_->replicates;
    const double moved = deviation->second * std::sqrt(both) *
                         student_quantile(1.0 - 0.5 * kFalseAlarms / comparisons_, before_->replicates - 1.0);
    return name == kBdRate ? 100.0 * std::expm1(moved / 100.0) : moved;
  }

  void compare_bd(const BaselineRow& before, const BaselineRow& now) {
    const BdOptions options{.ceiling_margin_db = kCeilingMarginDb};
    try {
      bd_compare(bd_curve(before), bd_curve(before), options);
    } catch (const Error&) {
      ++result_.without_bd;
      return;
    }
    try {
      compare_number(kBdRate, 0.0, bd_compare(bd_curve(before), bd_curve(now), options).rate.value);
    } catch (const Error& error) {
      // A curve that has become exact may have too few points of finite PSNR left; its numbers tell that it is better.
      if (exact_from(now.curve) && !exact_from(before.curve))
        ++result_.without_bd;
      else
        moved(kBdRate, "0", error.what(), kNone, Verdict::Regressed);
    }
  }

  const Baseline& baseline_;
  const Baseline& run_;
  const CheckOptions& options_;
  const BaselineRow* before_ = nullptr;
  const BaselineRow* now_ = nullptr;
  int comparisons_ = 0;  ///< that chance may decide
  CheckResult result_;
};

}  // namespace

const char* verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::Regressed:
      return "regressed";
    case Verdict::Changed:
      return "changed";
    case Verdict::Improved:
      return "improved";
    case Verdict::Added:
      break;
  }
  return "added";
}

bool CheckResult::passed() const {
  return std::none_of(moved.begin(), moved.end(), [](const Movement& movement) { return movement.fails(); });
}

CheckResult check(const Baseline& baseline, const Baseline& run, const CheckOptions& options) {
  return Checker(baseline, run, options).result();
}

std::string junit_report(const CheckResult& result, const std::string& recipe) {
  std::string cases;
  int failures = 0, tests = 0;
  const auto add_case = [&](const std::string& model, const std::string& label) {
    std::string message;
    for (const Movement& m : result.moved)
      if (m.fails() && m.model == model && m.label == label)
        message += xml_text(fmt::format("{}: {} -> {} (allowed {})", m.what, m.before, m.after, m.allowed)) + '\n';
    ++tests;
    failures += !message.empty();
    cases += fmt::format("  <testcase classname=\"{}\" name=\"{}\"", xml_text(model), xml_text(label));
    cases +=
        message.empty() ? "/>\n" : fmt::format("><failure message=\"regressed\">{}</failure></testcase>\n", message);
  };
  for (const BaselineRow& row : result.rows) add_case(row.model, row.label);
  if (result.compared == 0) add_case(kNone, kNone);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"{}\" tests=\"{}\" "
      "failures=\"{}\">\n{}</testsuite>\n",
      xml_text(recipe), tests, failures, cases);
}

}  // namespace gsp

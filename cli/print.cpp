#include "cli/print.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>

#include "experiments/output/profile_json.h"
#include "experiments/output/quoting.h"
#include "experiments/version.h"

namespace gsp::cli {

namespace {

constexpr std::size_t kItemsShown = 10;

std::string title(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string value_text(const Json& value) {
  if (value.is_null()) return "-";
  if (value.is_string()) return printable(value.get<std::string>());
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  return value.dump();
}

// A list element on one line: "vertices 8, faces 12", or the value alone.
std::string item_text(const Json& item) {
  if (!item.is_object()) return value_text(item);
  std::string text;
  for (const auto& [name, value] : item.items())
    text += (text.empty() ? "" : ", ") + title(name) + ' ' + value_text(value);
  return text;
}

void print_lines(std::ostream& out, const Json& report, const std::string& indent) {
  std::size_t width = 0;
  for (const auto& [name, value] : report.items())
    if (value.is_primitive()) width = std::max(width, name.size());
  for (const auto& [name, value] : report.items()) {
    out << indent << title(name);
    if (value.is_object()) {
      out << '\n';
      print_lines(out, value, indent + "  ");
    } else if (value.is_array()) {
      out << '\n';
      for (std::size_t i = 0; i < std::min(value.size(), kItemsShown); ++i)
        out << indent << "  " << item_text(value[i]) << '\n';
      if (value.size() > kItemsShown) out << indent << "  ... and " << value.size() - kItemsShown << " more\n";
    } else {
      out << std::string(width - name.size() + 2, ' ') << value_text(value) << '\n';
    }
  }
}

}  // namespace

void print_text(std::ostream& out, const Json& report) { print_lines(out, report, ""); }

void print_report(const Context& context, const Json& report) {
  if (!context.json) return print_text(context.out, report);
  Json whole = {{"program", "gsp"}, {"version", version()}};
  whole.update(report);
  // Names of files may hold any bytes; those that are not UTF-8 are replaced.
  context.out << whole.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void print_report(const Context& context, Json report, const std::vector<ProfileStep>& steps) {
  if (context.json) {
    report["profile"] = profile_json(steps);
    return print_report(context, report);
  }
  print_report(context, report);
  context.out << fmt::format("{:<44}{:>6}{:>10}{:>10}{:>10}\n", "step", "runs", "wall s", "CPU s", "peak MB");
  for (const ProfileStep& s : steps)
    context.out << fmt::format("{:<44}{:>6}{:>10.3f}{:>10.3f}{:>10.1f}\n", std::string(2 * s.depth, ' ') + s.name,
                               s.runs, s.seconds, s.cpu_seconds, s.peak_megabytes);
}

Json error_report(const Error& error) {
  Json report = {{"cause", cause_name(error.cause())}, {"message", error.what()}};
  if (error.index()) {
    report["element"] = element_name(error.element());
    report["index"] = *error.index();
    if (error.place()->end) report["end"] = *error.place()->end;
  }
  return report;
}

}  // namespace gsp::cli

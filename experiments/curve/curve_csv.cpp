#include "experiments/curve/curve_csv.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <type_traits>

#include "experiments/curve/point_fields.h"
#include "mesh/atomic_file.h"
#include "mesh/error.h"
#include "mesh/read_file.h"

namespace gsp {

namespace {

std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

// One record of RFC 4180 from `text` at `at`, which moves behind it; lines are counted. Quoted fields may hold line
// breaks.
std::vector<std::string> next_record(const std::string& text, std::size_t& at, long long& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '\n') ++line;
    if (quoted) {
      if (c != '"')
        fields.back() += c;
      else if (at + 1 < text.size() && text[at + 1] == '"')
        fields.back() += text[++at];
      else
        quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      fields.emplace_back();
    } else if (c == '\n') {
      ++at;
      break;
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  return fields;
}

// A row by the names of its columns.
class Row {
 public:
  Row(const std::map<std::string, std::size_t>& columns, const std::vector<std::string>& fields, long long line)
      : columns_(columns), fields_(fields), line_(line) {}

  const std::string& text(const char* name) const {
    const auto column = columns_.find(name);
    if (column == columns_.end()) throw Error(Cause::Malformed, std::string("no column ") + name, Element::Line, 1);
    if (column->second >= fields_.size())
      throw Error(Cause::Malformed, std::string("the row ends before ") + name, Element::Line, line_);
    return fields_[column->second];
  }

  void read(const char* name, std::string& value) const { value = text(name); }

  template <class Number>
  void read(const char* name, Number& value) const {
    const std::string& word = text(name);
    const auto end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    bool good = error == std::errc() && stop == end;
    if constexpr (std::is_floating_point_v<Number>) good = good && std::isfinite(value);
    if (!good) throw Error(Cause::Malformed, std::string(name) + " is no number: " + word, Element::Line, line_);
  }

 private:
  const std::map<std::string, std::size_t>& columns_;
  const std::vector<std::string>& fields_;
  long long line_;
};

CurvePoint point_of(const Row& row) {
  CurvePoint point;
  for (const PointField& field : point_fields())
    std::visit([&](auto member) { row.read(field.name, point.*member); }, field.member);
  return point;
}

std::string text_of(const PointField& column, const CurvePoint& point) {
  return std::visit([&](auto member) { return field(fmt::format(fmt::runtime(column.format), point.*member)); },
                    column.member);
}

}  // namespace

std::vector<CurvePoint> read_curve_csv(const std::string& path) try {
  const std::string text = read_text(path);
  std::size_t at = 0;
  long long line = 1;
  std::map<std::string, std::size_t> columns;
  for (const std::string& name : next_record(text, at, line)) columns.emplace(name, columns.size());
  std::vector<CurvePoint> points;
  while (at < text.size()) {
    const long long first_line = line;
    const std::vector<std::string> fields = next_record(text, at, line);
    if (fields.size() > 1) points.push_back(point_of(Row(columns, fields, first_line)));
  }
  return points;
} catch (const Error& error) {
  throw error.within(path);
}

void write_curve_csv(const std::string& path, const std::vector<CurvePoint>& points) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  const char* separator = "";
  for (const PointField& column : point_fields()) {
    out << separator << column.name;
    separator = ",";
  }
  out << '\n';
  for (const CurvePoint& point : points) {
    separator = "";
    for (const PointField& column : point_fields()) {
      out << separator << text_of(column, point);
      separator = ",";
    }
    out << '\n';
  }
  file.commit();
}

}  // namespace gsp

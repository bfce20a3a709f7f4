#include "experiments/output/csv.h"

#include <charconv>
#include <cmath>
#include <type_traits>

#include "mesh/error.h"

namespace gsp {

namespace {

// One record from `text` at `at`, which moves behind it; lines are counted.
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

void skip_comments(const std::string& text, std::size_t& at, long long& line) {
  while (at < text.size() && text[at] == '#') {
    at = std::min(text.find('\n', at), text.size() - 1) + 1;
    ++line;
  }
}

}  // namespace

const std::string& CsvRow::text(const char* column) const {
  const auto found = columns_->find(column);
  if (found == columns_->end()) throw Error(Cause::Malformed, std::string("no column ") + column, Element::Line, 1);
  if (found->second >= fields_.size())
    throw Error(Cause::Malformed, std::string("the row ends before ") + column, Element::Line, line_);
  return fields_[found->second];
}

template <class Number>
void CsvRow::read(const char* column, Number& value) const {
  const std::string& word = text(column);
  const auto end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  bool good = error == std::errc() && stop == end;
  if constexpr (std::is_floating_point_v<Number>) good = good && std::isfinite(value);
  if (!good) throw Error(Cause::Malformed, std::string(column) + " is no number: " + word, Element::Line, line_);
}

template void CsvRow::read(const char*, int&) const;
template void CsvRow::read(const char*, std::size_t&) const;
template void CsvRow::read(const char*, double&) const;

std::vector<CsvRow> csv_rows(const std::string& text) {
  std::size_t at = 0;
  long long line = 1;
  skip_comments(text, at, line);
  const auto columns = std::make_shared<CsvRow::Columns>();
  for (const std::string& name : next_record(text, at, line)) columns->emplace(name, columns->size());
  std::vector<CsvRow> rows;
  for (skip_comments(text, at, line); at < text.size(); skip_comments(text, at, line)) {
    const long long first_line = line;
    std::vector<std::string> fields = next_record(text, at, line);
    if (fields.size() > 1) rows.emplace_back(columns, std::move(fields), first_line);
  }
  return rows;
}

}  // namespace gsp

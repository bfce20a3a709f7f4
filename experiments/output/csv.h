#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace gsp {

/// One record of a CSV file by the names of its columns.
class CsvRow {
 public:
  using Columns = std::map<std::string, std::size_t>;
  CsvRow(std::shared_ptr<const Columns> columns, std::vector<std::string> fields, long long line)
      : columns_(std::move(columns)), fields_(std::move(fields)), line_(line) {}

  long long line() const { return line_; }
  bool has(const char* column) const { return columns_->count(column) > 0; }
  /// Throws Error(Malformed) where there is no such column, or the row ends before it.
  const std::string& text(const char* column) const;
  /// A text, or a finite number as std::from_chars reads it: int, std::size_t or double. Throws Error(Malformed).
  void read(const char* column, std::string& value) const { value = text(column); }
  template <class Number>
  void read(const char* column, Number& value) const;

 private:
  std::shared_ptr<const Columns> columns_;
  std::vector<std::string> fields_;
  long long line_;
};

/// The records of a CSV text (RFC 4180: fields in quotes may hold commas, quotes and line breaks) after the first,
/// which names the columns. Lines of one field are left out, and so are those that begin with #.
std::vector<CsvRow> csv_rows(const std::string& text);

}  // namespace gsp

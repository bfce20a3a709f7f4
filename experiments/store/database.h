#pragma once

#include <cstdint>
#include <memory>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace gsp {

/// A prepared statement. Columns count from 0, parameters are bound in order.
class Statement {
 public:
  Statement(sqlite3* database, const std::string& sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(const std::string& text);
  Statement& bind(std::int64_t value);
  Statement& bind(double value);
  /// Binds all of them from the first parameter on, runs to the end and is ready for the next values.
  template <class... Values>
  void run(const Values&... values) {
    restart();
    (bind(values), ...);
    while (step()) {
    }
  }

  /// Goes to the next row; false at the end.
  bool step();
  void restart();
  std::string text(int column) const;
  std::int64_t integer(int column) const;
  double real(int column) const;

 private:
  sqlite3* database_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

/// An SQLite database with a write-ahead log. Failures throw Error(CannotWrite) where the file system or a lock is in
/// the way, Error(Malformed) otherwise.
class Database {
 public:
  /// Opens the file; makes it where it is missing and `create` is set, else throws Error(CannotOpen).
  Database(const std::string& path, bool create);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void execute(const std::string& sql);
  std::unique_ptr<Statement> prepare(const std::string& sql) const;

 private:
  sqlite3* handle_ = nullptr;
};

/// Everything between construction and `commit` happens, or nothing of it.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace gsp

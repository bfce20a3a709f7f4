#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
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

enum class Access {
  Read,   ///< changes nothing in the folder, which may be on a medium or of an owner that forbids it
  Write,  ///< makes the file where it is missing
};

/// An SQLite database with a write-ahead log. Failures throw Error(CannotWrite) where the file system or a lock is in
/// the way of writing, Error(CannotOpen) where it is in the way of reading, Error(Malformed) otherwise.
class Database {
 public:
  /// Throws Error(CannotOpen) where the file cannot be opened.
  Database(const std::string& path, Access access);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void execute(const std::string& sql);
  std::unique_ptr<Statement> prepare(const std::string& sql) const;

  /// True where it was opened to be read without the locks that would be files beside it, and has been written since:
  /// what was read may be half of the old and half of the new. It is to be opened and read again.
  bool stale() const;

 private:
  /// What tells whether a file was written.
  struct Stamp {
    std::filesystem::file_time_type time;
    std::uintmax_t size = 0;
    bool operator==(const Stamp&) const = default;
  };
  static Stamp stamp_of(const std::string& path);
  void open(const std::string& name, int flags);
  void open_to_read(const std::string& path);
  void open_copy(const std::string& path);

  sqlite3* handle_ = nullptr;
  std::string path_;
  std::optional<Stamp> unlocked_;  ///< of the file when it was opened without locks
  std::string copy_;               ///< folder of a copy, removed at the end
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

#include "experiments/store/database.h"

#include <sqlite3.h>

#include "mesh/error.h"

namespace gsp {

namespace {

[[noreturn]] void fail(sqlite3* database, int status) {
  const std::string why = database ? sqlite3_errmsg(database) : sqlite3_errstr(status);
  switch (status & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_READONLY:
    case SQLITE_FULL:
    case SQLITE_IOERR:
    case SQLITE_PERM:
      throw Error(Cause::CannotWrite, "the results database cannot be written: " + why);
    case SQLITE_CANTOPEN:
      throw Error(Cause::CannotOpen, "the results database cannot be opened: " + why);
    default:
      throw Error(Cause::Malformed, "the results database is damaged: " + why);
  }
}

}  // namespace

Statement::Statement(sqlite3* database, const std::string& sql) : database_(database) {
  const int status = sqlite3_prepare_v2(database, sql.c_str(), static_cast<int>(sql.size()), &statement_, nullptr);
  if (status != SQLITE_OK) fail(database, status);
}

Statement::~Statement() { sqlite3_finalize(statement_); }

Statement& Statement::bind(const std::string& text) {
  const int status =
      sqlite3_bind_text(statement_, ++bound_, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  if (status != SQLITE_OK) fail(database_, status);
  return *this;
}

Statement& Statement::bind(std::int64_t value) {
  const int status = sqlite3_bind_int64(statement_, ++bound_, value);
  if (status != SQLITE_OK) fail(database_, status);
  return *this;
}

Statement& Statement::bind(double value) {
  const int status = sqlite3_bind_double(statement_, ++bound_, value);
  if (status != SQLITE_OK) fail(database_, status);
  return *this;
}

bool Statement::step() {
  const int status = sqlite3_step(statement_);
  if (status == SQLITE_ROW) return true;
  if (status == SQLITE_DONE) return false;
  fail(database_, status);
}

void Statement::restart() {
  sqlite3_reset(statement_);
  bound_ = 0;
}

std::string Statement::text(int column) const {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  return bytes ? std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))) : std::string();
}

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(statement_, column); }

double Statement::real(int column) const { return sqlite3_column_double(statement_, column); }

Database::Database(const std::string& path, bool create) {
  const int flags = SQLITE_OPEN_READWRITE | (create ? SQLITE_OPEN_CREATE : 0);
  const int status = sqlite3_open_v2(path.c_str(), &handle_, flags, nullptr);
  if (status != SQLITE_OK) {
    const std::string why = sqlite3_errstr(status);
    sqlite3_close(handle_);
    throw Error(Cause::CannotOpen, "cannot open " + path + ": " + why);
  }
  constexpr int kPatienceMilliseconds = 20000;
  sqlite3_busy_timeout(handle_, kPatienceMilliseconds);
}

Database::~Database() { sqlite3_close(handle_); }

void Database::execute(const std::string& sql) {
  const int status = sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr);
  if (status != SQLITE_OK) fail(handle_, status);
}

std::unique_ptr<Statement> Database::prepare(const std::string& sql) const {
  return std::make_unique<Statement>(handle_, sql);
}

Transaction::Transaction(Database& database) : database_(database) { database_.execute("BEGIN IMMEDIATE"); }

Transaction::~Transaction() {
  if (!open_) return;
  try {
    database_.execute("ROLLBACK");
  } catch (const Error&) {
    // The exception under way says more than that its changes could not be taken back; SQLite drops them on closing.
  }
}

void Transaction::commit() {
  database_.execute("COMMIT");
  open_ = false;
}

}  // namespace gsp

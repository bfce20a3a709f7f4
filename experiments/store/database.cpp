#include "experiments/store/database.h"

#include <sqlite3.h>

#include <cctype>
#include <cstdlib>

#include "mesh/error.h"

namespace gsp {

namespace {

namespace fs = std::filesystem;

// A path in SQLite's URIs, where %, ? and # have a meaning.
std::string uri_path(const std::string& path) {
  std::string uri;
  for (unsigned char c : path) {
    constexpr const char* kDigits = "0123456789ABCDEF";
    if (std::isalnum(c) || c == '/' || c == '.' || c == '-' || c == '_')
      uri += static_cast<char>(c);
    else
      uri += {'%', kDigits[c >> 4], kDigits[c & 15]};
  }
  return uri;
}

[[noreturn]] void fail(sqlite3* database, int status) {
  const std::string why = database ? sqlite3_errmsg(database) : sqlite3_errstr(status);
  const bool reading = database && sqlite3_db_readonly(database, "main") == 1;
  switch (status & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_READONLY:
    case SQLITE_FULL:
    case SQLITE_IOERR:
    case SQLITE_PERM:
      throw reading ? Error(Cause::CannotOpen, "the results database cannot be read: " + why)
                    : Error(Cause::CannotWrite, "the results database cannot be written: " + why);
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

Database::Database(const std::string& path, Access access) : path_(path) {
  if (access == Access::Read)
    open_to_read(path);
  else
    open(path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
}

Database::~Database() {
  sqlite3_close(handle_);
  std::error_code ignored;
  if (!copy_.empty()) fs::remove_all(copy_, ignored);
}

void Database::open(const std::string& name, int flags) {
  const int status = sqlite3_open_v2(name.c_str(), &handle_, flags, nullptr);
  if (status != SQLITE_OK) {
    const std::string why = sqlite3_errstr(status);
    sqlite3_close(handle_);
    handle_ = nullptr;
    throw Error(Cause::CannotOpen, "cannot open " + path_ + ": " + why);
  }
  constexpr int kPatienceMilliseconds = 20000;
  sqlite3_busy_timeout(handle_, kPatienceMilliseconds);
}

void Database::open_to_read(const std::string& path) {
  std::error_code none;
  const auto log = fs::file_size(path + "-wal", none);
  if (none || log == 0) {
    // All of it is in the file. Locks, which would be two more files beside it, are left out.
    unlocked_ = stamp_of(path);
    open("file:" + uri_path(path) + "?immutable=1", SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
    return;
  }
  // A sweep is at work, or was killed: what it wrote last stands in the log.
  open(path, SQLITE_OPEN_READONLY);
  if (sqlite3_exec(handle_, "SELECT count(*) FROM sqlite_master", nullptr, nullptr, nullptr) == SQLITE_OK) return;
  const int status = sqlite3_errcode(handle_) & 0xff;
  if (status == SQLITE_CANTOPEN || status == SQLITE_READONLY || status == SQLITE_IOERR || status == SQLITE_PERM)
    open_copy(path);
}

void Database::open_copy(const std::string& path) {
  sqlite3_close(handle_);
  handle_ = nullptr;
  std::string folder = (fs::temp_directory_path() / "gsp-store-XXXXXX").string();
  if (!::mkdtemp(folder.data())) throw Error(Cause::CannotOpen, "cannot make " + folder + " to read " + path + " in");
  copy_ = folder;
  std::error_code failed;
  for (const char* part : {"", "-wal"})
    if (!failed) fs::copy_file(path + part, copy_ + "/results.sqlite" + part, failed);
  // A copy has the permissions of what it is of, and a log is read by writing.
  for (const char* part : {"", "-wal"})
    if (!failed)
      fs::permissions(copy_ + "/results.sqlite" + part, fs::perms::owner_write, fs::perm_options::add, failed);
  if (failed) throw Error(Cause::CannotOpen, "cannot copy " + path + " to " + copy_ + ": " + failed.message());
  open(copy_ + "/results.sqlite", SQLITE_OPEN_READWRITE);
}

Database::Stamp Database::stamp_of(const std::string& path) {
  std::error_code failed;
  Stamp stamp;
  stamp.time = fs::last_write_time(path, failed);
  stamp.size = fs::file_size(path, failed);
  return stamp;
}

bool Database::stale() const { return unlocked_ && !(stamp_of(path_) == *unlocked_); }

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

// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/transfer_log.h"

#include <cstdlib>
#include <sstream>

#include <sqlite3.h>

#include "core/archive/reasons.h"
#include "core/files/user_folders.h"
#include "core/platform/process.h"
#include "core/task/error.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;

constexpr int busyMs = 10000; // another program writes

[[noreturn]] void fail(sqlite3 *database, const fs::path &file) {
    throw task::Error(task::ErrorCode::output,
                      because::transferLogFails(std::string(sqlite3_errmsg(database))), file);
}

// One statement, from its parameters to its rows.
class Statement {
public:
    Statement(sqlite3 *database, const fs::path &file, const char *sql)
        : m_database(database), m_file(file) {
        if (sqlite3_prepare_v2(database, sql, -1, &m_statement, nullptr) != SQLITE_OK)
            fail(database, file);
    }
    ~Statement() { sqlite3_finalize(m_statement); }
    Statement(const Statement &) = delete;
    Statement &operator=(const Statement &) = delete;

    Statement &bind(const std::string &text) {
        sqlite3_bind_text(m_statement, ++m_bound, text.data(), int(text.size()), SQLITE_TRANSIENT);
        return *this;
    }
    Statement &bind(std::int64_t number) {
        sqlite3_bind_int64(m_statement, ++m_bound, number);
        return *this;
    }
    Statement &bind(double number) {
        sqlite3_bind_double(m_statement, ++m_bound, number);
        return *this;
    }
    bool next() {
        const int result = sqlite3_step(m_statement);
        if (result != SQLITE_ROW && result != SQLITE_DONE)
            fail(m_database, m_file);
        return result == SQLITE_ROW;
    }
    void run() {
        while (next()) {
        }
    }
    std::string text(int column) const {
        const auto *const value = sqlite3_column_text(m_statement, column);
        return value == nullptr ? "" : reinterpret_cast<const char *>(value);
    }
    std::int64_t number(int column) const { return sqlite3_column_int64(m_statement, column); }
    double real(int column) const { return sqlite3_column_double(m_statement, column); }

private:
    sqlite3 *m_database;
    const fs::path &m_file;
    sqlite3_stmt *m_statement = nullptr;
    int m_bound = 0;
};

std::string joined(const std::vector<std::string> &uids) {
    std::string text;
    for (const std::string &uid : uids)
        text += (text.empty() ? "" : " ") + uid;
    return text;
}

std::vector<std::string> split(const std::string &text) {
    std::istringstream each(text);
    std::vector<std::string> uids;
    for (std::string uid; each >> uid;)
        uids.push_back(uid);
    return uids;
}

bool isRunning(const std::string &process) {
    return !process.empty() &&
           platform::processIdentity(std::strtol(process.c_str(), nullptr, 10)) == process;
}

constexpr const char *columns = "id, server, study, series, title, folder, state, total, received, "
                                "bytes, seconds, reason, created, later, process";

Transfer transferOf(const Statement &row) {
    Transfer transfer;
    transfer.id = row.number(0);
    transfer.server = row.text(1);
    transfer.wanted = {row.text(2), split(row.text(3))};
    transfer.title = row.text(4);
    transfer.folder = row.text(5);
    transfer.state = TransferState(row.number(6));
    transfer.total = std::size_t(row.number(7));
    transfer.received = std::size_t(row.number(8));
    transfer.bytes = std::uint64_t(row.number(9));
    transfer.seconds = row.real(10);
    transfer.reason = row.text(11);
    transfer.created = row.text(12);
    transfer.isForLater = row.number(13) != 0;
    if (transfer.state == TransferState::running && !isRunning(row.text(14)))
        transfer.state = TransferState::waiting;
    return transfer;
}

} // namespace

void TransferLog::Close::operator()(sqlite3 *database) const {
    sqlite3_close(database);
}

fs::path TransferLog::fileOfUser() {
    const auto data = files::userDataFolder();
    if (!data)
        throw task::Error(task::ErrorCode::output, because::noFolderForData);
    return *data / "transfers.sqlite";
}

TransferLog::TransferLog(const fs::path &file) : m_file(file) {
    sqlite3 *database = nullptr;
    const int opened = sqlite3_open_v2(file.string().c_str(), &database,
                                       SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
    m_database.reset(database);
    if (opened != SQLITE_OK)
        fail(database, m_file);
    sqlite3_busy_timeout(database, busyMs);
    for (const char *const sql :
         {"PRAGMA journal_mode = WAL", "PRAGMA synchronous = FULL",
          "CREATE TABLE IF NOT EXISTS transfers (id INTEGER PRIMARY KEY, server TEXT, study TEXT, "
          "series TEXT, title TEXT, folder TEXT, state INTEGER, total INTEGER DEFAULT 0, received "
          "INTEGER DEFAULT 0, bytes INTEGER DEFAULT 0, seconds REAL DEFAULT 0, reason TEXT DEFAULT "
          "'', created TEXT DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now')), process TEXT "
          "DEFAULT '', run INTEGER DEFAULT 0, later INTEGER DEFAULT 0, UNIQUE (server, study, "
          "series, "
          "folder))",
          "CREATE TABLE IF NOT EXISTS arrivals (path TEXT PRIMARY KEY, study TEXT, series TEXT, "
          "instance TEXT, class TEXT, bytes INTEGER, sender TEXT)"})
        Statement(database, m_file, sql).run();
}

TransferLog::~TransferLog() = default;

std::int64_t TransferLog::add(const Transfer &transfer) {
    Statement insert(m_database.get(), m_file,
                     "INSERT INTO transfers (server, study, series, title, folder, later, state) "
                     "VALUES (?, ?, ?, ?, ?, ?, 0) ON CONFLICT (server, study, series, folder) DO "
                     "UPDATE SET later = CASE WHEN state <= 1 THEN MIN(later, excluded.later) ELSE "
                     "excluded.later END, state = CASE WHEN state = 1 THEN 1 ELSE 0 END, title = "
                     "excluded.title RETURNING id");
    insert.bind(transfer.server)
        .bind(transfer.wanted.studyUid)
        .bind(joined(transfer.wanted.seriesUids))
        .bind(transfer.title)
        .bind(transfer.folder.string())
        .bind(std::int64_t(transfer.isForLater));
    std::int64_t id = 0;
    while (insert.next())
        id = insert.number(0);
    return id;
}

std::vector<Transfer> TransferLog::transfers() const {
    Statement select(m_database.get(), m_file,
                     (std::string("SELECT ") + columns + " FROM transfers ORDER BY id").c_str());
    std::vector<Transfer> transfers;
    while (select.next())
        transfers.push_back(transferOf(select));
    return transfers;
}

std::optional<Transfer> TransferLog::transfer(std::int64_t id) const {
    Statement select(m_database.get(), m_file,
                     (std::string("SELECT ") + columns + " FROM transfers WHERE id = ?").c_str());
    select.bind(id);
    if (!select.next())
        return std::nullopt;
    return transferOf(select);
}

bool TransferLog::claim(std::int64_t id) {
    Statement(m_database.get(), m_file, "BEGIN IMMEDIATE").run();
    std::int64_t state = -1;
    Run run;
    std::string process;
    {
        Statement select(m_database.get(), m_file,
                         "SELECT state, process, run, bytes, seconds FROM transfers WHERE id = ?");
        select.bind(id);
        if (select.next()) {
            state = select.number(0);
            process = select.text(1);
            run = {select.number(2) + 1, std::uint64_t(select.number(3)), select.real(4)};
        }
    }
    const std::string own = platform::processIdentity(platform::ownProcess());
    const bool isFree = state >= 0 && (TransferState(state) != TransferState::running ||
                                       process == own || !isRunning(process));
    if (isFree) {
        m_runs[id] = run;
        Statement update(m_database.get(), m_file,
                         "UPDATE transfers SET state = 1, process = ?, run = ?, reason = '' WHERE "
                         "id = ?");
        update.bind(own).bind(run.number).bind(id);
        update.run();
    }
    Statement(m_database.get(), m_file, "COMMIT").run();
    return isFree;
}

bool TransferLog::hasClaim(std::int64_t id) const {
    Statement select(m_database.get(), m_file, "SELECT state, run FROM transfers WHERE id = ?");
    select.bind(id);
    const auto run = m_runs.find(id);
    return select.next() && TransferState(select.number(0)) == TransferState::running &&
           run != m_runs.end() && select.number(1) == run->second.number;
}

void TransferLog::update(std::int64_t id, const RetrievalState &state, double seconds) {
    const Run &run = m_runs[id];
    Statement update(m_database.get(), m_file,
                     "UPDATE transfers SET total = ?, received = ?, bytes = ?, seconds = ? "
                     "WHERE id = ? AND run = ?");
    update.bind(std::int64_t(state.wanted))
        .bind(std::int64_t(state.present + state.received))
        .bind(std::int64_t(run.bytesBefore + state.bytes))
        .bind(run.secondsBefore + (state.bytes > 0 ? seconds : 0.0))
        .bind(id)
        .bind(run.number);
    update.run();
}

void TransferLog::finish(std::int64_t id, TransferState state, const RetrievalState &reached,
                         double seconds, const std::string &reason) {
    if (reached.wanted > 0)
        update(id, reached, seconds);
    Statement finish(m_database.get(), m_file,
                     "UPDATE transfers SET state = ?, reason = ?, process = '' WHERE id = ? "
                     "AND run = ?");
    finish.bind(std::int64_t(state)).bind(reason).bind(id).bind(m_runs[id].number);
    finish.run();
}

void TransferLog::remove(std::int64_t id) {
    Statement remove(m_database.get(), m_file, "DELETE FROM transfers WHERE id = ? AND run = ?");
    remove.bind(id).bind(m_runs[id].number);
    remove.run();
}

void TransferLog::cancel(std::int64_t id) {
    Statement update(m_database.get(), m_file, "UPDATE transfers SET state = ? WHERE id = ?");
    update.bind(std::int64_t(TransferState::cancelled)).bind(id);
    update.run();
}

void TransferLog::retry(std::int64_t id) {
    Statement update(m_database.get(), m_file,
                     "UPDATE transfers SET state = ?, later = 0 WHERE id = ?");
    update.bind(std::int64_t(TransferState::waiting)).bind(id);
    update.run();
}

void TransferLog::clearFinished() {
    Statement(m_database.get(), m_file, "DELETE FROM transfers WHERE state > 1").run();
}

void TransferLog::addArrival(const StoredObject &object, const std::string &sender) {
    Statement insert(m_database.get(), m_file,
                     "INSERT OR REPLACE INTO arrivals VALUES (?, ?, ?, ?, ?, ?, ?)");
    insert.bind(object.path.string())
        .bind(object.studyUid)
        .bind(object.seriesUid)
        .bind(object.sopInstanceUid)
        .bind(object.sopClassUid)
        .bind(std::int64_t(object.bytes))
        .bind(sender);
    insert.run();
}

std::vector<StoredObject> TransferLog::arrivals() const {
    Statement select(m_database.get(), m_file,
                     "SELECT path, study, series, instance, class, bytes FROM arrivals");
    std::vector<StoredObject> objects;
    while (select.next())
        objects.push_back({select.text(0), select.text(1), select.text(2), select.text(3),
                           select.text(4), std::uint64_t(select.number(5))});
    return objects;
}

void TransferLog::removeArrivals(const std::vector<StoredObject> &objects) {
    Statement(m_database.get(), m_file, "BEGIN IMMEDIATE").run();
    for (const StoredObject &object : objects) {
        Statement remove(m_database.get(), m_file, "DELETE FROM arrivals WHERE path = ?");
        remove.bind(object.path.string());
        remove.run();
    }
    Statement(m_database.get(), m_file, "COMMIT").run();
}

} // namespace pellucid::archive

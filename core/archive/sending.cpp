// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/sending.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/archive/login.h"
#include "core/archive/reasons.h"
#include "core/decoding/client/decoder.h"
#include "core/decoding/client/reasons.h"
#include "core/dicom/file_list.h"
#include "core/dicom/reasons.h"
#include "core/files/atomic_file.h"
#include "core/files/open_regular.h"
#include "core/files/reasons.h"
#include "core/files/session_folder.h"
#include "core/network/client/link.h"
#include "core/network/client/reasons.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using network::Encoding;
using task::Error;
using task::ErrorCode;
using Clock = std::chrono::steady_clock;

// An association has room for 128 presentation contexts.
constexpr std::size_t encodingsAtOnce = 120;
constexpr int maxFailures = 3;

// The meta header of a DICOMDIR (PS3.4, I.4).
constexpr std::uint32_t mediaSopClass = 0x00020002;
constexpr const char *directoryClass = "1.2.840.10008.1.3.10";

struct Outgoing {
    fs::path path;
    Encoding encoding;
};

bool isPlain(const Encoding &encoding) {
    return encoding.transferSyntax == decoding::explicitLittleEndian ||
           encoding.transferSyntax == decoding::implicitLittleEndian;
}

// Finds out what kind each file is: the association has to be negotiated for these kinds. `named`:
// the files that the user has named, which are not left out silently.
std::vector<Outgoing> describe(const std::vector<fs::path> &files, const std::set<fs::path> &named,
                               SendingReport &report, const task::Progress &progress) {
    std::vector<Outgoing> outgoing;
    for (const fs::path &path : files) {
        progress.check();
        try {
            const auto list = decoding::Decoder::shared().attributes(path, progress);
            Encoding encoding;
            bool isDirectory = false;
            for (const decoding::Attribute &attribute : list.attributes) {
                if (attribute.depth != 0)
                    continue;
                if (attribute.tag == 0x00020010)
                    encoding.transferSyntax = attribute.value.substr(0, attribute.value.find(' '));
                isDirectory = isDirectory || (attribute.tag == mediaSopClass &&
                                              attribute.value.starts_with(directoryClass));
                if (attribute.tag == network::tag::sopClassUid)
                    encoding.sopClassUid = attribute.value.substr(0, attribute.value.find(' '));
            }
            if (isDirectory) { // of a folder whose files are sent
                report.leftOut.push_back({path, because::hasNoValidUids});
                continue;
            }
            if (!list.isComplete && list.attributes.size() < decoding::maxAttributes)
                throw Error(ErrorCode::unusable, because::isTruncated, path);
            if (!network::isUid(encoding.sopClassUid) || !network::isUid(encoding.transferSyntax))
                throw Error(ErrorCode::unusable, because::hasNoValidUids, path);
            outgoing.push_back({path, encoding});
        } catch (const Error &error) {
            const bool isOther =
                error.reason().is(because::isNotDicom) && !named.contains(dicom::resolved(path));
            (isOther ? report.leftOut : report.notSent).push_back({path, error.reason()});
        }
    }
    return outgoing;
}

class Sender {
public:
    Sender(const Server &server, const std::function<void(const SendingState &)> &changed,
           const task::Progress &progress, SendingReport &report)
        : m_server(server), m_changed(changed), m_progress(progress), m_report(report) {}

    // Files of few enough encodings for one association.
    void send(const std::vector<Outgoing> &files, const std::vector<Encoding> &encodings) {
        std::optional<network::Link> link;
        std::string token, refusedToken;
        bool mayRenew = true;
        int failures = 0, filesLost = 0; // in a row
        for (std::size_t n = 0; n < files.size();) {
            bool isConnected = false;
            try {
                if (!link) {
                    const network::Peer peer = authenticated(m_server, m_progress, refusedToken);
                    token = peer.secret;
                    link.emplace(
                        network::Connection{peer, network::Purpose::store, {}, {}, encodings},
                        m_progress);
                }
                isConnected = true;
                store(*link, files[n]);
                failures = filesLost = 0;
                mayRenew = true;
                ++n;
            } catch (const Error &error) {
                if (isTokenRefused(m_server, error) && std::exchange(mayRenew, false)) {
                    link.reset();
                    refusedToken = token;
                    continue; // the same file again
                }
                const bool hasExpired = error.reason().is(because::loginHasExpired);
                if (error.code() == ErrorCode::unreachable || hasExpired) {
                    link.reset();
                    if (!hasExpired && ++failures < maxFailures)
                        continue; // the same file again
                    // A server that hangs up on a file may take the next.
                    if (isConnected && ++filesLost < maxFailures) {
                        m_report.notSent.push_back({files[n++].path, error.reason()});
                        failures = 0;
                        continue;
                    }
                    if (m_report.state.sent == 0)
                        throw;
                    for (; n < files.size(); ++n)
                        m_report.notSent.push_back({files[n].path, error.reason()});
                    return;
                }
                m_report.notSent.push_back({files[n].path, error.reason()});
                ++n;
            }
        }
    }

private:
    void store(network::Link &link, const Outgoing &outgoing) {
        const fs::path &path = outgoing.path;
        const files::RegularFile file = files::openRegular(path);
        try {
            storeFile(link, path, file.handle, file.facts.bytes);
        } catch (const Error &error) {
            if (!error.reason().is(because::serverDoesNotTakeTheEncoding))
                throw;
            // From explicit to implicit VR and back, nothing is lost.
            if (m_server.mayUncompress || isPlain(outgoing.encoding))
                storeUncompressed(link, outgoing);
            else
                throw Error(error.code(), because::mayBeUncompressed(error.reason()), error.path());
        }
    }
    // In the encoding that every DICOM server has to accept, if not in the better one.
    void storeUncompressed(network::Link &link, const Outgoing &outgoing) {
        const fs::path &path = outgoing.path;
        for (const bool isExplicit : {true, false}) {
            const auto plain =
                decoding::Decoder::shared().uncompressed(path, isExplicit, m_progress);
            // Without a name, and gone when it is sent.
            files::AtomicFile file(m_folder.path() / "uncompressed.dcm");
            file.write(plain.bytes);
            try {
                storeFile(link, path, file.view(), plain.bytes.size());
                m_report.uncompressed += isPlain(outgoing.encoding) ? 0 : 1;
                return;
            } catch (const Error &error) {
                if (!isExplicit || !error.reason().is(because::serverDoesNotTakeTheEncoding))
                    throw;
            }
        }
    }
    // `path`: of the file that the user sends.
    void storeFile(network::Link &link, const fs::path &path, platform::HandleView file,
                   std::uint64_t bytes) {
        if (const auto change = link.store(file, bytes, m_progress))
            m_report.withChanges.push_back({path, *change});
        ++m_report.state.sent;
        m_report.state.bytes += bytes;
        m_progress.report(double(m_report.state.sent) / double(m_report.state.files));
        if (m_changed)
            m_changed(m_report.state);
    }

    const Server &m_server;
    const std::function<void(const SendingState &)> &m_changed;
    const task::Progress &m_progress;
    SendingReport &m_report;
    files::SessionFolder m_folder; ///< for what is uncompressed
};

} // namespace

SendingReport send(const Server &server, const std::vector<fs::path> &paths,
                   const std::function<void(const SendingState &)> &changed,
                   const task::Progress &progress) {
    const auto begin = Clock::now();
    SendingReport report;
    dicom::FileList files(progress); // holds what is unpacked until it is sent
    std::set<fs::path> named;
    for (const fs::path &path : paths) {
        files.add(path);
        named.insert(dicom::resolved(path));
    }
    report.notSent = files.skipped; // could not be read
    const std::vector<Outgoing> outgoing = describe(files.found, named, report, progress);
    if (outgoing.empty() && report.notSent.empty())
        throw Error(ErrorCode::unusable, because::holdsNoUsableImages,
                    paths.empty() ? fs::path() : paths.front());
    report.state.files = outgoing.size() + report.notSent.size();
    Sender sender(server, changed, progress, report);
    for (std::size_t first = 0; first < outgoing.size();) {
        std::set<Encoding> encodings;
        std::size_t last = first;
        for (; last < outgoing.size(); ++last) {
            std::set<Encoding> more = encodings;
            more.insert(outgoing[last].encoding);
            // Also uncompressed: a server that refuses that, too, refuses the kind of object. The
            // results for compressed ones do not tell: some blame the kind for the encoding.
            for (const char *const plain :
                 {decoding::explicitLittleEndian, decoding::implicitLittleEndian})
                more.insert({outgoing[last].encoding.sopClassUid, plain});
            if (more.size() > encodingsAtOnce)
                break;
            encodings = std::move(more);
        }
        sender.send(
            {outgoing.begin() + std::ptrdiff_t(first), outgoing.begin() + std::ptrdiff_t(last)},
            {encodings.begin(), encodings.end()});
        first = last;
    }
    report.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    return report;
}

} // namespace pellucid::archive

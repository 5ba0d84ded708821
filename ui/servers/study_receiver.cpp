// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/servers/study_receiver.h"

#include <algorithm>

#include <QSettings>

#include "core/archive/reasons.h"
#include "core/archive/receiving.h"
#include "core/archive/run_transfer.h"
#include "core/archive/transfer_log.h"
#include "core/files/user_folders.h"
#include "core/network/client/reasons.h"
#include "core/system/log.h"
#include "core/task/error.h"
#include "ui/servers/reasons.h"
#include "ui/servers/server_book.h"

namespace pellucid::ui {

namespace {

namespace because = task::because;

// A sender may keep a connection for hours. What it has brought is listed meanwhile, but rarely:
// listing reads the whole study.
constexpr int listingMs = 20000;

} // namespace

ReceiverSettings ReceiverSettings::load() {
    const QSettings settings;
    const ReceiverSettings defaults;
    ReceiverSettings r;
    r.isOn = settings.value("receiver/on", defaults.isOn).toBool();
    r.address = settings.value("receiver/address").toString();
    r.port = std::clamp(settings.value("receiver/port", defaults.port).toInt(), 1, 65535);
    r.ae = settings.value("receiver/ae", defaults.ae).toString();
    r.usesTls = settings.value("receiver/tls", defaults.usesTls).toBool();
    r.certificate = settings.value("receiver/certificate").toString();
    r.key = settings.value("receiver/key").toString();
    r.authorities = settings.value("receiver/authorities").toString();
    return r;
}

void ReceiverSettings::save() const {
    QSettings settings;
    settings.setValue("receiver/on", isOn);
    settings.setValue("receiver/address", address);
    settings.setValue("receiver/port", port);
    settings.setValue("receiver/ae", ae);
    settings.setValue("receiver/tls", usesTls);
    settings.setValue("receiver/certificate", certificate);
    settings.setValue("receiver/key", key);
    settings.setValue("receiver/authorities", authorities);
}

// What a listener needs, for as long as it runs.
struct StudyReceiver::Running {
    archive::ListenerOptions options;
    archive::ObjectFolder folder;
    archive::TransferLog log;
    archive::Receiving receiving;
    archive::Listener listener; // last: its threads use the others

    Running(const archive::ListenerOptions &given, archive::ReceivingObserver observer,
            archive::ListenerObserver connections)
        : options(given),
          folder(archive::libraryObjectFolder(), archive::ObjectFolder::Durability::synced),
          log(archive::TransferLog::fileOfUser()), receiving(folder, &log, std::move(observer)),
          listener(
              given, [this] { return receiving.receiver(); }, std::move(connections)) {}
};

StudyReceiver::StudyReceiver(ServerBook &book, QObject *parent)
    : QObject(parent), m_book(book), m_settings(ReceiverSettings::load()) {
    m_listing.setSingleShot(true);
    m_listing.setInterval(listingMs);
    connect(&m_listing, &QTimer::timeout, this, &StudyReceiver::arrived);
    // The servers that may send.
    connect(&book, &ServerBook::changed, this, &StudyReceiver::restart);
    // After others have connected to the signals.
    QMetaObject::invokeMethod(this, &StudyReceiver::restart, Qt::QueuedConnection);
}

StudyReceiver::~StudyReceiver() = default;

void StudyReceiver::setSettings(const ReceiverSettings &settings) {
    if (settings == m_settings && !m_failure) // else it is tried again
        return;
    m_settings = settings;
    m_settings.save();
    restart();
}

archive::ListenerOptions StudyReceiver::options() const {
    archive::ListenerOptions options;
    options.address = m_settings.address.toStdString();
    options.port = m_settings.port;
    options.ae = m_settings.ae.trimmed().toStdString();
    options.usesTls = m_settings.usesTls;
    if (m_settings.usesTls) {
        options.certificate = m_settings.certificate.toStdString();
        options.key = m_settings.key.toStdString();
        options.authorities = m_settings.authorities.toStdString();
    }
    for (const archive::Server &server : m_book.servers())
        if (server.peer.protocol == network::Protocol::dicom)
            for (const std::string &host : archive::hostsOf(server))
                options.senders.push_back({server.peer.calledAe, host});
    return options;
}

void StudyReceiver::restart() {
    const archive::ListenerOptions wanted = options();
    // A connection that is in use is not ended by a change that does not concern it.
    if (m_settings.isOn && m_listener && m_listener->options == wanted)
        return;
    m_listener.reset();
    m_failure.reset();
    if (m_settings.isOn)
        start();
    emit changed();
}

void StudyReceiver::start() {
    try {
        const archive::ListenerOptions wanted = options();
        archive::requireValid(wanted);
        if (wanted.senders.empty())
            throw task::Error(task::ErrorCode::usage, because::noSenderIsKnown);
        if (wanted.usesTls && archive::isEncryptedKey(wanted.key))
            throw task::Error(task::ErrorCode::usage, because::keyOfReceiverHasAPassword);
        files::createPrivateFolders(archive::libraryObjectFolder());
        const auto tell = [this](const task::Reason &reason, const std::string &what) {
            QMetaObject::invokeMethod(
                this,
                [this, reason, path = QString::fromStdString(what)] {
                    emit this->failed(reason, path);
                },
                Qt::QueuedConnection);
        };
        m_listener = std::make_unique<Running>(
            wanted,
            archive::ReceivingObserver{[this](const archive::StoredObject &) { countArrival(); },
                                       [tell](const archive::RefusedObject &object) {
                                           tell(object.reason, object.sopInstanceUid);
                                       }},
            archive::ListenerObserver{[this, tell](const archive::ConnectionEnd &end) {
                // Whoever scans the network does not fill the list of problems.
                if (end.reason && !end.reason->is(because::wasCancelled) &&
                    m_refused.isNew(end.address, *end.reason))
                    tell(*end.reason, end.sender);
                if (end.refused && m_refused.isNew(end.address, *end.refused))
                    tell(*end.refused, end.sender);
                if (const auto summary = m_refused.summary())
                    system::log(summary->english());
                QMetaObject::invokeMethod(
                    this,
                    [this] {
                        if (m_listing.isActive()) {
                            m_listing.stop();
                            emit arrived();
                        }
                    },
                    Qt::QueuedConnection);
            }});
    } catch (const task::Error &error) {
        m_failure = error.reason();
    }
}

// Called by the threads of connections.
void StudyReceiver::countArrival() {
    ++m_count;
    QMetaObject::invokeMethod(
        this,
        [this] {
            if (!m_listing.isActive())
                m_listing.start();
            emit changed();
        },
        Qt::QueuedConnection);
}

archive::MoveDestination StudyReceiver::destinationFor(const archive::Server &server) const {
    archive::MoveDestination destination;
    // A request over TLS accepts its objects over TLS only.
    const bool isAlike = m_settings.usesTls == server.peer.usesTls;
    if (isListening() && isAlike) {
        destination.ae = m_listener->options.ae;
        destination.port = m_settings.port;
        destination.hasListener = true;
    }
    destination.isTakenByOtherTls =
        isListening() && !isAlike && m_settings.port == destination.port;
    return destination;
}

} // namespace pellucid::ui

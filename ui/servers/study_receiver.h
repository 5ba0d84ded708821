// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <memory>
#include <optional>

#include <QObject>
#include <QTimer>

#include "core/archive/listener.h"
#include "core/archive/refused_connections.h"
#include "core/archive/retrieval.h"
#include "core/task/reason.h"

namespace pellucid::ui {

class ServerBook;

/// How this program receives what servers send, stored in the user's settings. Off at first.
struct ReceiverSettings {
    bool isOn = false;
    QString address; ///< of this computer, IPv4 or IPv6; empty: all
    int port = archive::defaultListenerPort;
    QString ae = "PELLUCID"; ///< AE title of this program
    bool usesTls = false;
    QString certificate, key, authorities; ///< files in PEM format

    bool operator==(const ReceiverSettings &) const = default;

    static ReceiverSettings load();
    void save() const;
};

/// Receives what the known DICOM servers send, and stores it in the folder of the library. It runs
/// as long as the program, if the settings say so.
class StudyReceiver : public QObject {
    Q_OBJECT
public:
    explicit StudyReceiver(ServerBook &book, QObject *parent = nullptr);
    ~StudyReceiver() override;

    const ReceiverSettings &settings() const { return m_settings; }
    /// Saves the settings, and starts or stops accordingly.
    void setSettings(const ReceiverSettings &settings);
    bool isListening() const { return m_listener != nullptr; }
    /// Why it does not listen although it should.
    const std::optional<task::Reason> &failure() const { return m_failure; }
    /// The objects that have arrived in this run of the program.
    qint64 receivedCount() const { return m_count; }
    /// Where a server sends objects for C-MOVE: here, if this receiver gets them in the way that
    /// the server is asked to send them.
    archive::MoveDestination destinationFor(const archive::Server &server) const;

signals:
    /// It listens, or no longer does, or objects have arrived.
    void changed();
    /// Objects are in the log of arrivals, and can be listed in the library.
    void arrived();
    /// A sender was turned away, or an object could not be stored.
    void failed(const pellucid::task::Reason &what, const QString &path);

private:
    struct Running;
    void restart();
    archive::ListenerOptions options() const;
    void start();
    void countArrival();

    ServerBook &m_book;
    ReceiverSettings m_settings;
    std::optional<task::Reason> m_failure;
    std::atomic<qint64> m_count = 0;
    archive::RefusedConnections m_refused;
    QTimer m_listing;                    ///< runs from an arrival until it is listed
    std::unique_ptr<Running> m_listener; ///< last: its threads use the others
};

} // namespace pellucid::ui

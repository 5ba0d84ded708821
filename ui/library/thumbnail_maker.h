// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include <QImage>
#include <QObject>

namespace pellucid::ui {

/// Makes thumbnails one after the other on a thread of its own. The latest request comes first: its
/// row is most likely the visible one.
class ThumbnailMaker : public QObject {
    Q_OBJECT
public:
    /// *Throws* std::system_error if no thread is available.
    explicit ThumbnailMaker(QObject *parent = nullptr);
    /// Drops the requests that have not begun and waits for the one that has.
    ~ThumbnailMaker() override;

    /// `make` runs on the maker's thread. A thumbnail that cannot be made is null.
    void ask(const QString &key, std::function<QImage()> make);

signals:
    void made(const QString &key, const QImage &thumbnail);

private:
    struct Request {
        QString key;
        std::function<QImage()> make;
    };
    void work(const std::stop_token &stop);

    std::mutex m_guard;
    std::condition_variable_any m_asked;
    std::deque<Request> m_requests;
    // Not a QThreadPool: if the system has no thread left, it drops the request without an error
    // and its destructor waits forever.
    std::jthread m_thread; ///< last: it uses the other members
};

} // namespace pellucid::ui

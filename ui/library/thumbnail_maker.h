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

/// Makes thumbnails one after the other on a thread of its own, what was asked for last first: that
/// is what is looked at.
class ThumbnailMaker : public QObject {
    Q_OBJECT
public:
    explicit ThumbnailMaker(QObject *parent = nullptr);
    ~ThumbnailMaker() override;

    void ask(const QString &key, std::function<QImage()> make);

signals:
    /// Null where there is none.
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
    std::jthread m_thread; ///< last: it uses the others
};

} // namespace pellucid::ui

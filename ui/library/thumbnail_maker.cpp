// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/thumbnail_maker.h"

namespace pellucid::ui {

ThumbnailMaker::ThumbnailMaker(QObject *parent)
    : QObject(parent), m_thread([this](const std::stop_token &stop) { work(stop); }) {}

ThumbnailMaker::~ThumbnailMaker() {
    m_thread.request_stop();
    m_thread.join();
}

void ThumbnailMaker::ask(const QString &key, std::function<QImage()> make) {
    {
        const std::lock_guard lock(m_guard);
        m_requests.push_back({key, std::move(make)});
    }
    m_asked.notify_one();
}

void ThumbnailMaker::work(const std::stop_token &stop) {
    for (;;) {
        Request request;
        {
            std::unique_lock lock(m_guard);
            if (!m_asked.wait(lock, stop, [this] { return !m_requests.empty(); }))
                return;
            request = std::move(m_requests.back());
            m_requests.pop_back();
        }
        QImage thumbnail;
        try {
            thumbnail = request.make();
        } catch (...) {
            // The thumbnail stays null. Opening the study reports the reason.
        }
        // Queued: the object lives on the user interface's thread.
        emit made(request.key, thumbnail);
    }
}

} // namespace pellucid::ui

// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/engine/shared_context.h"

#include <QCoreApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QThread>

#include "core/system/log.h"
#include "core/task/error.h"
#include "gpu/capabilities.h"
#include "gpu/reasons.h"
#include "ui/engine/reasons.h"

namespace pellucid::ui {

namespace {

namespace because = task::because;

[[noreturn]] void refuse(const task::Reason &why) {
    throw task::Error(task::ErrorCode::noSuchDevice, why);
}

// Any thread may release the device last.
template <class Object> void remove(std::unique_ptr<Object> object) {
    if (object->thread() == QThread::currentThread())
        object.reset();
    else
        object.release()->deleteLater();
}

} // namespace

SharedContext::SharedContext()
    : m_surface(std::make_unique<QOffscreenSurface>()),
      m_context(std::make_unique<QOpenGLContext>()) {
    if (QOpenGLContext::globalShareContext() == nullptr)
        refuse(because::noOpenGl);
    QSurfaceFormat format = QSurfaceFormat::defaultFormat();
    format.setVersion(4, 3);
    m_surface->setFormat(format);
    m_surface->create();
    m_context->setFormat(format);
    m_context->setShareContext(QOpenGLContext::globalShareContext());
    if (!m_surface->isValid() || !m_context->create())
        refuse(because::noSecondContext);
    if (!QOpenGLContext::areSharing(m_context.get(), QOpenGLContext::globalShareContext()))
        refuse(because::contextsDoNotShare);
    if (!m_context->format().testOption(QSurfaceFormat::ResetNotification))
        system::log("OpenGL does not report resets of the driver");
    // A context without a thread can be taken by the thread that needs it.
    m_context->moveToThread(nullptr);
}

SharedContext::~SharedContext() {
    remove(std::move(m_surface));
    remove(std::move(m_context));
}

void SharedContext::makeCurrent() {
    if (m_context->thread() == nullptr)
        m_context->moveToThread(QThread::currentThread());
    if (!m_context->makeCurrent(m_surface.get()))
        refuse(because::contextUnusable);
    gpu::contextHasChanged();
}

void SharedContext::doneCurrent() {
    m_context->doneCurrent();
    if (QCoreApplication *application = QCoreApplication::instance())
        m_context->moveToThread(application->thread());
}

} // namespace pellucid::ui

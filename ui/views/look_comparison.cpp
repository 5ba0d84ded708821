// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/look_comparison.h"

#include <utility>

#include <QPainter>

#include "ui/document/document.h"

namespace pellucid::ui {

LookComparison::LookComparison(Document &document, QObject *parent)
    : QObject(parent), m_document(document), m_scene(document.scene()) {
    // The merged edits of a drag have one index.
    connect(document.undoStack(), &QUndoStack::indexChanged, this, &LookComparison::edited);
}

void LookComparison::forget() {
    m_now.reset();
    m_before.reset();
    m_scene = m_document.scene();
    m_index = m_document.undoStack()->index();
}

void LookComparison::edited(int index) {
    const scene::Scene &scene = m_document.scene();
    const bool isLook = scene.look != m_scene.look || scene.shading != m_scene.shading ||
                        scene.crop != m_scene.crop || scene.tone != m_scene.tone ||
                        scene.image != m_scene.image || scene.fieldWindow != m_scene.fieldWindow;
    m_scene = scene;
    if (std::exchange(m_index, index) == index || !isLook) // an edit of measurements, for example
        return;
    if (m_now)
        m_before = m_now;
    m_now.reset(); // until the new look has a final picture
}

QImage besideEachOther(const QImage &before, const QImage &now) {
    QImage both(now.size(), QImage::Format_RGB32);
    both.fill(Qt::black);
    QPainter painter(&both);
    const int half = now.width() / 2, quarter = now.width() / 4;
    painter.drawImage(0, 0, before.copy(quarter, 0, half, before.height()));
    painter.drawImage(half, 0, now.copy(quarter, 0, now.width() - half, now.height()));
    return both;
}

} // namespace pellucid::ui

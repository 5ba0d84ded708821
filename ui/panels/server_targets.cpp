// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/server_targets.h"

#include <QDragEnterEvent>
#include <QMimeData>

#include "ui/language/shown_text.h"
#include "ui/settings/file_dialogs.h"

namespace pellucid::ui {

namespace {

constexpr int nameRole = Qt::UserRole;

} // namespace

ServerTargets::ServerTargets(QWidget *parent) : QListWidget(parent) {
    setObjectName("serverTargets");
    setAccessibleName(tr("Servers to send to"));
    setProperty("role", "plain");
    setSelectionMode(QAbstractItemView::SingleSelection);
    setAcceptDrops(true);
    setSizeAdjustPolicy(QAbstractScrollArea::AdjustToContents);
}

void ServerTargets::list(const QStringList &servers) {
    clear();
    for (const QString &server : servers) {
        auto *const item = new QListWidgetItem(shownText(server), this);
        item->setData(nameRole, server);
        item->setToolTip(
            plainToolTip(tr("Drop studies or files here to send them to %1").arg(server)));
    }
    // As high as its rows, up to a few.
    constexpr int mostRows = 4;
    const int row = count() > 0 ? sizeHintForRow(0) : 0;
    setMaximumHeight(std::min(count(), mostRows) * row + 2 * frameWidth() + 4);
    setVisible(count() > 0);
}

QListWidgetItem *ServerTargets::targetOf(const QDropEvent &event) const {
    return localPaths(*event.mimeData()).isEmpty() ? nullptr : itemAt(event.position().toPoint());
}

void ServerTargets::dragEnterEvent(QDragEnterEvent *event) {
    if (!localPaths(*event->mimeData()).isEmpty())
        event->accept();
}

void ServerTargets::dragMoveEvent(QDragMoveEvent *event) {
    QListWidgetItem *const target = targetOf(*event);
    setCurrentItem(target);
    // Files are copied, whatever the desktop offers: nothing is moved away.
    event->setDropAction(Qt::CopyAction);
    event->setAccepted(target != nullptr);
}

void ServerTargets::dropEvent(QDropEvent *event) {
    const QListWidgetItem *const target = targetOf(*event);
    setCurrentItem(nullptr);
    if (target == nullptr)
        return;
    event->setDropAction(Qt::CopyAction);
    event->accept();
    emit dropped(localPaths(*event->mimeData()), target->data(nameRole).toString());
}

} // namespace pellucid::ui

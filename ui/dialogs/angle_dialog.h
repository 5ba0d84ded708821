// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>

#include "core/scene/positioner_angles.h"

class QListWidget;

namespace pellucid::ui {

class AngleBox;
class Document;
class ProjectionView;

/// The angles of a C-arm that sees the projection: shown while the view turns, typed, or chosen
/// from a list of common angulations. Stays open beside the picture.
class AngleDialog : public QDialog {
    Q_OBJECT
public:
    /// Both must outlive it.
    AngleDialog(const Document &document, ProjectionView &projection, QWidget *parent);
    ~AngleDialog() override;

private:
    scene::PositionerAngles now() const;
    void showView();

    const Document &m_document;
    ProjectionView &m_projection;
    AngleBox *m_primary, *m_secondary;
    QListWidget *m_common;
};

} // namespace pellucid::ui

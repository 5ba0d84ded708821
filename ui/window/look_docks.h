// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

#include "ui/engine/look_previewer.h"
#include "ui/theme/theme.h"

class QDockWidget;
class QMainWindow;

namespace pellucid::ui {

class ClassesPanel;
class CardCopier;
class LookPreparer;
class PresetsPanel;
class ProjectionView;
class QualityPanel;
class RadiographPanel;
class ShadingPanel;
class TransferFunctionPanel;

/// The docks on the right of the window: presets, radiograph, classes, transfer
/// function, shading, quality.
/// Connects them with the objects that they control.
class LookDocks : public QObject {
    Q_OBJECT
public:
    LookDocks(QMainWindow &window, Document &document, LookPreparer &preparer, CardCopier &copier,
              ProjectionView &projection, const Theme &theme);

    const std::vector<QDockWidget *> &docks() const { return m_docks; }
    PresetsPanel &presets() { return *m_presets; }
    ClassesPanel &classes() { return *m_classes; }
    ShadingPanel &shading() { return *m_shading; }
    /// Shows a panel whose dock may be closed or collapsed.
    void unfold(QWidget &panel);

private:
    /// `corner`: a widget beside the heading; may be null.
    void dock(QMainWindow &window, const QString &title, const char *name, QWidget *panel,
              QWidget *corner, int height);

    LookPreviewer m_previewer;
    PresetsPanel *m_presets;
    RadiographPanel *m_radiograph;
    ClassesPanel *m_classes;
    TransferFunctionPanel *m_function;
    ShadingPanel *m_shading;
    QualityPanel *m_quality;
    std::vector<QDockWidget *> m_docks;
    std::vector<int> m_heights;
};

} // namespace pellucid::ui

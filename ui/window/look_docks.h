// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QObject>

#include "ui/engine/look_previewer.h"

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

/// The docks on the right of the window: presets, radiograph, classes, transfer function, shading,
/// quality. Connects them with the objects that they control. In a high window they are stacked; in
/// a low one some share a place as tabs, so that nothing is cut. Once the user has moved a dock,
/// they stay as they are.
class LookDocks : public QObject {
    Q_OBJECT
public:
    LookDocks(QMainWindow &window, Document &document, LookPreparer &preparer, CardCopier &copier,
              ProjectionView &projection);

    std::vector<QDockWidget *> docks() const;
    PresetsPanel &presets() { return *m_presets; }
    ClassesPanel &classes() { return *m_classes; }
    ShadingPanel &shading() { return *m_shading; }
    /// Shows a panel whose dock may be closed or collapsed.
    void unfold(QWidget &panel);
    /// Stacks the docks or makes tabs of them. *Units*: logical pixels.
    void fit(int windowHeight);
    /// Whether the user has moved a dock; kept with the layout.
    bool areMoved() const { return m_areMoved; }
    void setMoved(bool areMoved) { m_areMoved = areMoved; }
    /// Shows all docks where they were at first.
    void reset(int windowHeight);

private:
    enum class WhenShort { tab, row };
    struct Entry {
        QDockWidget *dock;
        int height;
        WhenShort place;
    };
    /// `corner`: a widget beside the heading; may be null. *Units*: `height`: logical pixels.
    void dock(const QString &title, const char *name, QWidget *panel, QWidget *corner, int height,
              WhenShort place);

    bool areTabs() const;
    void arrange(bool asTabs);
    void showHeadings();

    QMainWindow &m_window;
    LookPreviewer m_previewer;
    PresetsPanel *m_presets;
    RadiographPanel *m_radiograph;
    ClassesPanel *m_classes;
    TransferFunctionPanel *m_function;
    ShadingPanel *m_shading;
    QualityPanel *m_quality;
    std::vector<Entry> m_docks;
    bool m_areMoved = false, m_isArranging = false;
};

} // namespace pellucid::ui

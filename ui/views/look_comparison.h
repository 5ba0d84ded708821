// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include <QImage>
#include <QObject>

#include "core/picture/compose.h"
#include "core/render/projection_engine.h"
#include "core/scene/scene.h"

namespace pellucid::ui {

class Document;

/// A look that was shown, with what is needed to show it again from anywhere.
struct ShownLook {
    std::shared_ptr<render::ProjectionEngine> engine;
    scene::ImageDefinition image;
    shading::Shading shading;
    scene::Tone tone; ///< with both ends
    QString name;
};

/// Remembers the look before the last edit, for comparing: what was on the screen, settled, when an
/// edit other than the last was made.
class LookComparison : public QObject {
    Q_OBJECT
public:
    explicit LookComparison(Document &document, QObject *parent = nullptr);

    /// A picture of what the scene asks for is on the screen.
    void settled(const ShownLook &look) { m_now = look; }
    /// Of another volume.
    void forget();
    const std::optional<ShownLook> &before() const { return m_before; }

private:
    void edited(int index);

    Document &m_document;
    scene::Scene m_scene; ///< after the last edit
    std::optional<ShownLook> m_now, m_before;
    int m_index = 0; ///< of the undo stack
};

/// Two pictures of one view beside each other: the middle of each. *Shape*: both of one size.
QImage besideEachOther(const QImage &before, const QImage &now);

} // namespace pellucid::ui

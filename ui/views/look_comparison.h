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

/// A look that was shown, and the engine that shows it again from any view.
struct ShownLook {
    std::shared_ptr<render::ProjectionEngine> engine;
    scene::ImageDefinition image;
    shading::Shading shading;
    scene::Tone tone; ///< with its exposure
    QString name;
};

/// Remembers the look before the last edit, to compare with: the last one that had a final picture
/// on the screen.
class LookComparison : public QObject {
    Q_OBJECT
public:
    explicit LookComparison(Document &document, QObject *parent = nullptr);

    /// A final picture of this look, which the scene asks for, is on the screen.
    void settled(const ShownLook &look) { m_now = look; }
    /// Forgets the looks of the former volume.
    void forget();
    const std::optional<ShownLook> &before() const { return m_before; }

private:
    void edited(int index);

    Document &m_document;
    scene::Scene m_scene; ///< after the last edit
    std::optional<ShownLook> m_now, m_before;
    int m_index = 0; ///< of the undo stack
};

/// The middle halves of two pictures of one view, side by side. *Shape*: pictures of one size.
QImage besideEachOther(const QImage &before, const QImage &now);

} // namespace pellucid::ui

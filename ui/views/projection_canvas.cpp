// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/projection_canvas.h"

#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QOpenGLWidget>
#include <QPainter>
#include <QStackedLayout>

#include "core/task/error.h"
#include "gpu/capabilities.h"
#include "gpu/tone_pass.h"
#include "ui/engine/gl_probe.h"
#include "ui/theme/theme.h"

namespace pellucid::ui {

namespace {

class GlCanvas final : public QOpenGLWidget, public ProjectionCanvas {
public:
    explicit GlCanvas(QWidget *parent) : QOpenGLWidget(parent) {
        setObjectName("projectionCanvas");
    }
    ~GlCanvas() override {
        release();
        // The base class destroys the context, whose signal would call a destroyed object.
        if (context() != nullptr)
            disconnect(context(), nullptr, this, nullptr);
    }

    QWidget *widget() override { return this; }
    void setImage(Image image) override {
        m_image = std::move(image);
        m_picture.reset();
        m_fresh = true;
        if (!m_image && m_pass) {
            makeCurrent();
            m_pass->releaseContrast();
            doneCurrent();
        }
        update();
    }
    void setPicture(std::shared_ptr<const gpu::CardPicture> picture) override {
        m_picture = std::move(picture);
        m_image.reset();
        update();
    }
    void setDisplay(const picture::Display &display) override {
        m_display = display;
        update();
    }

protected:
    void initializeGL() override {
        gpu::contextHasChanged();
        // A widget that moves to another window loses its context, and the objects on it.
        connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] { release(); });
        try {
            m_pass = std::make_unique<gpu::TonePass>();
        } catch (const task::Error &) {
            // The driver refuses the shader: the processor composes the picture.
        }
        m_fresh = true;
    }
    void paintGL() override {
        QOpenGLFunctions *gl = context()->functions();
        gl->glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
        gl->glClear(GL_COLOR_BUFFER_BIT);
        const bool sees =
            QOpenGLContext::areSharing(context(), QOpenGLContext::globalShareContext());
        if (m_pass && m_picture && sees) {
            m_pass->draw(*m_picture, m_display);
            return;
        }
        if (m_picture)
            readBack();
        if (!m_image)
            return;
        if (!m_pass) {
            const auto rgba = picture::compose(*m_image, m_display);
            QPainter(this).drawImage(rect(), QImage(rgba.data(), m_image->width, m_image->height,
                                                    QImage::Format_RGBX8888));
            return;
        }
        if (m_fresh)
            m_pass->upload(*m_image);
        m_fresh = false;
        m_pass->draw(m_display);
    }

private:
    void release() {
        if (!m_pass)
            return;
        makeCurrent();
        m_pass.reset();
        doneCurrent();
    }

    void readBack() {
        try {
            m_image = std::make_shared<const picture::ProjectionImage>(m_picture->download());
            m_fresh = true;
        } catch (const task::Error &) {
            // The card has failed; the next frame comes from the processor.
        }
        m_picture.reset();
    }

    std::unique_ptr<gpu::TonePass> m_pass;
    Image m_image;
    std::shared_ptr<const gpu::CardPicture> m_picture;
    picture::Display m_display;
    bool m_fresh = false;
};

class RasterCanvas final : public QWidget, public ProjectionCanvas {
public:
    explicit RasterCanvas(QWidget *parent) : QWidget(parent) {
        setObjectName("projectionCanvas");
        setAttribute(Qt::WA_OpaquePaintEvent); // nothing behind it is painted
    }

    QWidget *widget() override { return this; }
    void setImage(Image image) override {
        m_image = std::move(image);
        m_stale = true;
        update();
    }
    void setPicture(std::shared_ptr<const gpu::CardPicture> picture) override {
        try {
            setImage(std::make_shared<const picture::ProjectionImage>(picture->download()));
        } catch (const task::Error &) {
            // The card has failed; the next frame comes from the processor.
        }
    }
    void setDisplay(const picture::Display &display) override {
        m_display = display;
        m_stale = true;
        update();
    }

protected:
    void paintEvent(QPaintEvent *) override {
        QPainter painter(this);
        if (m_stale)
            compose();
        if (m_picture.isNull()) {
            painter.fillRect(rect(), QColor(pictureBackground));
            return;
        }
        painter.setRenderHint(QPainter::SmoothPixmapTransform);
        painter.drawImage(rect(), m_picture); // all of it is opaque
    }

private:
    void compose() {
        m_stale = false;
        m_picture = {};
        if (!m_image)
            return;
        // The window's own format: a painter need neither convert nor blend.
        m_pixels = picture::compose(*m_image, m_display, picture::PixelOrder::bgra);
        m_picture = QImage(m_pixels.data(), m_image->width, m_image->height, QImage::Format_RGB32);
    }

    Image m_image;
    picture::Display m_display;
    picture::Pixels m_pixels; ///< of `m_picture`
    QImage m_picture;
    bool m_stale = false;
};

// Draws on the processor. Uploading, toning and compositing with a software renderer take ten times
// as long. OpenGL draws only pictures that it rendered itself.
class SoftwareCanvas final : public QWidget, public ProjectionCanvas {
public:
    explicit SoftwareCanvas(QWidget *parent)
        : QWidget(parent), m_raster(new RasterCanvas(this)), m_stack(new QStackedLayout(this)) {
        m_stack->addWidget(m_raster);
    }

    QWidget *widget() override { return this; }
    void setImage(Image image) override {
        m_raster->setImage(std::move(image));
        m_stack->setCurrentWidget(m_raster);
        if (m_gl != nullptr)
            m_gl->setImage(nullptr);
    }
    void setPicture(std::shared_ptr<const gpu::CardPicture> picture) override {
        if (m_gl == nullptr) {
            m_gl = new GlCanvas(this);
            m_stack->addWidget(m_gl);
            m_gl->setDisplay(m_display);
        }
        m_gl->setPicture(std::move(picture));
        m_stack->setCurrentWidget(m_gl);
        m_raster->setImage(nullptr);
    }
    void setDisplay(const picture::Display &display) override {
        m_display = display;
        m_raster->setDisplay(display);
        if (m_gl != nullptr)
            m_gl->setDisplay(display);
    }

private:
    RasterCanvas *m_raster;
    GlCanvas *m_gl = nullptr; ///< made for the first picture of the card
    QStackedLayout *m_stack;
    picture::Display m_display;
};

} // namespace

std::unique_ptr<ProjectionCanvas> makeProjectionCanvas(QWidget *parent) {
    // Qt may silently create a context of a lower version than requested.
    const auto &capabilities = windowCapabilities();
    if (!capabilities || !capabilities->canShowImages())
        return std::make_unique<RasterCanvas>(parent);
    if (capabilities->software)
        return std::make_unique<SoftwareCanvas>(parent);
    return makeOpenGlCanvas(parent);
}

std::unique_ptr<ProjectionCanvas> makeOpenGlCanvas(QWidget *parent) {
    return std::make_unique<GlCanvas>(parent);
}

} // namespace pellucid::ui

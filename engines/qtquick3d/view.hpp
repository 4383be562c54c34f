#pragma once

#include "cpp/xvfb.hpp"

#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QQmlComponent>
#include <QQmlEngine>
#include <QQuickWindow>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace engine::qt_adapter {

/// Windows that are never shown: what is in them is drawn into 32-bit floats.
class View {
public:
    /// @throws std::runtime_error  naming what does not start.
    View();
    View(const View&) = delete;
    View& operator=(const View&) = delete;
    ~View();

    /// GL_RENDERER.
    [[nodiscard]] std::string device() const;
    /// Takes the size of the pictures [px].
    void resize(int width, int height);
    /// Draws scene.qml once, in a window of its own.
    /// @param properties  Those that scene.qml requires.
    /// @param set         Sets the rest of what it has made.
    /// @return  Four numbers a pixel, rows from the top: what the materials say, (0, 0, 0, 1) where
    ///          nothing is seen.
    /// @throws std::runtime_error  if scene.qml cannot be made, or Qt has warned of a shader.
    [[nodiscard]] std::vector<float> draw(const QVariantMap& properties,
                                          const std::function<void(QObject&)>& set);

private:
    void make_current();
    void prepare(QQuickWindow& window);
    [[nodiscard]] std::unique_ptr<QObject> make_item(QQuickItem& parent,
                                                     const QVariantMap& properties);
    [[nodiscard]] std::vector<float> pixels();

    Xvfb display_; // before all that draws on it
    std::unique_ptr<QGuiApplication> application_;
    QOpenGLContext context_;
    QOffscreenSurface surface_;
    QQmlEngine qml_;
    QQmlComponent component_;
    std::unique_ptr<QOpenGLFramebufferObject> target_;
};

} // namespace engine::qt_adapter

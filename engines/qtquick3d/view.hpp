#pragma once

#include "cpp/program.hpp"

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

/// Draws hidden windows into 32-bit floats.
class View {
public:
    /// @throws std::runtime_error  naming the part that does not start.
    View();
    View(const View&) = delete;
    View& operator=(const View&) = delete;
    ~View();

    /// GL_RENDERER.
    [[nodiscard]] std::string device() const;
    /// Sets the size of the pictures [px].
    void resize(int width, int height);
    /// Draws scene.qml once, in a new window.
    /// @param properties  that scene.qml requires.
    /// @param set         sets other properties of the created item.
    /// @return  Four numbers a pixel, top row first: the materials' output, (0, 0, 0, 1) for
    ///          background.
    /// @throws std::runtime_error  if scene.qml cannot be created, or Qt warns of a shader.
    [[nodiscard]] std::vector<float> draw(const QVariantMap& properties,
                                          const std::function<void(QObject&)>& set);

private:
    void make_current();
    void prepare(QQuickWindow& window);
    [[nodiscard]] std::unique_ptr<QObject> make_item(QQuickItem& parent,
                                                     const QVariantMap& properties);
    [[nodiscard]] std::vector<float> pixels();

    Xvfb display_; // declared first: the members below draw on it
    std::unique_ptr<QGuiApplication> application_;
    QOpenGLContext context_;
    QOffscreenSurface surface_;
    QQmlEngine qml_;
    QQmlComponent component_;
    std::unique_ptr<QOpenGLFramebufferObject> target_;
};

} // namespace engine::qt_adapter

#include "view.hpp"

#include <QOpenGLFunctions>
#include <QQuickGraphicsDevice>
#include <QQuickItem>
#include <QQuickRenderControl>
#include <QQuickRenderTarget>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace engine::qt_adapter {
namespace {

/// Qt's last warning. A frame with a warning is an error.
QString& warning()
{
    static QString text;
    return text;
}

void take_message(QtMsgType type, const QMessageLogContext& /*context*/, const QString& text)
{
    const bool is_of_folders =
        text.startsWith("QStandardPaths"); // about sockets, which are not used here
    if (type == QtDebugMsg || type == QtInfoMsg || is_of_folders) {
        return;
    }
    warning() = text.simplified();
    std::fprintf(stderr, "%s\n", qPrintable(text));
}

std::unique_ptr<QGuiApplication> start_qt()
{
    static int count = 1;
    static char name[] = "gnomon_qtquick3d";
    static char* words[] = {name, nullptr};
    const std::string folder = std::filesystem::temp_directory_path();
    qputenv("QT_QPA_PLATFORM", "xcb");
    qputenv("QML_DISABLE_DISK_CACHE", "1");
    if (!qEnvironmentVariableIsSet("XDG_RUNTIME_DIR")) {
        qputenv("XDG_RUNTIME_DIR", folder.c_str()); // else Qt creates a folder beside it
    }
    qInstallMessageHandler(take_message);
    QCoreApplication::setAttribute(Qt::AA_DisableShaderDiskCache);
    QQuickWindow::setGraphicsApi(QSGRendererInterface::OpenGL);
    return std::make_unique<QGuiApplication>(count, words);
}

void flip_rows(std::vector<float>& pixels, int width)
{
    const auto row = 4 * static_cast<std::ptrdiff_t>(width);
    for (auto low = pixels.begin(), high = pixels.end() - row; low < high;
         low += row, high -= row) {
        std::swap_ranges(low, low + row, high);
    }
}

} // namespace

View::View() : application_{start_qt()}, component_{&qml_, QUrl{"qrc:/scene.qml"}}
{
    if (component_.isError()) {
        throw std::runtime_error{"Qt does not read scene.qml: " +
                                 component_.errorString().simplified().toStdString()};
    }
    surface_.create();
    if (!context_.create() || !context_.makeCurrent(&surface_)) {
        throw std::runtime_error{"Qt makes no GL context on Xvfb; is Mesa installed "
                                 "(libgl1-mesa-dri)?"};
    }
}

View::~View()
{
    context_.makeCurrent(&surface_);
    target_.reset();
}

void View::make_current()
{
    if (!context_.makeCurrent(&surface_)) {
        throw std::runtime_error{"Qt's GL context is lost"};
    }
}

std::string View::device() const
{
    return reinterpret_cast<const char*>(context_.functions()->glGetString(GL_RENDERER));
}

void View::resize(int width, int height)
{
    make_current();
    target_ = std::make_unique<QOpenGLFramebufferObject>(
        QSize{width, height}, QOpenGLFramebufferObject::NoAttachment, GL_TEXTURE_2D, GL_RGBA32F);
}

std::vector<float> View::pixels()
{
    make_current();
    const QSize size = target_->size();
    std::vector<float> pixels(4 * static_cast<std::size_t>(size.width()) *
                              static_cast<std::size_t>(size.height()));
    target_->bind();
    context_.functions()->glReadPixels(0, 0, size.width(), size.height(), GL_RGBA, GL_FLOAT,
                                       pixels.data());
    target_->release();
    flip_rows(pixels, size.width());
    return pixels;
}

std::vector<float> View::draw(const QVariantMap& properties,
                              const std::function<void(QObject&)>& set)
{
    warning().clear();
    make_current();
    QQuickRenderControl control;
    QQuickWindow window{&control};
    prepare(window);
    if (!control.initialize()) {
        throw std::runtime_error{"Qt Quick does not start on OpenGL"};
    }
    window.setRenderTarget(
        QQuickRenderTarget::fromOpenGLTexture(target_->texture(), GL_RGBA32F, target_->size()));
    const std::unique_ptr<QObject> item = make_item(*window.contentItem(), properties);
    set(*item);
    control.polishItems();
    control.beginFrame();
    control.sync();
    control.render();
    control.endFrame();
    if (!warning().isEmpty()) {
        throw std::runtime_error{"Qt warns: " + warning().toStdString()};
    }
    return pixels();
}

void View::prepare(QQuickWindow& window)
{
    window.setColor(Qt::black); // the mask's material never writes alpha 1
    window.setGraphicsDevice(QQuickGraphicsDevice::fromOpenGLContext(&context_));
    window.setGeometry(QRect{QPoint{}, target_->size()});
    window.contentItem()->setSize(target_->size());
}

std::unique_ptr<QObject> View::make_item(QQuickItem& parent, const QVariantMap& properties)
{
    QVariantMap initial = properties;
    initial["parent"] = QVariant::fromValue(&parent);
    std::unique_ptr<QObject> item{component_.createWithInitialProperties(initial)};
    if (!item) {
        throw std::runtime_error{"Qt does not make scene.qml: " +
                                 component_.errorString().simplified().toStdString()};
    }
    return item;
}

} // namespace engine::qt_adapter

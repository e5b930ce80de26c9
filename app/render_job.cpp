// SPDX-License-Identifier: MIT
#include "app/render_job.h"

#include "editor_ui/background_priority.h"
#include "editor_ui/relight_job.h"
#include "engine/gpu/device.h"

#include <exception>
#include <utility>

namespace limn {

/// The thread's own; nobody else touches it.
struct RenderJob::Worker {
    std::unique_ptr<gpu::Device> device;
    std::unique_ptr<Viewport> viewport;
    PictureRequest shown;
    std::shared_ptr<const OverlayData> overlay; ///< of `shown`; null: none

    Image draw(PictureRequest request);
    void makeOverlay(const PictureRequest& request);
};

void RenderJob::Worker::makeOverlay(const PictureRequest& request) {
    // Albedo is the one thing it shows that can change without a bake.
    const bool newAlbedo = request.overlay.kind == Overlay::Surfels &&
                           request.scene != shown.scene &&
                           (!shown.scene || shown.scene->materials != request.scene->materials);
    if (request.bake == shown.bake && request.overlay == shown.overlay && !newAlbedo)
        return;
    overlay = nullptr;
    if (request.bake && request.overlay.kind != Overlay::None)
        overlay = std::make_shared<const OverlayData>(limn::makeOverlay(
            *request.bake, relitScene(*request.bakedScene, *request.scene), request.overlay));
    viewport->setOverlay(overlay);
}

Image RenderJob::Worker::draw(PictureRequest request) {
    const bool newScene = request.scene != shown.scene, newLayout = request.layout != shown.layout;
    if (newScene || newLayout) {
        if (!shown.scene || newLayout || !sameGeometry(*shown.scene, *request.scene))
            viewport->setScene(*request.scene, request.layout);
        viewport->setLighting(*request.scene);
    }
    if (request.field != shown.field)
        viewport->setIndirect(request.field ? *request.field : IndirectField{});
    makeOverlay(request);
    viewport->render(request.options);
    shown = std::move(request);
    return viewport->readTonemapped();
}

RenderJob::RenderJob(bool validate, std::function<void()> wake)
    : m_wake(std::move(wake)), m_thread([this, validate] { run(validate); }) {}

RenderJob::~RenderJob() {
    {
        const std::lock_guard lock(m_mutex);
        m_stop = true;
    }
    m_changed.notify_one();
    m_thread.join();
}

void RenderJob::draw(PictureRequest request) {
    {
        const std::lock_guard lock(m_mutex);
        m_next = std::move(request);
        m_result.running = true;
    }
    m_changed.notify_one();
}

DrawnPicture RenderJob::result() const {
    const std::lock_guard lock(m_mutex);
    return m_result;
}

std::vector<std::string> RenderJob::validationMessages() const {
    const std::lock_guard lock(m_mutex);
    return m_messages;
}

void RenderJob::publish(Worker& worker, std::shared_ptr<const Image> image) {
    const std::lock_guard lock(m_mutex);
    m_result.image = std::move(image);
    ++m_result.number;
    m_result.legend = worker.overlay ? worker.overlay->legend : OverlayLegend{};
    m_result.stats = worker.viewport->stats();
    m_result.running = m_next.has_value();
    m_messages = worker.device->validationMessages();
}

void RenderJob::run(bool validate) {
    lowerThreadPriority(); // a software rasteriser's threads inherit it
    Worker worker;
    try {
        auto device = gpu::createDevice({.validation = validate});
        if (!device)
            throw std::runtime_error(device.error().message);
        worker.device = std::move(*device);
        worker.viewport = std::make_unique<Viewport>(*worker.device);
        for (;;) {
            std::unique_lock lock(m_mutex);
            m_changed.wait(lock, [&] { return m_stop || m_next; });
            if (m_stop)
                return;
            PictureRequest request = std::move(*std::exchange(m_next, {}));
            lock.unlock();
            publish(worker, std::make_shared<const Image>(worker.draw(std::move(request))));
            m_wake();
        }
    } catch (
        const std::exception& e) { // device lost, out of memory: the document can still be saved
        const std::lock_guard lock(m_mutex);
        m_result.error = e.what();
        m_result.running = false;
    }
    m_wake();
}

} // namespace limn

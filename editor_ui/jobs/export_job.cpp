// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/export_job.h"

#include "editor_ui/jobs/background_priority.h"
#include "engine/lighting/converged_light.h"
#include "engine/techniques/technique_table.h"

#include <chrono>
#include <utility>

namespace limn {

ExportJob::ExportJob(std::function<void()> wake) : m_wake(std::move(wake)) {}

ExportJob::~ExportJob() {
    m_cancel = true;
    if (m_thread.joinable())
        m_thread.join();
}

bool ExportJob::start(ExportOrder order) {
    if (m_running)
        return false;
    if (m_thread.joinable())
        m_thread.join(); // has finished
    m_cancel = false;
    m_running = true;
    {
        const std::lock_guard lock(m_mutex);
        m_stage.clear();
        m_fraction = 0;
        m_result.reset();
    }
    m_thread = std::thread([this, order = std::move(order)] { work(order); });
    return true;
}

static Result<std::vector<ExportedFile>> exportedFiles(const ExportOrder& order,
                                                       const Progress& progress) {
    const ExportFormat* format = findExportFormat(order.settings.format);
    const Technique* technique = findTechnique(order.scene->technique.technique);
    if (!format || !technique)
        return fail(format ? "the technique is unknown" : "the format is unknown");
    progress.at("light", 0);
    const Result<ConvergedLight> lit =
        convergeLight(order.scene, std::make_shared<const TraceScene>(*order.scene), *technique,
                      order.prepared, LitFor::Export, progress);
    if (!lit)
        return tl::make_unexpected(lit.error());
    const Camera* camera = lit->scene->cameras.empty() ? nullptr : &lit->scene->cameras.front();
    const std::shared_ptr<const IndirectField> emitted = lit->lighting->emittedField(*lit->scene);
    const ExportScene in{order.document, *lit->scene,   *lit->trace,
                         *lit->layout,   lit->field(),  lit->prepared.data.get(),
                         order.folders,  emitted.get(), camera};
    return exportLight(order.path, *format, in, order.settings, progress);
}

void ExportJob::work(const ExportOrder& order) {
    lowerThreadPriority();
    auto shown = std::chrono::steady_clock::now();
    Progress progress;
    progress.cancel = &m_cancel;
    progress.report = [&](const char* stage, float fraction) {
        {
            const std::lock_guard lock(m_mutex);
            m_stage = stage;
            m_fraction = fraction;
        }
        const auto now = std::chrono::steady_clock::now();
        if (now - shown > std::chrono::milliseconds(100)) {
            shown = now;
            m_wake();
        }
    };
    auto result = exportedFiles(order, progress);
    {
        const std::lock_guard lock(m_mutex);
        m_result = std::move(result);
    }
    m_running = false;
    m_wake();
}

bool ExportJob::busy() const {
    const std::lock_guard lock(m_mutex);
    return m_running || m_result;
}

std::optional<Result<std::vector<ExportedFile>>> ExportJob::takeResult() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_result, {});
}

void ExportJob::report(ExportStatus& status) const {
    status.running = m_running;
    const std::lock_guard lock(m_mutex);
    status.stage = m_stage;
    status.fraction = m_fraction;
}

} // namespace limn

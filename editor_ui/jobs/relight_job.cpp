// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/relight_job.h"

#include "editor_ui/jobs/background_priority.h"
#include "editor_ui/jobs/scene_changes.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <array>
#include <utility>

namespace limn {

Scene relitScene(const Scene& baked, const Scene& now) {
    Scene scene = baked;
    scene.lights = now.lights;
    scene.sky = now.sky;
    scene.relight = now.relight;
    if (scene.materials.size() == now.materials.size())
        scene.materials = now.materials;
    return scene;
}

/// The thread's own state; nobody else touches it.
struct RelightJob::Worker {
    std::shared_ptr<const Scene> scene; ///< newest
    std::shared_ptr<const TraceScene> trace;
    std::uint64_t inputHash = 0;
    BakedScene baked;
    LightingDriver driver;
    bool lightsBake = false; ///< the driver's lighting is of `baked`
    std::array<std::shared_ptr<IndirectField>, 3>
        pool; ///< fields that are no longer in use are reused
    LightingStatus status;
    std::optional<std::shared_ptr<const LightSnapshot>> lit; ///< none: nobody asks
    bool lighting = true;
    std::optional<Viewpoint> newestView; ///< as it was set
    std::optional<Viewpoint> view;       ///< what is looked at; none: all
    std::optional<Scene> relit;          ///< what is lit where the bake is older than the scene

    bool hasWork() const { return lighting && scene && !driver.done(); }
    /// Whether there is work for idle time, which changes no light.
    bool hasIdleWork() const { return lighting && scene && driver.canSolve(); }
    bool lights() const { return lighting && driver.lighting(); }
    bool lightsView() const { return lights() && driver.lighting()->isOfView(); }
    void setLighting(bool here);
    void lookFrom(const std::optional<Viewpoint>& next);
    void takeScene(std::shared_ptr<const Scene> next);
    void takeBake(BakedScene next);
    void makeLighting();
    LightingInput input();
    void relight(const Progress& progress);
    std::shared_ptr<const IndirectField> copyField();
    std::shared_ptr<const LightSnapshot> copyLit() const;
};

void RelightJob::Worker::takeScene(std::shared_ptr<const Scene> next) {
    const bool sameRays = scene && sameGeometry(*scene, *next);
    const bool sameFixed = scene && sameStaticGeometry(*scene, *next);
    const bool sameInputs = scene && sameBakeInputs(*scene, *next);
    const bool sameTechnique = scene && scene->technique.technique == next->technique.technique;
    const Technique& baking = precomputingTechnique(next->technique);
    const bool sameBaking = scene && &precomputingTechnique(scene->technique) == &baking;
    scene = std::move(next);
    if (!sameRays)
        trace = sameFixed ? std::make_shared<const TraceScene>(*scene, *trace)
                          : std::make_shared<const TraceScene>(*scene);
    if (!sameInputs || !sameBaking)
        inputHash = baking.precomputation->inputHash(*scene);
    if (!sameTechnique)
        makeLighting();
    driver.lightChanged();
}

void RelightJob::Worker::takeBake(BakedScene next) {
    baked = std::move(next);
    makeLighting();
}

/// Creates the lighting of the scene's technique; none if that lights bakes and there is no bake.
void RelightJob::Worker::makeLighting() {
    const Technique* technique = scene ? findTechnique(scene->technique.technique) : nullptr;
    lightsBake = technique && baked.bake && &baked.bake->technique() == technique;
    const bool possible = technique && (lightsBake || !technique->precomputation);
    driver = LightingDriver(possible ? technique->light(lightsBake ? baked.prepared() : Prepared{})
                                     : nullptr);
}

void RelightJob::Worker::setLighting(bool here) {
    if (here && !lighting)
        status = {};
    lighting = here;
}

void RelightJob::Worker::lookFrom(const std::optional<Viewpoint>& next) {
    view = next;
    if (view)
        driver.viewIs(*view);
}

LightingInput RelightJob::Worker::input() {
    const bool fresh = !lightsBake || inputHash == baked.bake->inputHash();
    const Scene& shown = fresh ? *scene : relit.emplace(relitScene(*baked.scene, *scene));
    return {.scene = shown,
            .trace = fresh ? trace.get() : baked.trace.get(),
            .view = view ? &*view : nullptr};
}

void RelightJob::Worker::relight(const Progress& progress) {
    countUpdate(status, driver, driver.step(input(), LightingDriver::Rest::All, progress));
}

std::shared_ptr<const IndirectField> RelightJob::Worker::copyField() {
    for (auto& field : pool) {
        if (field && field.use_count() > 1)
            continue;
        if (!field)
            field = std::make_shared<IndirectField>();
        *field = *driver.lighting()->field();
        return field;
    }
    return std::make_shared<const IndirectField>(*driver.lighting()->field());
}

/// Null if nothing is lit here.
std::shared_ptr<const LightSnapshot> RelightJob::Worker::copyLit() const {
    return lights() ? driver.lighting()->snapshot() : nullptr;
}

void countUpdate(LightingStatus& status, const LightingDriver& driver,
                 const std::optional<LightingReport>& report) {
    status.bounces = driver.bounces();
    status.converged = driver.converged();
    if (!report)
        return;
    ++status.calls;
    status.last = *report;
    status.history.add(*report);
}

RelightJob::RelightJob(std::function<void()> wake)
    : m_wake(std::move(wake)), m_thread([this] { run(); }) {}

RelightJob::~RelightJob() {
    {
        const std::lock_guard lock(m_mutex);
        m_stop = true;
        m_cancel = true;
    }
    m_changed.notify_one();
    m_thread.join();
}

void RelightJob::setScene(std::shared_ptr<const Scene> scene) {
    {
        const std::lock_guard lock(m_mutex);
        m_nextScene = std::move(scene);
        m_result.status.running = true;
        m_result.status.converged = false;
    }
    m_changed.notify_one();
}

void RelightJob::setBake(BakedScene baked) {
    {
        const std::lock_guard lock(m_mutex);
        m_result.status.running = m_result.status.running || baked.bake;
        m_result.status.converged = false;
        m_nextBake = std::move(baked);
    }
    m_changed.notify_one();
}

void RelightJob::setLighting(bool here) {
    {
        const std::lock_guard lock(m_mutex);
        if (here == m_lighting)
            return;
        m_lighting = here;
        m_cancel = !here; // work in progress is no longer needed
        m_result.status.running |= here;
    }
    m_changed.notify_one();
}

void RelightJob::setView(const Viewpoint& view) {
    {
        const std::lock_guard lock(m_mutex);
        if (m_view == view)
            return;
        m_view = view; // read by the next bounces
    }
    m_changed.notify_one(); // light of a view follows it
}

void RelightJob::keepLit(bool keep) {
    {
        const std::lock_guard lock(m_mutex);
        if (keep == m_keepLit)
            return;
        m_keepLit = keep;
        if (!keep)
            m_result.lit = nullptr;
    }
    m_changed.notify_one();
}

Relit RelightJob::result() const {
    const std::lock_guard lock(m_mutex);
    return m_result;
}

void RelightJob::run() {
    lowerThreadPriority();
    Worker worker;
    const Progress progress{.report = {}, .cancel = &m_cancel};
    std::unique_lock lock(m_mutex);
    for (;;) {
        const auto isAsked = [&] {
            return m_nextScene || m_nextBake || m_lighting != worker.lighting ||
                   m_keepLit != worker.lit.has_value() || worker.hasWork() ||
                   (worker.lightsView() && m_view != worker.newestView);
        };
        m_changed.wait(lock, [&] { return m_stop || isAsked() || worker.hasIdleWork(); });
        if (m_stop)
            return;
        if (!isAsked()) {
            lock.unlock();
            worker.driver.solveSources(worker.input(), progress);
            lock.lock();
            continue;
        }
        worker.setLighting(m_lighting);
        auto scene = std::exchange(m_nextScene, nullptr);
        auto baked = std::exchange(m_nextBake, {});
        const bool keepLit = m_keepLit;
        const std::optional<Viewpoint> view = m_view;
        lock.unlock();
        if (scene)
            worker.takeScene(std::move(scene));
        if (baked)
            worker.takeBake(std::move(*baked));
        worker.newestView = view;
        worker.lookFrom(keepLit && worker.lightsBake ? std::nullopt : view);
        std::shared_ptr<const IndirectField> field;
        if (worker.hasWork()) {
            worker.relight(progress);
            field = worker.copyField();
        }
        if (!keepLit)
            worker.lit.reset();
        else if (field || !worker.lit || !worker.lights())
            worker.lit = worker.copyLit();
        lock.lock();
        if (field || !worker.lights())
            m_result.field = std::move(field);
        m_result.lit = worker.lit.value_or(nullptr);
        m_result.trace = worker.trace;
        m_result.hashedScene = worker.scene;
        m_result.inputHash = worker.inputHash;
        m_result.status = worker.status;
        m_result.status.running = worker.hasWork() || m_nextScene;
        m_result.status.converged = worker.lights() && worker.driver.done() && !m_nextScene;
        lock.unlock();
        m_wake();
        lock.lock();
    }
}

} // namespace limn

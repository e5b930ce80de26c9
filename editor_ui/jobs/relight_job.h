// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/jobs/bake_job.h"
#include "engine/lighting/lighting_driver.h"
#include "engine/scene/camera.h"

#include <condition_variable>

namespace limn {

/// Results of the relighting thread. Everything is immutable or a copy.
struct Relit {
    std::shared_ptr<const IndirectField> field; ///< null: nothing is lit here
    std::shared_ptr<const LightSnapshot> lit;   ///< of `field`; null unless keepLit(true)
    std::shared_ptr<const TraceScene> trace;    ///< of the newest scene, with a short delay
    std::shared_ptr<const Scene> hashedScene;   ///< scene of `inputHash`
    std::uint64_t inputHash = 0;                ///< Precomputation::inputHash(*hashedScene)
    LightingStatus status;
};

/// Keeps the bounced light up to date with the newest scene on its own thread. A LightingDriver
/// computes a few bounces at a time until they have converged; then the thread sleeps. In any case
/// it also builds the TraceScene and the hash that decides whether a new bake is needed, because
/// both take long for large scenes. No call waits for that work.
class RelightJob {
public:
    /// `wake` is called from the thread whenever there is something new in result().
    explicit RelightJob(std::function<void()> wake);
    ~RelightJob();
    RelightJob(const RelightJob&) = delete;
    RelightJob& operator=(const RelightJob&) = delete;

    /// Sets the newest scene. Scenes that were not taken in time are dropped.
    void setScene(std::shared_ptr<const Scene> scene);

    /// Sets the bake to light, for the technique that lights bakes. With null members there is no
    /// bake, and its field is dropped.
    void setBake(BakedScene baked);

    /// Sets whether this thread lights the bake (initially true). If false, it is lit elsewhere and
    /// there is no field.
    void setLighting(bool here);

    /// Sets the viewpoint from which the field is seen. Without one, and while keepLit(true) of a
    /// bake, all caches are lit. Overlays of other techniques show what the viewpoint leaves stale.
    void setView(const Viewpoint& view);

    /// Sets whether Relit::lit is wanted for an overlay of light (initially false).
    void keepLit(bool keep);

    Relit result() const;

private:
    struct Worker;
    void run();

    std::function<void()> m_wake;
    mutable std::mutex m_mutex; ///< guards the members below
    std::condition_variable m_changed;
    std::shared_ptr<const Scene> m_nextScene; ///< not yet taken
    std::optional<BakedScene> m_nextBake;     ///< not yet taken
    bool m_lighting = true, m_keepLit = false;
    std::optional<Viewpoint> m_view;
    bool m_stop = false;
    Relit m_result;
    std::atomic<bool> m_cancel{false};
    std::thread m_thread; ///< declared last, so that it starts after all other members exist
};

/// Adds a driver's update and its progress to `status`. `report` is the result of
/// LightingDriver::step().
void countUpdate(LightingStatus& status, const LightingDriver& driver,
                 const std::optional<LightingReport>& report);

/// Copy of `baked` with the lights, materials, sky and relight settings of `now`. A bake older
/// than the document can still be lit with it.
Scene relitScene(const Scene& baked, const Scene& now);

} // namespace limn

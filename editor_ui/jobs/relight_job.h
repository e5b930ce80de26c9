// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/jobs/bake_job.h"
#include "engine/lighting/lighting_driver.h"
#include "engine/scene/camera.h"
#include "engine/techniques/illuminance/overlay/overlay.h"

#include <condition_variable>

namespace limn {

/// What the relighting thread has to show. Everything is immutable or a copy.
struct Relit {
    std::shared_ptr<const IndirectField> field; ///< null: nothing is lit here
    std::shared_ptr<const LitBake> lit; ///< that the field belongs to; null unless keepLit(true)
    std::shared_ptr<const TraceScene> trace;  ///< of the newest scene but for the last moments
    std::shared_ptr<const Scene> hashedScene; ///< what `inputHash` belongs to
    std::uint64_t inputHash = 0;              ///< bakeInputHash(*hashedScene)
    LightingStatus status;
};

/// Keeps the bounced light up to date with the newest scene on a thread of its own: a few bounces
/// at a time until converged, by a LightingDriver, then it sleeps. Whatever lights, it also builds
/// the TraceScene and the hash that decides about a new bake, because both take long on large
/// scenes. No call waits for that work.
class RelightJob {
public:
    /// `wake` is called from the thread whenever there is something new in result().
    explicit RelightJob(std::function<void()> wake);
    ~RelightJob();
    RelightJob(const RelightJob&) = delete;
    RelightJob& operator=(const RelightJob&) = delete;

    /// The newest scene; those it had no time for are dropped.
    void setScene(std::shared_ptr<const Scene> scene);

    /// The bake to light, by the technique that lights bakes. Null members: none, and its field is
    /// dropped.
    void setBake(BakedScene baked);

    /// Whether this thread lights the bake; at first it does. Not: somebody else does, and there is
    /// no field.
    void setLighting(bool here);

    /// From where the field is looked at. Without it, and while keepLit(true), all caches are lit.
    void setView(const Viewpoint& view);

    /// Whether Relit::lit is wanted, for an overlay of light. At first it is not.
    void keepLit(bool keep);

    Relit result() const;

private:
    struct Worker;
    void run();

    std::function<void()> m_wake;
    mutable std::mutex m_mutex; ///< of what follows
    std::condition_variable m_changed;
    std::shared_ptr<const Scene> m_nextScene; ///< not yet taken
    std::optional<BakedScene> m_nextBake;     ///< not yet taken
    bool m_lighting = true, m_keepLit = false;
    std::optional<Viewpoint> m_view;
    bool m_stop = false;
    Relit m_result;
    std::atomic<bool> m_cancel{false};
    std::thread m_thread; ///< last: starts when everything else is there
};

/// Takes in a driver's update, and how far it is. `report`: as LightingDriver::step() returned it.
void countUpdate(LightingStatus& status, const LightingDriver& driver,
                 const LightingReport* report);

/// True if a bake of `a` serves `b` as well, as far as can be told without hashing the meshes.
bool sameBakeInputs(const Scene& a, const Scene& b);

/// True if rays meet the same surfaces; sameStaticGeometry(): those of dynamic objects aside.
bool sameGeometry(const Scene& a, const Scene& b);
bool sameStaticGeometry(const Scene& a, const Scene& b);

/// `baked` with the lights, materials, sky, bounces and dimming of `now`: what a bake older than
/// the document can still be lit with.
Scene relitScene(const Scene& baked, const Scene& now);

} // namespace limn

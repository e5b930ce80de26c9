// SPDX-License-Identifier: MIT
#pragma once

#include "engine/measure/reference_set.h"
#include "engine/scene/scene.h"

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace limn {

/// A picture to path-trace. Equal pointers imply equal contents.
struct ReferenceOrder {
    std::shared_ptr<const Scene> scene; ///< not null
    View view = View::Lit;              ///< not Normals
    Camera camera;
    std::uint32_t width = 1, height = 1;
    double noise = 0.01; ///< standard error of a pixel at which to stop, relative to the mean
};

/// What has been path-traced so far.
struct ReferenceProgress {
    std::shared_ptr<const ReferenceSet> set; ///< null: nothing yet
    double noise = 0;     ///< of its mean, as ReferenceOrder::noise; 0 without a set
    float fraction = 0;   ///< of the pass that doubles the samples, [0, 1]
    double seconds = 0;   ///< spent on the set
    bool running = false; ///< it is being refined
};

/// Path-traces a picture in the background, and doubles its samples until it is as free of noise as
/// ordered. Starts again when the order asks for other rays or other light, once orders have rested
/// for a quarter of a second. What does not change the picture, such as settings of a bake, does
/// not disturb it. Results depend on the order and the number of passes alone.
class ReferenceJob {
public:
    /// `wake` is called from the thread when there is progress to show.
    explicit ReferenceJob(std::function<void()> wake);
    ~ReferenceJob();
    ReferenceJob(const ReferenceJob&) = delete;
    ReferenceJob& operator=(const ReferenceJob&) = delete;

    /// Sets what to path-trace; std::nullopt stops and forgets the picture. Cheap if nothing
    /// changed.
    void set(std::optional<ReferenceOrder> order);

    ReferenceProgress progress() const;

private:
    void work();
    /// Waits until orders rest. Returns the one to work on, or nothing if the job is to end.
    std::optional<ReferenceOrder> nextOrder();
    void trace(const ReferenceOrder& order);

    std::function<void()> m_wake;
    std::atomic<bool> m_cancel{false}; ///< the running pass is no longer wanted
    mutable std::mutex m_mutex;        ///< guards the members below
    std::condition_variable m_changed;
    std::optional<ReferenceOrder> m_order;
    bool m_fresh = false; ///< m_order was not taken yet
    bool m_stop = false;
    ReferenceProgress m_progress;
    std::shared_ptr<const Scene> m_tracedScene; ///< used by the thread alone
    std::unique_ptr<TraceScene> m_trace;        ///< of m_tracedScene; used by the thread alone
    std::thread m_thread; ///< declared last, so that it starts after all other members exist
};

/// Whether both orders show the same picture of the same light, at any noise.
bool samePicture(const ReferenceOrder& a, const ReferenceOrder& b);

} // namespace limn

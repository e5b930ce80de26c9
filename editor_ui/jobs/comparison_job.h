// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/view/compare_state.h"
#include "engine/measure/reference_set.h"
#include "engine/scene/image.h"
#include "engine/scene/view.h"

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace limn {

/// Which picture of a reference is wanted. Equal pointers imply equal contents.
struct ComparisonOrder {
    std::shared_ptr<const ReferenceSet> set; ///< not null
    std::shared_ptr<const ImageF> test;      ///< linear picture of the same view; null: none
    Compare shown = Compare::Reference;      ///< not Off; else a map of the test's error
    Tonemap tonemap = Tonemap::Aces;
    float exposureEv = 0;

    bool operator==(const ComparisonOrder&) const = default;
};

struct ComparedPicture {
    std::shared_ptr<const Image> image; ///< to be shown; null: none yet, or no test of its size
    std::uint64_t number = 0;           ///< of this picture, counted from 1
    std::optional<Comparison> error;    ///< of the test; none without a test of the set's size
};

/// Makes pictures of references and measures pictures against them on a thread of its own, the
/// latest order first.
class ComparisonJob {
public:
    /// `wake` is called from the thread when there is a new result().
    explicit ComparisonJob(std::function<void()> wake);
    ~ComparisonJob();
    ComparisonJob(const ComparisonJob&) = delete;
    ComparisonJob& operator=(const ComparisonJob&) = delete;

    /// Sets what is wanted; std::nullopt: nothing, and the result is forgotten. Cheap if nothing
    /// changed.
    void set(std::optional<ComparisonOrder> order);

    ComparedPicture result() const;
    /// True if the result is not yet that of the last order.
    bool busy() const;

private:
    void work();

    std::function<void()> m_wake;
    mutable std::mutex m_mutex; ///< guards the members below
    std::condition_variable m_changed;
    std::optional<ComparisonOrder> m_order;
    bool m_fresh = false, m_working = false, m_stop = false;
    ComparedPicture m_result;
    std::thread m_thread; ///< declared last, so that it starts after all other members exist
};

} // namespace limn

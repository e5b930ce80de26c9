// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/jobs/relight_job.h"
#include "engine/lightmap/layout/lightmap_layout.h"

#include <memory>
#include <string>

namespace limn {

/// A scene with its bounced light. The pointers change exactly when their contents do.
struct ShownScene {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const LightmapLayout> layout; ///< null: no bake
    std::shared_ptr<const IndirectField> field;   ///< null: not lit yet, or no bake

    bool operator==(const ShownScene&) const = default;
};

/// Lights the scene by a technique other than the document's, on the CPU, for a picture beside it.
/// Costs nothing while no technique is set.
class OtherTechnique {
public:
    /// `wake` is called from a thread whenever there is new light.
    explicit OtherTechnique(std::function<void()> wake) : m_wake(std::move(wake)) {}

    /// Sets the technique's name, the scene, which is the document's, and the bake that a technique
    /// may light. An empty name ends the work. Cheap if nothing changed; never waits for light.
    void set(const std::string& technique, const std::shared_ptr<const Scene>& scene,
             const BakedScene& baked, const Viewpoint& view);

    /// The scene with that technique as its own; a null scene where none is set.
    const ShownScene& lit() const { return m_lit; }
    bool busy() const { return m_relit.status.running; }
    /// In words: how far the light is, or why there is none.
    std::string text() const;

private:
    std::function<void()> m_wake;
    std::unique_ptr<RelightJob> m_job;            ///< null: no technique is set
    std::shared_ptr<const Scene> m_documentScene; ///< the document's scene in m_lit
    std::shared_ptr<const Precomputed> m_bake;
    ShownScene m_lit;
    Relit m_relit;
};

} // namespace limn

// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/editor_state.h"
#include "editor_ui/jobs/background_priority.h"
#include "editor_ui/jobs/bake_job.h"
#include "editor_ui/jobs/file_job.h"
#include "editor_ui/jobs/relight_job.h"

namespace limn {

struct SessionOptions {
    std::string projectsFolder;
    std::function<void()>
        wake;               ///< called from any thread when update() has something new to take in
    bool bakeOnOpen = true; ///< a scene without a bake is baked as soon as it is open
    std::string bakeFolder; ///< keeps finished stages of bakes; empty: memory does
    ImportOptions import;   ///< of every scene that is opened; its memory is also the bakes'
};

/// The document being edited and the jobs beside it: opening and saving, baking, relighting. No
/// Vulkan, no window. One thread calls it.
class Session {
public:
    explicit Session(SessionOptions options);

    EditorState state;

    /// Once per frame, after the panels: carries out the requests, takes in what the jobs have
    /// finished, hands them what changed. Never waits. Screenshot requests are left in
    /// state.requests for the window.
    void update();

    /// As File > Open does it, without asking about unsaved changes.
    void open(const std::string& what);

    /// What the viewport shows. The pointers change exactly when their contents do.
    const std::shared_ptr<const Scene>& scene() const { return m_scene; } ///< never null
    const std::shared_ptr<const LightmapLayout>& layout() const {
        return m_layout;
    } ///< null: no bake; fits scene()
    const std::shared_ptr<const IndirectField>& field() const {
        return m_relit.field;
    } ///< null: no bake, or the viewport relights

    /// Last good bake and the scene it was made from; null: none.
    const BakedScene& baked() const { return m_baked; }
    /// Whoever draws the viewport is to light baked() on its device, and fills state.relight.
    bool viewportRelights() const {
        return m_baked.bake && lightsBake() && state.relightPlace.used() == RelightOn::Gpu;
    }

    /// What an overlay of light shows; null: there is no such overlay, or the viewport relights.
    const std::shared_ptr<const LitBake>& lit() const { return m_relit.lit; }

    bool wantsQuit() const { return m_quit; }
    /// Nothing is being opened, saved, baked or relit.
    bool idle() const;
    /// Seconds of baking since the start, finished, cancelled or running.
    double bakeSeconds() const;

private:
    void handle(const Request& request);
    void takeOpened();
    void takeSky();
    void takeSaved();
    void takeBaked();
    void followDocument();
    void followTime();
    void showStatus();
    /// The document's technique is one that lights bakes.
    bool lightsBake() const;
    void useBake(BakedScene baked);
    void fitLayout();
    void log(LogLine::Level level, std::string text);

    SessionOptions m_options;
    BackgroundWorkers m_workers;
    FileJob m_files;
    BakeJob m_bakeJob;
    RelightJob m_relightJob;
    double m_shownSeconds = 0; ///< of films, as m_scene shows them
    ObjectsById m_followed;    ///< the document's objects as m_scene shows them
    std::shared_ptr<const Scene> m_scene;
    std::shared_ptr<const LightmapLayout> m_layout;
    BakedScene m_baked;
    Relit m_relit;
    bool m_bakeSoon = false; ///< start as soon as the trace scene is there
    bool m_quit = false;
    std::string m_savingTo;
    double m_bakeSecondsDone = 0, m_bakeSecondsRunning = 0, m_bakeSecondsAtLightEdit = 0;
    bool m_lightEdited = false; ///< since the scene was opened
};

/// True if the lights, the materials or the sky differ.
bool lightChanged(const Scene& a, const Scene& b);

/// The places of `scene`'s instances in the atlas of `baked`; those it does not know have none.
LightmapLayout layoutFor(const Scene& scene, const Scene& baked, const LightmapLayout& layout);

} // namespace limn

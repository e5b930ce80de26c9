// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/editor_state.h"
#include "editor_ui/jobs/background_priority.h"
#include "editor_ui/jobs/bake_job.h"
#include "editor_ui/jobs/comparison_job.h"
#include "editor_ui/jobs/explain_job.h"
#include "editor_ui/jobs/export_job.h"
#include "editor_ui/jobs/file_job.h"
#include "editor_ui/jobs/lint_job.h"
#include "editor_ui/jobs/other_technique.h"
#include "editor_ui/jobs/recovery_job.h"
#include "editor_ui/jobs/reference_job.h"
#include "editor_ui/jobs/relight_job.h"
#include "editor_ui/jobs/settings_job.h"
#include "editor_ui/session_options.h"

namespace limn {

/// The document being edited and the jobs beside it: opening and saving, baking, relighting. No
/// Vulkan, no window. One thread calls it.
class Session {
public:
    explicit Session(SessionOptions options);

    EditorState state;

    /// Carries out the requests, takes in what the jobs have finished, and hands them what changed.
    /// Call once per frame, after the panels. Never waits. Screenshot requests are left in
    /// state.requests for the window.
    void update();

    /// Opens a file as File > Open does, without asking about unsaved changes. A panorama (.hdr,
    /// .exr) becomes the sky of the open document, which is an edit.
    void open(const std::string& what);

    /// What the viewport shows. The pointers change exactly when their contents do. The scene is
    /// never null, and the layout fits it; null: no bake. The field is also null if the viewport
    /// relights.
    const std::shared_ptr<const Scene>& scene() const { return m_scene; }
    const std::shared_ptr<const LightmapLayout>& layout() const { return m_layout; }
    const std::shared_ptr<const IndirectField>& field() const { return m_relit.field; }
    /// The same for the technique that state.compare puts beside it; a null scene: none.
    const ShownScene& other() const { return m_other.lit(); }

    /// Last successful bake and the scene it was made from; members are null if there is none.
    const BakedScene& baked() const { return m_baked; }
    /// The scene's technique; null if it needs a bake and baked() is none of it.
    const Technique* lightingTechnique() const;
    /// True if whoever draws the viewport must light by it on its device and fill state.relight,
    /// and, for an overlay that is made of light alone, state.overlay's source, scene and light.
    bool viewportRelights() const;

    /// Light for an overlay of it; null: there is no such overlay, or the viewport relights.
    const std::shared_ptr<const LightSnapshot>& lit() const { return m_relit.lit; }

    /// Sets the newest picture in full size, which the reference is compared with.
    void setPicture(std::shared_ptr<const LinearPicture> picture);
    /// What state.compare asks for of the reference; a null image: nothing, or not yet.
    const ComparedPicture& compared() const { return m_beside; }

    bool wantsQuit() const { return m_quit; }
    /// What goes on beside the window, results that are not taken yet included.
    WorkSet working() const;
    bool idle() const; ///< true if none of this goes on
    /// Seconds of baking since the start, finished, cancelled or running.
    double bakeSeconds() const;

private:
    void handle(const Request& request);
    void takeOpened();
    void show(OpenedFile file);
    void offerRecovery();
    void answerRecovery(Request::Kind answer);
    void keepForRecovery();
    void takeSky();
    void openProfile(const std::string& path, ObjectId light);
    void takeProfile();
    void addFile(const Request& request);
    void takeAdded();
    void savePictures(const std::string& path);
    void takePictures();
    void takeSaved();
    void takeBaked();
    void showGoal(const std::string& goal);
    void takeExported();
    void startExport(const std::string& path);
    void showExport();
    void followReference();
    void followOtherTechnique();
    void showExplanation();
    void solveGoals();
    void followLint(bool start);
    void followDocument();
    void followTime();
    void showStatus();
    void showChanges();
    void bakeIfWanted();
    bool lightsBake() const; ///< true if the document's technique does
    void useBake(BakedScene baked);
    void followOverlay();
    void measureCost(const BakedScene& before);
    void expectCost();
    void fitLayout();
    void log(LogLine::Level level, std::string text);
    /// Logs an error and shows it in the picture.
    void complain(std::string title, std::string text);

    SessionOptions m_options;
    BackgroundWorkers m_workers;
    FileJob m_files;
    BakeJob m_bakeJob;
    RelightJob m_relightJob;
    ExportJob m_exportJob;
    ReferenceJob m_referenceJob;
    ComparisonJob m_comparisonJob;
    std::optional<ComparisonOrder> m_comparison;    ///< its newest order
    std::shared_ptr<const LinearPicture> m_picture; ///< null: none yet
    ComparedPicture m_beside;
    OtherTechnique m_other;
    ExplainJob m_explainJob;
    LintJob m_lintJob;
    double m_shownSeconds = 0; ///< time of animated textures in m_scene
    RecoveryJob m_recovery;
    SettingsJob m_settings;
    std::optional<Recovery> m_offered;          ///< that of state.recovery, or being opened
    bool m_started = false;                     ///< the first file has been opened, or could not be
    std::shared_ptr<const Document> m_followed; ///< the document as m_scene shows it; never null
    std::set<ObjectId> m_solo;                  ///< EditorState::solo, as m_scene shows it
    std::set<ObjectId> m_muted;                 ///< objects whose light m_scene leaves out
    std::shared_ptr<const Scene> m_scene, m_whole; ///< the latter also with what is muted
    std::shared_ptr<const LightmapLayout> m_layout;
    BakedScene m_baked;
    Relit m_relit;
    bool m_bakeSoon = false;                 ///< start once the trace scene exists
    BakeOrder m_bakeWish;                    ///< goal and selection of that bake
    std::uint64_t m_bakingHash = 0;          ///< input hash of the last bake that was started
    bool m_superseded = false;               ///< it was cancelled because its scene is out of date
    std::optional<std::uint64_t> m_notBaked; ///< input hash that no automatic bake is wanted of
    PrecomputedCost m_cost;                  ///< of m_baked, as BakeStatus::measured
    std::shared_ptr<const Scene> m_compared; ///< the scene that state.bake.changes speaks of
    bool m_quit = false;
    std::string m_savingTo, m_exportingTo;
    Request m_adding{Request::Kind::AddFile}; ///< the newest one whose file was read for an object
    double m_bakeSecondsDone = 0, m_bakeSecondsRunning = 0, m_bakeSecondsAtLightEdit = 0;
    bool m_lightEdited = false; ///< since the scene was opened
};

} // namespace limn

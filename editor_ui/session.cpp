// SPDX-License-Identifier: MIT
#include "editor_ui/session.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/document/first_light.h"
#include "editor_ui/document/muted.h"
#include "editor_ui/document/selection.h"
#include "editor_ui/document/solo.h"
#include "editor_ui/jobs/editor_settings.h"
#include "editor_ui/jobs/recent_files.h"
#include "editor_ui/jobs/scene_changes.h"
#include "editor_ui/panels/light_refusal.h"
#include "engine/scene/find_object.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

/// Adds a default object where the document has none of its kind. Older documents lack some of the
/// kinds that every document has one of, and no edit adds them.
template <class T>
static void addIfMissing(Document& document) {
    for (const auto& [id, object] : document.objects)
        if (std::holds_alternative<T>(object))
            return;
    addObject(document, T{});
}

static Prediction predictionFor(const Scene& scene) {
    return precomputingTechnique(scene.technique).precomputation->predict(scene, true);
}

static EditorSettings settingsIn(const std::string& file) {
    return file.empty() ? EditorSettings{} : readEditorSettings(file);
}

/// Names of the projects in a folder NAME/NAME.limn each, in order.
static std::vector<std::string> samplesIn(const std::string& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end;
         it.increment(error)) {
        const std::filesystem::path& path = it->path();
        std::error_code absent;
        const std::string name = path.filename().string();
        if (std::filesystem::exists(path / (name + ".limn"), absent))
            names.push_back(name);
    }
    std::ranges::sort(names);
    return names;
}

Session::Session(SessionOptions options)
    : m_options(std::move(options)),
      m_files(m_options.projectsFolder, m_options.import, m_options.wake),
      m_bakeJob(m_options.wake, {.folder = m_options.bakeFolder}, m_options.import.memory),
      m_relightJob(m_options.wake), m_exportJob(m_options.wake), m_referenceJob(m_options.wake),
      m_comparisonJob(m_options.wake), m_other(m_options.wake), m_explainJob(m_options.wake),
      m_lintJob(m_options.wake), m_recovery(m_options.recoveryFolder),
      m_settings(m_options.settingsFile, settingsIn(m_options.settingsFile)),
      m_followed(std::make_shared<const Document>()) {
    state.assets = std::make_shared<const Assets>();
    state.recent = readRecentFiles();
    state.samples = samplesIn(m_options.projectsFolder);
    useSettings(state, m_settings.latest());
    m_scene = m_whole = std::make_shared<const Scene>(flatten(state.document, state.assets));
}

void Session::log(LogLine::Level level, std::string text) {
    if (state.log.size() >= kMaxLogLines)
        state.log.erase(state.log.begin());
    state.log.push_back({level, std::move(text)});
}

void Session::complain(std::string title, std::string text) {
    log(LogLine::Level::Error, title + ": " + text);
    state.notice = Notice{std::move(title), std::move(text)};
}

/// The extension of a file's name in lower case.
static std::string extensionOf(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return char(std::tolower(c)); });
    return extension;
}

static bool isPanorama(const std::string& path) {
    return extensionOf(path) == ".hdr" || extensionOf(path) == ".exr";
}

static bool isProfile(const std::string& path) {
    return extensionOf(path) == ".ies";
}

void Session::open(const std::string& what) {
    if (isProfile(what))
        openProfile(what, activeId(state));
    else if (isPanorama(what) ? m_files.openSkyImage(what) : m_files.open(what))
        state.loading = what;
    else
        complain("Not opened", what + ": another file is being opened or saved; try again");
}

void Session::handle(const Request& request) {
    const bool leaves = request.kind == Request::Kind::NewFromScene ||
                        request.kind == Request::Kind::Quit ||
                        (request.kind == Request::Kind::Open && !isPanorama(request.path) &&
                         !isProfile(request.path));
    if (leaves && !request.discardsChanges && hasUnsavedChanges(state)) {
        state.confirm = request;
        return;
    }
    switch (request.kind) {
    case Request::Kind::NewFromScene:
    case Request::Kind::Open:
    case Request::Kind::OpenSkyImage:
        open(request.path);
        break;
    case Request::Kind::ExtractSun:
        if (!extractSkySun(state))
            complain("No sun", "the panorama shows nothing as small and bright as a sun");
        break;
    case Request::Kind::OpenProfile:
        openProfile(request.path, request.object);
        break;
    case Request::Kind::AddFile:
        addFile(request);
        break;
    case Request::Kind::Save:
        if (m_files.save(request.path, state.document, m_baked.preview ? nullptr : m_baked.bake))
            m_savingTo = request.path;
        else {
            state.afterSave.reset();
            complain("Not saved", "another file is being opened or saved; try again");
        }
        break;
    case Request::Kind::Recover:
    case Request::Kind::DiscardRecovery:
    case Request::Kind::PostponeRecovery:
        answerRecovery(request.kind);
        break;
    case Request::Kind::Bake:
        m_bakeWish = {};
        m_bakeSoon = true;
        break;
    case Request::Kind::BakeToError:
        m_bakeWish = {.goal = ErrorGoal{double(state.goals.maxError), state.view.camera}};
        m_bakeSoon = true;
        break;
    case Request::Kind::FitToBudget: {
        const SearchGoal limits{.maxMs = double(state.goals.budgetMs),
                                .maxBytes = double(state.goals.budgetMiB) * (1 << 20)};
        m_bakeWish = {.budget = BudgetGoal{limits, state.view.camera, state.goals.seconds}};
        m_bakeSoon = true;
        break;
    }
    case Request::Kind::BakeSelection:
        m_bakeWish = {.selection = selectionWithChildren(state)};
        m_bakeSoon = true;
        break;
    case Request::Kind::CancelBake:
        m_bakeSoon = false;
        m_bakeWish = {};
        m_notBaked = m_relit.inputHash;
        m_bakeJob.cancel();
        break;
    case Request::Kind::Lint:
        followLint(true);
        break;
    case Request::Kind::CancelLint:
        m_lintJob.cancel();
        break;
    case Request::Kind::Export:
        startExport(request.path);
        break;
    case Request::Kind::SavePictures:
        savePictures(request.path);
        break;
    case Request::Kind::CancelExport:
        m_exportJob.cancel();
        break;
    case Request::Kind::Quit:
        m_quit = true;
        break;
    case Request::Kind::Screenshot:
        state.requests.push_back(request);
        break;
    }
}

void Session::takeOpened() {
    auto opened = m_files.takeOpened();
    if (!opened)
        return;
    state.loading.clear();
    if (*opened)
        show(std::move(**opened));
    else
        complain("Not opened", opened->error().message);
    offerRecovery();
}

void Session::show(OpenedFile file) {
    m_bakeJob.cancel();
    m_bakeJob.takeUpdate();
    m_bakeJob.takeErrors(); // of another scene
    EditorState before = std::exchange(state, {});
    useSettings(state, settingsOf(before));
    state.view.origin = before.view.origin;
    state.view.size = before.view.size;
    state.clipboard = std::move(before.clipboard);
    state.frame = before.frame;
    state.relightPlace = before.relightPlace;
    state.document = std::move(file.imported.document);
    addIfMissing<TechniqueChoice>(state.document);
    addIfMissing<RelightSettings>(state.document);
    if (!file.recovered)
        state.saved = state.document.objects;
    state.assets = std::move(file.imported.assets);
    state.animation = std::move(file.imported.animation);
    state.seconds = m_options.import.seconds.value_or(0);
    state.meshBounds = std::move(file.meshBounds);
    state.projectPath = std::move(file.projectPath);
    state.sample = file.sample;
    state.samples = before.samples;
    state.recent = addRecentFile(before.recent, documentPath(state));
    log(LogLine::Level::Info, (file.recovered ? "Recovered " : "Opened ") + file.what);
    if (const std::string defect = choiceDefect(singleton<TechniqueChoice>(state.document));
        !defect.empty())
        log(LogLine::Level::Warning, file.what + ": " + defect + "; there is no bounced light");
    m_lintJob.cancel(); // it checks what was open before
    state.lint.repairs = file.imported.repairs;
    for (std::string& repair : file.imported.repairs)
        log(LogLine::Level::Warning, std::move(repair));
    const bool hasBake = file.baked.bake != nullptr;
    m_scene = hasBake ? file.baked.scene
                      : std::make_shared<const Scene>(flatten(state.document, state.assets));
    m_whole = m_scene;
    m_muted.clear();
    m_followed = std::make_shared<const Document>(state.document);
    if (file.recovered && m_offered)
        m_recovery.adopt(*std::exchange(m_offered, {}), m_followed);
    m_shownSeconds = state.seconds;
    state.view.camera = chooseCamera(*m_scene, {});
    state.sceneBounds = m_scene->bounds;
    state.prediction = predictionFor(*m_scene);
    state.view.flySpeed = std::max(glm::length(m_scene->bounds.size()) / 8, 0.01f);
    state.unlit = nothingShines(*m_scene);
    m_relightJob.setScene(m_scene);
    useBake(std::move(file.baked));
    m_bakeWish = {};
    m_bakeSoon = !hasBake && m_options.bakeOnOpen && lightsBake() && !m_scene->instances.empty();
    m_lightEdited = false;
}

/// Offers what another editor left behind: at the start any document, later that which is open.
void Session::offerRecovery() {
    const bool started = std::exchange(m_started, true);
    m_offered.reset(); // if it is still there, it could not be opened
    if (m_options.recoveryFolder.empty() || hasUnsavedChanges(state))
        return;
    std::error_code error;
    const std::string& open = documentPath(state);
    if (!open.empty())
        m_offered =
            findRecovery(m_options.recoveryFolder, std::filesystem::absolute(open, error).string());
    if (!m_offered && !started)
        m_offered = findRecovery(m_options.recoveryFolder, {});
    if (m_offered)
        state.recovery = RecoveryOffer{m_offered->originalPath, m_offered->written};
}

void Session::answerRecovery(Request::Kind answer) {
    if (!m_offered)
        return;
    if (answer == Request::Kind::DiscardRecovery)
        removeRecovery(m_offered->folder);
    if (answer != Request::Kind::Recover)
        m_offered.reset();
    else if (m_files.recover(m_offered->documentPath(), m_offered->originalPath))
        state.loading = m_offered->originalPath;
    else
        complain("Not recovered",
                 m_offered->originalPath + ": another file is being opened; open it again");
}

void Session::keepForRecovery() {
    std::error_code error;
    const std::string& path = documentPath(state);
    if (m_quit || !hasUnsavedChanges(state))
        m_recovery.clear();
    else
        m_recovery.keep(m_followed,
                        path.empty() ? path : std::filesystem::absolute(path, error).string());
    if (const std::string problem = m_recovery.takeProblem(); !problem.empty())
        log(LogLine::Level::Warning, "Changes are not kept for recovery: " + problem);
}

void Session::savePictures(const std::string& path) {
    if (!m_comparison || !m_comparison->test)
        complain("Not saved", path + ": there is no reference of this view yet");
    else if (!m_files.savePictures(path, m_comparison->test, m_comparison->set))
        complain("Not saved", path + ": another file is being opened or saved; try again");
}

void Session::takePictures() {
    const auto written = m_files.takePictures();
    if (!written)
        return;
    if (*written)
        log(LogLine::Level::Info, "Saved " + **written);
    else
        complain("Not saved", written->error().message);
}

void Session::takeSaved() {
    auto saved = m_files.takeSaved();
    if (!saved)
        return;
    const std::optional<Request> next = std::exchange(state.afterSave, {});
    if (!*saved) {
        complain("Not saved", saved->error().message);
        return;
    }
    if (next)
        state.requests.push_back(*next);
    state.saved = (*saved)->objects;
    state.projectPath = std::filesystem::absolute(m_savingTo).string();
    state.recent = addRecentFile(state.recent, state.projectPath);
    log(LogLine::Level::Info, "Saved " + m_savingTo);
}

void Session::startExport(const std::string& path) {
    state.exporting.error.clear();
    state.exporting.written.clear();
    const ExportSettings settings = singleton<ExportSettings>(state.document);
    if (!m_exportJob.start({.document = state.document,
                            .scene = m_whole,
                            .prepared = lightsBake() ? m_baked.prepared() : Prepared{},
                            .settings = settings,
                            .folders = m_options.exportFolders,
                            .path = path}))
        log(LogLine::Level::Warning, "Busy with another export; try again in a moment");
    m_exportingTo = path;
}

void Session::takeExported() {
    auto result = m_exportJob.takeResult();
    if (!result)
        return;
    if (!*result) {
        state.exporting.error = result->error().message;
        log(LogLine::Level::Warning, "Export: " + state.exporting.error);
        return;
    }
    std::uint64_t bytes = 0;
    std::string error;
    for (const ExportedFile& file : **result) {
        bytes += file.bytes;
        error += errorText(file);
    }
    state.exporting.written =
        fmt::format("Wrote {} file{}, {}{}", (*result)->size(), (*result)->size() == 1 ? "" : "s",
                    bytesText(bytes), error);
    log(LogLine::Level::Info, fmt::format("{} to {}", state.exporting.written, m_exportingTo));
}

void Session::showExport() {
    ExportStatus& status = state.exporting;
    m_exportJob.report(status);
    if (!state.exportDialog)
        return;
    status.refusal = lightRefusal(state.bake);
    status.forecast = {};
    const ExportFormat* format = findExportFormat(state.exportDialog->settings.format);
    if (!format || !status.refusal.empty() || !m_layout || !m_relit.trace)
        return;
    const Precomputed* data = lightsBake() ? m_baked.bake.get() : nullptr;
    IndirectField shape; // a forecast reads no light, and a device keeps it
    shape.lightmapWidth = m_layout->width;
    shape.lightmapHeight = m_layout->height;
    if (data)
        shape.gridSize = data->gridSize();
    else if (m_relit.field)
        shape.gridSize = m_relit.field->gridSize;
    const ExportScene in{state.document, *m_scene, *m_relit.trace,         *m_layout,
                         shape,          data,     m_options.exportFolders};
    status.forecast = format->forecast(in, state.exportDialog->settings);
}

void Session::followDocument() {
    const std::set<ObjectId> muted =
        state.explain.mutes ? state.explain.muted : std::set<ObjectId>{};
    const bool moved = state.animation && state.seconds != m_shownSeconds;
    if (state.document.objects == m_followed->objects && state.solo == m_solo && muted == m_muted &&
        !moved)
        return;
    m_followed = std::make_shared<const Document>(state.document);
    state.errors.restart(ErrorHistory::Clock::now());
    m_solo = state.solo;
    m_muted = muted;
    m_shownSeconds = state.seconds;
    const bool atRest = !state.animation || m_shownSeconds == 0;
    Scene flat = flatten(atRest ? state.document
                                : posedDocument(state.document, *state.animation, m_shownSeconds),
                         state.assets, m_shownSeconds);
    state.unlit = nothingShines(flat);
    applySolo(flat, state.document, m_solo);
    const auto whole = std::make_shared<const Scene>(std::move(flat));
    std::shared_ptr<const Scene> scene = whole;
    if (!m_muted.empty()) {
        auto without = std::make_shared<Scene>(*whole);
        applyMuted(*without, state.document, m_muted);
        scene = std::move(without);
    }
    // An unmuted scene is explained as it was.
    if (!sameGeometry(*m_whole, *whole) || !sameLight(*m_whole, *whole) || m_muted.empty())
        m_whole = whole;
    if (!sameLight(*m_scene, *scene)) {
        m_bakeSecondsAtLightEdit = bakeSeconds();
        m_lightEdited = true;
    }
    const bool sameList = sameInstanceList(*m_scene, *scene) &&
                          m_scene->technique.technique == scene->technique.technique;
    const bool sameInputs = sameBakeInputs(*m_scene, *scene);
    m_scene = std::move(scene);
    if (!sameInputs) {
        state.prediction = predictionFor(*m_scene);
        expectCost();
    }
    state.sceneBounds = m_scene->bounds;
    if (!sameList)
        fitLayout();
    m_relightJob.setScene(m_scene);
}

void Session::followTime() {
    if (state.seconds == m_shownSeconds)
        return;
    m_shownSeconds = state.seconds;
    Scene scene = *m_scene;
    if (!showTime(scene, state.document, m_shownSeconds))
        return;
    m_scene = std::make_shared<const Scene>(std::move(scene));
    if (m_muted.empty())
        m_whole = m_scene;
    m_relightJob.setScene(m_scene);
}

void Session::followReference() {
    const ViewState& view = state.view;
    const glm::uvec2 size = glm::max(glm::uvec2(view.size), glm::uvec2(1));
    CompareState& compare = state.compare;
    std::optional<ReferenceOrder> order;
    if (needsReference(compare.mode) && view.view != View::Normals && !m_scene->instances.empty())
        order = {m_scene, view.view, view.camera, size.x, size.y, compare.noise};
    m_referenceJob.set(std::move(order));
    const ReferenceProgress traced = m_referenceJob.progress();
    std::optional<ComparisonOrder> wanted;
    if (traced.set) {
        const bool same =
            m_picture && m_picture->camera == view.camera && m_picture->view == view.view;
        wanted = {traced.set,
                  same ? std::shared_ptr<const ImageF>(m_picture, &m_picture->image) : nullptr,
                  compare.mode, view.tonemap, view.exposureEv};
    }
    m_comparison = wanted;
    m_comparisonJob.set(std::move(wanted));
    m_beside = m_comparisonJob.result();
    if (m_beside.error)
        state.errors.add(ErrorHistory::Clock::now(), m_beside.number, *m_beside.error);
    compare.reference = {traced.running,  traced.set ? 4 * traced.set->samplesPerPixel : 0,
                         traced.noise,    traced.seconds,
                         traced.fraction, m_beside.error};
}

void Session::followOtherTechnique() {
    CompareState& compare = state.compare;
    const std::string& current = m_scene->technique.technique;
    if (compare.technique.empty() || compare.technique == current)
        for (const Technique* technique : techniques()) // the last one that needs no bake
            if (technique->name != current && !technique->precomputation)
                compare.technique = technique->name;
    const glm::vec2 size = glm::max(state.view.size, glm::vec2(1));
    m_other.set(compare.mode == Compare::Technique ? compare.technique : std::string(), m_scene,
                m_baked, {state.view.camera, size.x / size.y});
    compare.techniqueText = m_other.text();
}

void Session::update() {
    if (!state.requests.empty())
        commitGesture(state);
    for (const Request& request : std::exchange(state.requests, {}))
        handle(request);
    takeOpened();
    takeSky();
    takeProfile();
    takeAdded();
    takePictures();
    takeSaved();
    takeBaked();
    takeExported();
    followDocument();
    keepForRecovery();
    followTime();
    showStatus();
    bakeIfWanted();
    showExport();
    followReference();
    followOtherTechnique();
    showExplanation();
    solveGoals();
    followLint(false);
    m_settings.keep(settingsOf(state));
}

WorkSet Session::working() const {
    const bool opening = !state.loading.empty();
    WorkSet set;
    set[std::size_t(Work::Open)] = opening;
    set[std::size_t(Work::Bake)] = m_bakeSoon || m_bakeJob.busy();
    set[std::size_t(Work::Relight)] =
        state.relight.running || m_relit.status.running || m_other.busy();
    set[std::size_t(Work::Reference)] = state.compare.reference.running || m_comparisonJob.busy();
    set[std::size_t(Work::Save)] = m_files.busy() && !opening;
    set[std::size_t(Work::Explain)] = m_explainJob.busy();
    set[std::size_t(Work::Lint)] = m_lintJob.busy();
    set[std::size_t(Work::Export)] = m_exportJob.busy();
    return set;
}

bool Session::idle() const {
    return working().none();
}

double Session::bakeSeconds() const {
    return m_bakeSecondsDone + m_bakeSecondsRunning;
}

} // namespace limn

// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/file_job.h"

#include "editor_ui/document/picture_files.h"
#include "editor_ui/jobs/background_priority.h"
#include "engine/files/image_file.h"
#include "engine/files/project_file.h"
#include "engine/files/sky_file.h"
#include "engine/measure/compare.h"
#include "engine/techniques/technique_table.h"

#include <filesystem>
#include <utility>

namespace limn {

namespace fs = std::filesystem;

std::vector<Bounds> boundsOfMeshes(const Assets& assets) {
    std::vector<Bounds> all;
    for (const Mesh& mesh : assets.meshes) {
        Bounds b;
        if (!mesh.positions.empty())
            b.lower = b.upper = mesh.positions[0];
        for (glm::vec3 p : mesh.positions) {
            b.lower = glm::min(b.lower, p);
            b.upper = glm::max(b.upper, p);
        }
        all.push_back(b);
    }
    return all;
}

std::string bakePathOf(const std::string& projectPath) {
    return fs::path(projectPath).replace_extension(".limnbake").string();
}

FileJob::FileJob(std::string projectsFolder, ImportOptions options, std::function<void()> wake)
    : m_projectsFolder(std::move(projectsFolder)), m_options(options), m_wake(std::move(wake)) {}

FileJob::~FileJob() {
    m_cancel = true; // of an import; a save is always finished
    if (m_thread.joinable())
        m_thread.join();
}

bool FileJob::start(std::function<void()> work) {
    if (m_running)
        return false;
    if (m_thread.joinable())
        m_thread.join(); // has finished
    m_running = true;
    m_thread = std::thread([this, work = std::move(work)] {
        lowerThreadPriority();
        work();
        m_running = false;
        m_wake();
    });
    return true;
}

/// The bake beside a project, if there is one that fits the project's current contents.
static BakedScene bakeBeside(const std::string& projectPath, const ImportedScene& imported,
                             const MemoryBudget& memory) {
    std::error_code error;
    const std::string path = bakePathOf(projectPath);
    if (!fs::exists(path, error))
        return {};
    const auto bake = readPrecomputed(path, memory);
    auto scene = std::make_shared<const Scene>(flatten(imported.document, imported.assets));
    if (!bake || (*bake)->inputHash() != (*bake)->technique().precomputation->inputHash(*scene) ||
        !(*bake)->defect(*scene).empty())
        return {};
    return {*bake, scene, std::make_shared<const TraceScene>(*scene)};
}

static bool liesIn(const fs::path& file, const fs::path& folder) {
    if (folder.empty())
        return false;
    std::error_code error;
    const fs::path relative = fs::relative(file, folder, error);
    return !error && !relative.empty() && *relative.begin() != "..";
}

/// `imported` as the contents of the file `what`.
static Result<OpenedFile> openedFile(const std::string& what, Result<ImportedScene> imported,
                                     const std::string& projectsFolder,
                                     const ImportOptions& options) {
    if (!imported)
        return tl::make_unexpected(imported.error());
    OpenedFile file;
    file.what = what;
    file.imported = std::move(*imported);
    file.meshBounds = boundsOfMeshes(*file.imported.assets);
    const bool project = fs::path(what).extension() == ".limn";
    if (!project && file.imported.animation) // in a project, that is the user's choice
        makeMovingDynamic(file.imported.document, *file.imported.animation);
    file.sample = liesIn(project ? what : file.imported.document.scenePath, projectsFolder);
    if (project && !file.sample) {
        file.projectPath = fs::absolute(what).string();
        file.baked = bakeBeside(file.projectPath, file.imported, options.memory);
    }
    return file;
}

bool FileJob::open(std::string what) {
    return start([this, what = std::move(what)] {
        Progress progress;
        progress.cancel = &m_cancel;
        auto opened = openedFile(what, openAny(what, m_projectsFolder, progress, m_options),
                                 m_projectsFolder, m_options);
        const std::lock_guard lock(m_mutex);
        m_opened = std::move(opened);
    });
}

bool FileJob::recover(std::string copy, std::string originalPath) {
    return start([this, copy = std::move(copy), originalPath = std::move(originalPath)] {
        Progress progress;
        progress.cancel = &m_cancel;
        auto opened = openedFile(originalPath, loadProject(copy, progress, m_options),
                                 m_projectsFolder, m_options);
        if (opened)
            opened->recovered = true;
        const std::lock_guard lock(m_mutex);
        m_opened = std::move(opened);
    });
}

bool FileJob::openSkyImage(std::string path) {
    return start([this, path = std::move(path)] {
        Sky sky{.kind = SkyKind::Image, .image = path};
        const Result<void> read = readSkyImage(sky, m_options.memory);
        const std::lock_guard lock(m_mutex);
        if (read)
            m_sky = std::move(sky);
        else
            m_sky = tl::make_unexpected(read.error());
    });
}

bool FileJob::openProfile(std::string path) {
    return start([this, path = std::move(path)] {
        Result<PhotometricFile> read = readIes(path);
        const std::lock_guard lock(m_mutex);
        m_profile = std::move(read);
    });
}

bool FileJob::add(std::shared_ptr<const Assets> before, std::string path) {
    return start([this, before = std::move(before), path = std::move(path)] {
        Progress progress;
        progress.cancel = &m_cancel;
        Result<AddedAssets> read = addAssetFile(*before, path, progress, m_options);
        Result<AddedFile> added;
        if (read) {
            std::vector<Bounds> bounds = boundsOfMeshes(*read->assets);
            added = AddedFile{std::move(*read), std::move(bounds)};
        } else {
            added = tl::make_unexpected(read.error());
        }
        const std::lock_guard lock(m_mutex);
        m_added = std::move(added);
    });
}

bool FileJob::save(std::string path, Document document, std::shared_ptr<const Precomputed> bake) {
    return start(
        [this, path = std::move(path), document = std::move(document), bake = std::move(bake)] {
            Result<void> written = saveProject(path, document);
            if (written && bake)
                written = bake->write(bakePathOf(path));
            const std::lock_guard lock(m_mutex);
            if (written)
                m_saved = document;
            else
                m_saved = tl::make_unexpected(written.error());
        });
}

bool FileJob::busy() const {
    const std::lock_guard lock(m_mutex);
    return m_running || m_opened || m_sky || m_profile || m_added || m_saved || m_pictures;
}

std::optional<Result<OpenedFile>> FileJob::takeOpened() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_opened, {});
}

std::optional<Result<Sky>> FileJob::takeSky() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_sky, {});
}

std::optional<Result<PhotometricFile>> FileJob::takeProfile() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_profile, {});
}

std::optional<Result<AddedFile>> FileJob::takeAdded() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_added, {});
}

bool FileJob::savePictures(std::string path, std::shared_ptr<const ImageF> picture,
                           std::shared_ptr<const ReferenceSet> references) {
    return start([this, path = std::move(path), picture = std::move(picture),
                  references = std::move(references)] {
        const auto [ours, theirs] = pictureFiles(path);
        Result<void> written = writeExr(ours, *picture);
        if (written)
            written = writeExr(theirs, meanImage(references->first(), references->second()));
        const std::lock_guard lock(m_mutex);
        if (written)
            m_pictures = ours + " and " + theirs;
        else
            m_pictures = tl::make_unexpected(written.error());
    });
}

std::optional<Result<std::string>> FileJob::takePictures() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_pictures, {});
}

std::optional<Result<Document>> FileJob::takeSaved() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_saved, {});
}

} // namespace limn

// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/jobs/bake_job.h"
#include "engine/files/asset_file.h"
#include "engine/gltf/gltf_import.h"
#include "engine/measure/reference_set.h"
#include "engine/scene/light/ies_file.h"

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace limn {

/// The result of opening a file.
struct OpenedFile {
    std::string what;        ///< as requested
    bool recovered = false;  ///< what recover() read
    bool sample = false;     ///< its scene or project came with the program
    std::string projectPath; ///< where Save writes; empty for a scene and for sample projects
    ImportedScene imported;
    std::vector<Bounds> meshBounds; ///< object space, as Assets::meshes
    BakedScene baked;               ///< the bake that lay beside the project, if it fits
};

/// Assets with those of a file that was added.
struct AddedFile {
    AddedAssets added;
    std::vector<Bounds> meshBounds; ///< object space, as Assets::meshes
};

/// Reads and writes files on a thread, one at a time. No call waits for the disk except the
/// destructor.
class FileJob {
public:
    /// `projectsFolder`: where sample projects are looked for by name.
    FileJob(std::string projectsFolder, ImportOptions options, std::function<void()> wake);
    ~FileJob();
    FileJob(const FileJob&) = delete;
    FileJob& operator=(const FileJob&) = delete;

    /// True while a job is running or its result has not been taken.
    bool busy() const;

    /// Each of these starts its work and returns true, or returns false while another is running.
    bool open(std::string what);
    /// Reads `copy`, a project that holds unsaved changes of the project or scene at
    /// `originalPath`. Its result is that of open(originalPath) with these changes.
    bool recover(std::string copy, std::string originalPath);
    bool openSkyImage(std::string path);
    bool openProfile(std::string path);
    /// Reads what an AssetFile::path names, after `before`.
    bool add(std::shared_ptr<const Assets> before, std::string path);
    /// Writes the project and, beside it, the bake if there is one.
    bool save(std::string path, Document document, std::shared_ptr<const Precomputed> bake);

    /// Returns the result of the last open() or recover() once.
    std::optional<Result<OpenedFile>> takeOpened();
    /// Returns the panorama that the last openSkyImage() read, or its error, once.
    std::optional<Result<Sky>> takeSky();
    /// Returns what the last openProfile() read, or its error, once.
    std::optional<Result<PhotometricFile>> takeProfile();
    /// Returns what the last add() read, or its error, once.
    std::optional<Result<AddedFile>> takeAdded();
    /// Writes a picture and the mean of its references as linear EXRs to pictureFiles(path)
    /// (editor_ui/document/picture_files.h).
    bool savePictures(std::string path, std::shared_ptr<const ImageF> picture,
                      std::shared_ptr<const ReferenceSet> references);
    /// Returns the paths of the pictures that were written, or the error, once.
    std::optional<Result<std::string>> takePictures();
    /// Returns the document that was written, or the error, once.
    std::optional<Result<Document>> takeSaved();

private:
    bool start(std::function<void()> work);

    std::string m_projectsFolder;
    ImportOptions m_options;
    std::function<void()> m_wake;
    std::thread m_thread;
    std::atomic<bool> m_running{false}, m_cancel{false};
    mutable std::mutex m_mutex; ///< guards the members below
    std::optional<Result<OpenedFile>> m_opened;
    std::optional<Result<Sky>> m_sky;
    std::optional<Result<PhotometricFile>> m_profile;
    std::optional<Result<AddedFile>> m_added;
    std::optional<Result<Document>> m_saved;
    std::optional<Result<std::string>> m_pictures;
};

/// Bounding box of each mesh in object space; 0 for an empty mesh.
std::vector<Bounds> boundsOfMeshes(const Assets& assets);

/// Path of a project's bake: NAME.limnbake beside NAME.limn.
std::string bakePathOf(const std::string& projectPath);

} // namespace limn

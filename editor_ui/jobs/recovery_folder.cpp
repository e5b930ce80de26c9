// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/recovery_folder.h"

#include "engine/core/read_file.h"
#include "engine/core/replace_file.h"
#include "engine/files/project_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

namespace limn {

namespace fs = std::filesystem;

/// Opens and locks the folder's lock file; no descriptor where another editor holds it.
static Descriptor lockIn(const fs::path& folder) {
    Descriptor lock(
        open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600));
    if (lock && flock(lock.number(), LOCK_EX | LOCK_NB) != 0)
        lock.close();
    return lock;
}

Result<RecoveryFolder> createRecoveryFolder(const std::string& root) {
    std::error_code error;
    fs::create_directories(root, error);
    // Paths in a project are relative to it, and ".." leads elsewhere behind a symbolic link.
    const fs::path real = error ? fs::path() : fs::canonical(root, error);
    if (error)
        return fail(root + ": " + error.message());
    std::string name = (real / "XXXXXX").string();
    if (!mkdtemp(name.data()))
        return fail(root + ": " + std::strerror(errno));
    RecoveryFolder folder{name, lockIn(name)};
    if (!folder.lock) {
        fs::remove_all(name, error);
        return fail(name + ": cannot be locked");
    }
    return folder;
}

Result<void> writeRecovery(const RecoveryFolder& folder, const std::string& originalPath,
                           const Document& document) {
    const Result<void> named = replaceFile(folder.path + "/of", originalPath);
    return named ? saveProject(folder.path + "/document.limn", document) : named;
}

void removeRecovery(RecoveryFolder& folder) {
    std::error_code error;
    if (!folder.path.empty())
        fs::remove_all(folder.path, error);
    folder = {};
}

/// When the copy in a folder was written; 0 where there is none.
static std::time_t writtenAt(const fs::path& folder) {
    struct stat status {};
    return stat((folder / "document.limn").c_str(), &status) == 0 ? status.st_mtime : 0;
}

std::optional<Recovery> findRecovery(const std::string& root, const std::string& originalPath) {
    std::error_code error;
    std::vector<std::pair<std::time_t, fs::path>> found;
    const fs::path real = fs::canonical(root, error);
    if (error)
        return {};
    for (fs::directory_iterator it(real, error); !error && it != fs::directory_iterator();
         it.increment(error))
        if (const std::time_t written = writtenAt(it->path()))
            found.emplace_back(written, it->path());
    std::ranges::sort(found, std::greater());
    for (const auto& [written, folder] : found) {
        const Result<std::string> name = readFile((folder / "of").string(), 1 << 16);
        if (!name || (!originalPath.empty() && *name != originalPath))
            continue;
        Recovery recovery{{folder.string(), lockIn(folder)}, *name, writtenAt(folder)};
        if (recovery.folder.lock && recovery.written) // else its editor has just deleted it
            return recovery;
    }
    return {};
}

} // namespace limn

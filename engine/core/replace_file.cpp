// SPDX-License-Identifier: MIT
#include "engine/core/replace_file.h"

#include "engine/core/descriptor.h"
#include "engine/core/hash.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

namespace limn {

namespace fs = std::filesystem;

namespace {

bool writeAndSync(int file, std::string_view bytes) {
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t count = write(file, bytes.data() + done, bytes.size() - done);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return false;
        done += std::size_t(count);
    }
    return fsync(file) == 0;
}

fs::path folderOf(const fs::path& target) {
    return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

/// Gives the unnamed file `file` the name `name`. Returns false, with EEXIST, if the name is taken.
bool link(int file, const fs::path& name) {
    const std::string self = fmt::format("/proc/self/fd/{}", file);
    return linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

/// Replaces a named file by an unnamed one. No system call exchanges the two directly, so the
/// unnamed file gets a temporary name first. Only one writer of a folder does so at a time; an
/// existing file of that name was left by a writer that was killed.
bool replaceByNameless(int file, const fs::path& target, int folder) {
    if (link(file, target))
        return true;
    if (errno != EEXIST)
        return false;
    const std::string between = temporaryName(target.string());
    flock(folder, LOCK_EX); // a file system without locks must do without
    unlink(between.c_str());
    if (!link(file, between))
        return false;
    if (std::rename(between.c_str(), target.c_str()) == 0)
        return true;
    const int reason = errno;
    unlink(between.c_str());
    errno = reason;
    return false;
}

/// A file of the folder, open for writing, that is deleted unless it gets a name. On file systems
/// without unnamed files it has a temporary name from the start.
struct NewFile {
    Descriptor file;
    std::string name; ///< empty: none

    NewFile(const fs::path& target, const std::string& named)
        : file(open(folderOf(target).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666)) {
        if (file)
            return;
        static std::atomic<unsigned> count = 0; // two threads may replace the same file
        name = fmt::format("{}.{}.{}", named, getpid(), ++count);
        file = Descriptor(open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    }
    ~NewFile() {
        if (!name.empty())
            unlink(name.c_str());
    }
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;
};

} // namespace

std::string temporaryName(const std::string& path) {
    const fs::path target(path);
    const std::string name = target.filename().string();
    return (folderOf(target) /
            fmt::format(".limn-{}.tmp", hexHash(hashBytes(name.data(), name.size()))))
        .string();
}

Result<void> replaceFile(const std::string& path, std::string_view bytes, AtLink atLink) {
    std::error_code error;
    const bool follow = atLink == AtLink::Follow && fs::is_symlink(path, error);
    const fs::path target = follow ? fs::weakly_canonical(path, error) : fs::path(path);
    const auto failure = [&](const char* what) {
        return fail(fmt::format("{}: cannot {}: {}", path, what, std::strerror(errno)));
    };
    struct stat old {};
    const bool replaces = lstat(target.c_str(), &old) == 0;
    if (replaces && !S_ISREG(old.st_mode) && !S_ISLNK(old.st_mode))
        return fail(path + ": not a regular file");
    NewFile fresh(target, temporaryName(target.string()));
    if (!fresh.file)
        return failure("create");
    if (replaces && S_ISREG(old.st_mode)) // who may read it stays as it was, where that is allowed
        fchmod(fresh.file.number(), old.st_mode & 07777);
    if (!writeAndSync(fresh.file.number(), bytes))
        return failure("write");
    const Descriptor folder(open(folderOf(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    const bool done = fresh.name.empty()
                          ? replaceByNameless(fresh.file.number(), target, folder.number())
                          : std::rename(fresh.name.c_str(), target.c_str()) == 0;
    if (!done)
        return failure("replace");
    fresh.name.clear();
    if (!fresh.file.close())
        return failure("write");
    fsync(folder.number()); // a file system that cannot has nothing better
    return {};
}

} // namespace limn

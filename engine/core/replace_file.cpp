// SPDX-License-Identifier: MIT
#include "engine/core/replace_file.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace limn {

namespace fs = std::filesystem;

static bool writeAndSync(int file, const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t count = write(file, text.data() + done, text.size() - done);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return false;
        done += std::size_t(count);
    }
    return fsync(file) == 0;
}

static void syncFolder(const fs::path& folder) {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor >= 0) {
        fsync(descriptor); // the rename itself; a file system that cannot has nothing better
        close(descriptor);
    }
}

Result<void> replaceFile(const std::string& path, const std::string& text) {
    std::error_code error;
    const fs::path target =
        fs::is_symlink(path, error) ? fs::weakly_canonical(path, error) : fs::path(path);
    static std::atomic<unsigned> count = 0; // two threads may replace the same file
    const std::string temporary = fmt::format("{}.{}.{}.tmp", target.string(), getpid(), ++count);
    const auto failure = [&](const char* what) {
        const int reason = errno;
        unlink(temporary.c_str());
        return fail(fmt::format("{}: cannot {}: {}", path, what, std::strerror(reason)));
    };
    const int file = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0)
        return failure("create");
    if (!writeAndSync(file, text)) {
        const int reason = errno;
        close(file);
        errno = reason;
        return failure("write");
    }
    if (close(file) != 0)
        return failure("write");
    if (std::rename(temporary.c_str(), target.c_str()) != 0)
        return failure("replace");
    syncFolder(fs::absolute(target, error).parent_path());
    return {};
}

} // namespace limn

// SPDX-License-Identifier: MIT
#include "engine/core/read_file.h"

#include "engine/core/descriptor.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace limn {

namespace {

tl::unexpected<Error> unreadable(int reason) {
    return fail(reason == ENOENT ? "no such file"
                                 : fmt::format("cannot read: {}", std::strerror(reason)));
}

} // namespace

Result<std::string> readFile(const std::string& path, std::uint64_t maxBytes) {
    // Without O_NONBLOCK, opening a pipe waits for a writer. Regular files ignore the flag.
    const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    struct stat status {};
    if (!file || fstat(file.number(), &status) != 0)
        return unreadable(errno);
    if (!S_ISREG(status.st_mode))
        return fail("not a regular file");
    const auto size = std::uint64_t(status.st_size);
    if (size > maxBytes)
        return fail(fmt::format("its {} bytes are more than {}", size, maxBytes));
    std::string bytes(std::size_t(size), '\0');
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count = read(file.number(), bytes.data() + done, bytes.size() - done);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return unreadable(errno);
        if (count == 0) // it has become shorter
            break;
        done += std::size_t(count);
    }
    bytes.resize(done);
    return bytes;
}

} // namespace limn

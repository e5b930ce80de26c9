// SPDX-License-Identifier: MIT
#include "app/commands/output_file.h"

#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

namespace limn {

namespace fs = std::filesystem;

namespace {

struct Kind {
    const char* extension;
    std::string_view magic; ///< its files begin with it
};
constexpr Kind kKinds[] = {{".png", "\x89PNG"}, {".exr", "\x76\x2f\x31\x01"}};

/// Whether a file that begins with `bytes` is the bake of any technique.
bool isBake(std::string_view bytes) {
    return std::ranges::any_of(techniques(), [&](const Technique* technique) {
        return technique->precomputation && bytes.starts_with(technique->precomputation->fileMark);
    });
}

/// Whether the existing file has the format that its name says.
bool holdsItsKind(const fs::path& file) {
    std::string bytes(8, '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(bytes.data(), std::streamsize(bytes.size()));
    bytes.resize(std::size_t(in.gcount()));
    if (file.extension() == ".limnbake")
        return bytes.empty() || isBake(bytes);
    const auto kind = std::ranges::find_if(
        kKinds, [&](const Kind& k) { return file.extension() == k.extension; });
    return bytes.empty() || kind == std::end(kKinds) || bytes.starts_with(kind->magic);
}

} // namespace

Result<void> checkOutputFile(const std::string& path, std::span<const std::string_view> extensions,
                             std::initializer_list<std::string> inputs) {
    const fs::path file(path);
    std::error_code error;
    if (fs::is_directory(file, error))
        return fail(fmt::format("{}: is a folder", path));
    if (fs::exists(file, error) && !fs::is_regular_file(file, error))
        return fail(fmt::format("{}: is not a regular file", path));
    if (std::ranges::find(extensions, file.extension().string()) == extensions.end())
        return fail(fmt::format("{}: must end in {}", path, fmt::join(extensions, " or ")));
    for (const std::string& input : inputs)
        if (!input.empty() && fs::equivalent(file, input, error))
            return fail(fmt::format("{}: is the input {}", path, input));
    if (fs::exists(file, error) && !holdsItsKind(file))
        return fail(fmt::format("{}: holds something else, which is not replaced", path));
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error))
        return fail(fmt::format("{}: there is no folder {}", path, folder.string()));
    if (access(fs::exists(file, error) ? path.c_str() : folder.c_str(), W_OK) != 0)
        return fail(fmt::format("{}: cannot write: {}", path, std::strerror(errno)));
    return {};
}

} // namespace limn

// SPDX-License-Identifier: MIT
#include "engine/export/export_table.h"

#include "engine/core/replace_file.h"
#include "engine/export/engine_formats.h"
#include "engine/export/gltf_format.h"
#include "engine/export/lightmap_format.h"
#include "engine/export/limnrt_format.h"
#include "engine/export/web_format.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace limn {

static constexpr std::array kFormats = {
    &kGltfFormat,    &kLightmapFormat,   &kGridFormat,     &kJsonFormat,  &kThreeFormat,
    &kBabylonFormat, &kPlaycanvasFormat, &kFilamentFormat, &kGodotFormat, &kBlenderFormat,
    &kIblFormat,     &kLimnrtFormat,     &kWebFormat};

std::span<const ExportFormat* const> exportFormats() {
    return kFormats;
}

const ExportFormat* findExportFormat(std::string_view name) {
    for (const ExportFormat* format : kFormats)
        if (format->name == name)
            return format;
    return nullptr;
}

Result<void> writeExport(const std::string& path, const ExportFormat& format,
                         const std::vector<ExportFile>& files) {
    namespace fs = std::filesystem;
    const fs::path folder =
        format.extensions.empty() ? fs::path(path) : fs::path(path).parent_path();
    std::vector<fs::path> made;
    const auto undo = [&](const std::string& why) {
        std::error_code ignored;
        for (const fs::path& file : made)
            fs::remove(file, ignored);
        return fail(why);
    };
    for (std::size_t k = files.size(); k-- > 0;) { // the main file, which is first, comes last
        const fs::path file = folder / files[k].name;
        std::error_code error;
        if (file.has_parent_path())
            fs::create_directories(file.parent_path(), error);
        if (error)
            return undo(fmt::format("{}: {}", file.parent_path().string(), error.message()));
        const bool existed = fs::exists(file, error);
        if (const Result<void> written = replaceFile(file.string(), files[k].bytes); !written)
            return undo(written.error().message);
        if (!existed)
            made.push_back(file);
    }
    return {};
}

Result<void> checkExportPath(const std::string& path, const ExportFormat& format) {
    namespace fs = std::filesystem;
    std::error_code error;
    if (format.extensions.empty()) {
        if (fs::exists(path, error) && !fs::is_directory(path, error))
            return fail(fmt::format("{}: is not a folder", path));
        return {};
    }
    const std::string extension = fs::path(path).extension().string();
    if (std::ranges::find(format.extensions, extension) == format.extensions.end())
        return fail(fmt::format("{}: must end in {}", path, fmt::join(format.extensions, " or ")));
    return {};
}

/// The last part of a path, also of a folder's "path/".
static std::string nameOf(const std::string& path) {
    const std::filesystem::path p = std::filesystem::path(path).lexically_normal();
    return (p.has_filename() ? p : p.parent_path()).filename().string();
}

std::string errorText(const ExportedFile& file) {
    std::string text;
    if (file.error)
        text = fmt::format(", nRMSE {:.3f}, bias {:+.1f} %", file.error->nrmse,
                           100 * file.error->bias);
    if (file.seams)
        text += fmt::format(", seams {:.2g} %", 100 * file.seams->relative());
    return text;
}

Result<std::vector<ExportedFile>> exportLight(const std::string& path, const ExportFormat& format,
                                              const ExportScene& scene,
                                              const ExportSettings& settings,
                                              const Progress& progress) {
    if (const Result<void> possible = checkExportPath(path, format); !possible)
        return tl::make_unexpected(possible.error());
    if (!scene.field.parts.empty())
        return fail(fmt::format("{}: no format holds the light of a {}", path,
                                scene.field.parts.front()->name()));
    const Result<std::vector<ExportFile>> files =
        format.write(scene, settings, nameOf(path), progress);
    if (progress.cancelled())
        return fail("cancelled");
    if (!files)
        return fail(fmt::format("{}: {}", path, files.error().message));
    if (const Result<void> written = writeExport(path, format, *files); !written)
        return tl::make_unexpected(written.error());
    std::vector<ExportedFile> written;
    for (const ExportFile& file : *files)
        written.push_back({file.name, file.bytes.size(), file.error, file.seams});
    return written;
}

} // namespace limn

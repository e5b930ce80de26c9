// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/field/indirect_field.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/measure/compare.h"
#include "engine/measure/seams.h"
#include "engine/scene/document.h"
#include "engine/scene/export_settings.h"
#include "engine/scene/scene.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace limn {

class Precomputed;

/// Where exporters find what is not part of the program.
struct ExportFolders {
    std::string three;      ///< the npm package three
    std::string webRuntime; ///< limn_runtime.wasm
};

/// A scene with its converged bounced light: all that exporters read.
struct ExportScene {
    const Document& document;
    const Scene& scene; ///< flattened from the document
    const TraceScene& trace;
    const LightmapLayout& layout; ///< of `field`
    const IndirectField& field;
    const Precomputed* precomputed = nullptr; ///< null if the technique needs nothing of the kind
    ExportFolders folders = {};
    /// Lighting::emittedField(); null: the technique does not tell it apart.
    const IndirectField* emitted = nullptr;
    /// What the error of a lightmap is measured in front of; null: it is not measured.
    const Camera* camera = nullptr;
};

/// A file of an export, relative to the folder that is written to.
struct ExportFile {
    std::string name;                               ///< may contain folders, separated by '/'
    std::string bytes;                              ///< the whole content
    std::optional<Comparison> error = std::nullopt; ///< of the lightmap in it, where it is measured
    std::optional<SeamError> seams = std::nullopt;  ///< of the same, where it has smooth ones
};

/// An exported size before anything is computed.
struct ExportForecast {
    std::uint64_t bytes = 0;             ///< of all files, about
    std::uint32_t width = 0, height = 0; ///< of a lightmap's texture [texels]; 0: there is none
    std::uint32_t pages = 1;             ///< number of such textures, about
    std::uint32_t detail = 0;            ///< texels per cache along each side, after maxSize
};

/// A format that light is exported in, as listed by `limn export --list`, the editor's dialog and
/// the tests.
struct ExportFormat {
    const char* name;    ///< on the command line
    const char* label;   ///< for people
    const char* summary; ///< what is written and who reads it, in a sentence or two
    /// Extensions of the main file, ".gltf" first; the format follows the extension where there are
    /// several. Empty: the path is a folder.
    std::span<const std::string_view> extensions;
    std::span<const std::string_view> settings; ///< keys of the ExportSettings that it reads
    /// Produces the files. The first one is the main file, called `name`; the others lie beside it
    /// and begin with its stem, so that two exports may share a folder. Fails where the format
    /// cannot hold what the settings ask for, and when cancelled.
    Result<std::vector<ExportFile>> (*write)(const ExportScene& scene,
                                             const ExportSettings& settings,
                                             const std::string& name, const Progress& progress);
    ExportForecast (*forecast)(const ExportScene& scene, const ExportSettings& settings);
};

} // namespace limn

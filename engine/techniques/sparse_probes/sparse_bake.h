// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/sparse_probes/compressed_transport.h"
#include "engine/techniques/sparse_probes/receivers.h"
#include "engine/techniques/sparse_probes/sparse_settings.h"
#include "engine/techniques/sparse_probes/transport.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Everything that lighting by sparse probes needs of a scene. The same document gives the same
/// bytes at any number of threads.
struct SparseBake {
    BakeSettings settings;
    SparseSettings sparse;
    std::uint64_t sceneHash = 0; ///< sparseInputHash() of the scene
    LightmapLayout lightmap;
    glm::uvec3 gridSize{0}; ///< cells; 0: none
    Bounds gridBounds;
    Receivers receivers;
    std::vector<glm::vec3> probes;
    std::vector<std::uint32_t> hits; ///< traceRelightRays(): sparse.rays per probe
    Transport transport;             ///< to the receivers
    /// Takes the place of the transport's probes and coefficients where that saves memory.
    CompressedTransport compressed;
    std::uint64_t triangles = 0, rays = 0; ///< of the scene; traced when it was made
    StageSeconds seconds;                  ///< per stage; not part of the hash
    std::vector<std::string> keptStages;   ///< found in the store; neither in the hash nor the file

    std::size_t coefficients() const { return std::size_t(sparse.bands) * sparse.bands; }
    /// Hash of what light is computed from; equal for equal documents.
    std::uint64_t hash() const;
};

/// Hash of everything that a SparseBake depends on: the static scene, the texels, rays and grid of
/// its bake settings, and the technique's settings.
std::uint64_t sparseInputHash(const Scene& scene);

/// Parts of the memory that updates read, at most: before compression.
std::vector<LightingCounter> sparseBytes(std::size_t receivers, const SparseSettings& settings,
                                         std::size_t probes);
Prediction predictSparse(const Scene& scene, bool stored);

/// Memory of the transport that updates read [bytes].
double transportBytes(const SparseBake& bake);

/// Stages: charts, probes, relight rays, transport, compression. As Precomputation::prepare().
Result<SparseBake> bakeSparse(const TraceScene& trace, const PrepareOptions& options,
                              const Progress& progress);

/// First characters of its file.
inline constexpr const char* kSparseMark = "LIMNSPRP";
Result<void> writeSparse(const std::string& path, const SparseBake& bake);
Result<SparseBake> readSparse(const std::string& path, const MemoryBudget& memory);

/// Describes the first defect that makes it unsafe to light `scene` with it, or any scene if null;
/// empty: none.
std::string sparseDefect(const SparseBake& bake, const Scene* scene);

} // namespace limn

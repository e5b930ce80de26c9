// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/bake_bytes.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace limn {

/// Flags that replace the document's bake settings.
struct BakeOptions {
    std::optional<std::uint32_t> surfels, links, bands, chromaBands, rays, lightmap;
    std::optional<float> texelsPerMetre, clusterNormalWeight, clusterBalanceWeight;
    std::optional<SurfelPlacement> placement;
    std::optional<Linker> linker;
    std::optional<CutCriterion> cut;
    std::optional<LinkStorage> storage;
    std::optional<Clustering> clustering;
    const BakePreset* preset = nullptr;
    std::string grid; ///< XxYxZ, checked; empty: the document's
    int threads = 0;  ///< 0: all
};
void addBakeOptions(CLI::App& command, BakeOptions& options);

/// Puts what was given on the command line, and checked there, into `settings`.
void applyBakeOptions(const BakeOptions& options, BakeSettings& settings);

/// {"surfels", "clusters", "links", "caches", "total"}.
nlohmann::json bytesSummary(const BakeBytes& bytes);

/// {"seconds", "counts", "bytes", "notes", "hash"}.
nlohmann::json bakeSummary(const Bake& bake);

} // namespace limn

// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/lighting/lighting.h"
#include "engine/lighting/precomputed.h"
#include "engine/scene/setting.h"
#include "engine/scene/technique_choice.h"

#include <memory>
#include <span>
#include <string>

namespace limn {

/// A numeric setting specific to a technique.
struct TechniqueSetting {
    Setting setting;
    SettingRange range;
    double usual = 0;   ///< default, if the document does not set it
    bool whole = false; ///< a whole number; with range [0, 1] and no choices, a switch
    /// What the whole numbers from range.lower on mean, for people; empty: they are numbers.
    std::span<const char* const> choices = {};
};

class StageStore;

struct PrepareOptions {
    const BakeSettings* settings = nullptr;  ///< instead of the scene's; null: the scene's
    const TechniqueChoice* choice = nullptr; ///< the same
    StageStore* store = nullptr;             ///< keeps finished stages; null: nothing is kept
    MemoryBudget memory;
};

/// How a technique computes its data in advance, and what is known of that beforehand.
struct Precomputation {
    const char* fileMark; ///< the first eight characters of its files, of no other technique
    /// Version of what prepare() computes, which its files keep; 0: they keep none.
    std::uint32_t version = 0;
    /// Hash of everything that prepare() reads. Lights, albedo and the places of dynamic objects
    /// are not part of it.
    std::uint64_t (*inputHash)(const Scene& scene);
    /// Estimates prepare(). `stored`: a StageStore will keep its stages.
    Prediction (*predict)(const Scene& scene, bool stored);
    /// Settings of a quick precomputation to look at until that with `settings` is done.
    BakeSettings (*preview)(BakeSettings settings);
    /// Computes the data. Fails on an empty scene, on settings out of range, where predict()
    /// expects more than the memory allowed, and when cancelled ("cancelled").
    Result<std::shared_ptr<const Precomputed>> (*prepare)(const TraceScene& trace,
                                                          const PrepareOptions& options,
                                                          const Progress& progress);
    /// Reads what Precomputed::write() wrote. Fails on a file that is damaged, newer, or of another
    /// technique, and on one that needs more than `memory`. Precomputed::defect() tells whether it
    /// fits a scene.
    Result<std::shared_ptr<const Precomputed>> (*read)(const std::string& path,
                                                       const MemoryBudget& memory);
};

/// A technique of bounced light, as listed in documents, menus, --technique and tests.
struct Technique {
    const char* name;    ///< in documents and on the command line
    const char* label;   ///< for people
    const char* summary; ///< what it does, in a sentence or two
    const char* source;  ///< authors, title, year
    /// The first, unless it is a switch, trades time for error: benchmarks vary it.
    std::span<const TechniqueSetting> settings;
    /// Of its precomputed data, or, where it has none, of its light's snapshots; those show light.
    std::span<const OverlayKind> overlays;
    const Precomputation* precomputation; ///< null: nothing is precomputed
    /// Creates light on the CPU. Precondition: `prepared` holds data of this technique, and none
    /// where nothing is precomputed.
    std::unique_ptr<Lighting> (*light)(const Prepared& prepared);
};

/// Value of a setting in a document, clamped to its range.
double settingOf(const TechniqueChoice& choice, const TechniqueSetting& setting);

/// Name of what is lit, for relightTimesKey(): Precomputed::sizeClass() of the data, or the
/// technique's name where `data` is null because nothing is precomputed.
std::string sizeClassOf(const Technique& technique, const Precomputed* data);

} // namespace limn

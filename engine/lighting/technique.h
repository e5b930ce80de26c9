// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting.h"
#include "engine/scene/setting.h"
#include "engine/scene/technique_choice.h"

#include <memory>
#include <span>

namespace limn {

/// A numeric setting specific to a technique.
struct TechniqueSetting {
    Setting setting;
    SettingRange range;
    double usual = 0;   ///< default, if the document does not set it
    bool whole = false; ///< a whole number; with range [0, 1], a switch
};

/// A technique of bounced light, as listed in documents, menus, --technique and tests.
struct Technique {
    const char* name;    ///< in documents and on the command line
    const char* label;   ///< for people
    const char* summary; ///< what it does, in a sentence or two
    const char* source;  ///< authors, title, year
    std::span<const TechniqueSetting> settings;
    /// Creates light that needs nothing precomputed; null if the technique lights a bake.
    std::unique_ptr<Lighting> (*light)();
};

/// Value of a setting in a document, clamped to its range.
double settingOf(const TechniqueChoice& choice, const TechniqueSetting& setting);

} // namespace limn

// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting.h"
#include "engine/scene/setting.h"
#include "engine/scene/technique_choice.h"

#include <memory>
#include <span>

namespace limn {

/// A number that a technique of its own may be set to.
struct TechniqueSetting {
    Setting setting;
    SettingRange range;
    double usual = 0;   ///< where the document says nothing
    bool whole = false; ///< a whole number; of range [0, 1]: a switch
};

/// A technique of bounced light, as documents, menus, --technique and tests know it.
struct Technique {
    const char* name;    ///< in documents and on the command line
    const char* label;   ///< for people
    const char* summary; ///< what it does, in a sentence or two
    const char* source;  ///< authors, title, year
    std::span<const TechniqueSetting> settings;
    /// Light that needs nothing precomputed; null: the technique lights a bake.
    std::unique_ptr<Lighting> (*light)();
};

/// The value of a setting in a document, within its range.
double settingOf(const TechniqueChoice& choice, const TechniqueSetting& setting);

} // namespace limn

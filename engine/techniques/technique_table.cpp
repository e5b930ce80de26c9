// SPDX-License-Identifier: MIT
#include "engine/techniques/technique_table.h"

#include "engine/techniques/ambient/ambient.h"
#include "engine/techniques/illuminance/relight/illuminance.h"

#include <array>

#include <fmt/format.h>

namespace limn {

static constexpr std::array kTechniques = {&kIlluminanceTechnique, &kAmbientTechnique};

std::span<const Technique* const> techniques() {
    return kTechniques;
}

const Technique* findTechnique(std::string_view name) {
    for (const Technique* technique : kTechniques)
        if (technique->name == name)
            return technique;
    return nullptr;
}

std::string techniqueNames() {
    std::string names;
    for (const Technique* technique : kTechniques)
        names += (names.empty() ? "" : " or ") + std::string(technique->name);
    return names;
}

static bool someoneHas(const std::string& key) {
    for (const Technique* technique : kTechniques)
        for (const TechniqueSetting& setting : technique->settings)
            if (setting.setting.key == key)
                return true;
    return false;
}

std::string choiceDefect(const TechniqueChoice& choice) {
    if (!findTechnique(choice.technique))
        return fmt::format("technique: \"{}\" is not {}", choice.technique, techniqueNames());
    for (const auto& [key, value] : choice.settings)
        if (!someoneHas(key))
            return fmt::format("technique: no technique has the setting \"{}\"", key);
    return {};
}

} // namespace limn

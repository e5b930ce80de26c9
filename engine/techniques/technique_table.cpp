// SPDX-License-Identifier: MIT
#include "engine/techniques/technique_table.h"

#include "engine/techniques/ambient/ambient.h"
#include "engine/techniques/illuminance/illuminance.h"
#include "engine/techniques/light_skin/light_skin.h"
#include "engine/techniques/lpv/lpv.h"
#include "engine/techniques/photon_lattices/photon_lattices.h"
#include "engine/techniques/probes/probes.h"
#include "engine/techniques/radiance_volumes/radiance_volumes.h"
#include "engine/techniques/sparse_probes/sparse_probes.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include <fmt/format.h>

namespace limn {

static constexpr std::array kTechniques = {
    &kIlluminanceTechnique,  &kAmbientTechnique, &kLpvTechnique,       &kProbesTechnique,
    &kSparseProbesTechnique, &kPhotonTechnique,  &kLightSkinTechnique, &kRadianceVolumesTechnique};

std::span<const Technique* const> techniques() {
    return kTechniques;
}

const Technique* findTechnique(std::string_view name) {
    for (const Technique* technique : kTechniques)
        if (technique->name == name)
            return technique;
    return nullptr;
}

const Technique& precomputingTechnique(const TechniqueChoice& choice) {
    const Technique* chosen = findTechnique(choice.technique);
    if (chosen && chosen->precomputation)
        return *chosen;
    return **std::ranges::find_if(kTechniques,
                                  [](const Technique* t) { return t->precomputation != nullptr; });
}

Result<std::shared_ptr<const Precomputed>> readPrecomputed(const std::string& path,
                                                           const MemoryBudget& memory) {
    std::array<char, 8> mark{};
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error)) // a pipe would make it wait
        std::ifstream(path, std::ios::binary).read(mark.data(), mark.size());
    const auto reads = [&](const Technique* t) {
        return t->precomputation &&
               std::ranges::equal(mark, std::string_view(t->precomputation->fileMark));
    };
    const auto technique = std::ranges::find_if(kTechniques, reads);
    // A file of no technique is refused by the first.
    const Technique& reader =
        technique == kTechniques.end() ? precomputingTechnique({}) : **technique;
    return reader.precomputation->read(path, memory);
}

std::vector<const OverlayKind*> overlayKinds() {
    std::vector<const OverlayKind*> kinds;
    for (const Technique* technique : kTechniques)
        for (const OverlayKind& kind : technique->overlays)
            kinds.push_back(&kind);
    return kinds;
}

const Technique& techniqueOf(const OverlayKind& kind) {
    return **std::ranges::find_if(kTechniques, [&](const Technique* t) {
        return std::ranges::any_of(t->overlays, [&](const OverlayKind& k) { return &k == &kind; });
    });
}

bool isMadeOf(const OverlayKind& kind, const OverlaySource* source) {
    return source && &source->technique() == &techniqueOf(kind);
}

std::string techniqueNames() {
    std::string names;
    for (const Technique* technique : kTechniques)
        names += (names.empty() ? "" : " or ") + std::string(technique->name);
    return names;
}

const TechniqueSetting* findSetting(const Technique& technique, std::string_view key) {
    for (const TechniqueSetting& setting : technique.settings)
        if (setting.setting.key == key)
            return &setting;
    return nullptr;
}

static bool someoneHas(std::string_view key) {
    return std::ranges::any_of(kTechniques, [&](const Technique* technique) {
        return findSetting(*technique, key) != nullptr;
    });
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

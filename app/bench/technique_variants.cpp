// SPDX-License-Identifier: MIT
#include "app/bench/technique_variants.h"

#include "engine/scene/bake_settings_fields.h"
#include "engine/scene/setting_text.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

bool isBakeSetting(std::string_view key) {
    bool found = false;
    const BakeSettings defaults;
    visitBakeSettings(defaults, [&](const Setting& setting, const auto&, const auto&...) {
        found = found || setting.key == key;
    });
    return found;
}

/// What is wrong with one value of a technique's setting.
std::string valueDefect(const TechniqueSetting& setting, const std::string& text) {
    const std::optional<double> value = numberOf(text);
    if (!value || !std::isfinite(*value))
        return fmt::format("\"{}\" is not a number", text);
    if (setting.whole && *value != std::floor(*value))
        return fmt::format("{} is not a whole number", text);
    return numberDefect(*value, setting.range);
}

std::string valueDefect(std::string_view key, const std::string& text) {
    for (const Technique* technique : techniques())
        if (const TechniqueSetting* setting = findSetting(*technique, key))
            return valueDefect(*setting, text);
    if (!isBakeSetting(key))
        return "neither a technique nor a bake has this setting";
    BakeSettings scratch;
    return setBakeSetting(scratch, key, text);
}

std::pair<std::string, std::vector<std::string>> keyAndValues(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
        return {text, {}};
    std::vector<std::string> values;
    for (std::size_t begin = equals + 1; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        values.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return {text.substr(0, equals), values};
}

/// The presets, or steps of the first setting.
std::vector<Variant> usualVariants(const Technique& technique, const BakeSettings& bake) {
    std::vector<Variant> variants;
    if (technique.precomputation) {
        for (const BakePreset& preset : kBakePresets) {
            variants.push_back({preset.name, {technique.name, {}}, bake});
            preset.applyTo(variants.back().bake);
        }
        return variants;
    }
    const TechniqueSetting* first = technique.settings.empty() ? nullptr : &technique.settings[0];
    if (!first || first->range.upper <= 1)
        return {{"defaults", {technique.name, {}}, bake}};
    for (const double factor : {0.25, 0.5, 1., 2., 4.}) {
        const double value = std::clamp(factor * first->usual, double(first->range.lower),
                                        double(first->range.upper));
        const std::string key = first->setting.key;
        variants.push_back({fmt::format("{} {:g}", key.substr(key.find('.') + 1), value),
                            {technique.name, {{key, value}}},
                            bake});
    }
    return variants;
}

} // namespace

std::vector<Variant> variantsOf(const Technique& technique, const BakeSettings& bake,
                                const SettingsSweep& varied) {
    std::vector<Variant> variants = {{"", {technique.name, {}}, bake}};
    bool varies = false;
    for (const auto& [key, values] : varied) {
        const bool ofTechnique = findSetting(technique, key) != nullptr;
        if (!ofTechnique && !(technique.precomputation && isBakeSetting(key)))
            continue;
        varies = true;
        std::vector<Variant> combined;
        for (const Variant& variant : variants)
            for (const std::string& value : values) {
                Variant& added = combined.emplace_back(variant);
                added.name += fmt::format("{}{} {}", added.name.empty() ? "" : ", ",
                                          key.substr(key.find('.') + 1), value);
                if (ofTechnique)
                    added.choice.settings[key] = *numberOf(value);
                else
                    setBakeSetting(added.bake, key, value);
            }
        variants = std::move(combined);
    }
    return varies ? variants : usualVariants(technique, bake);
}

std::string variedDefect(const std::string& text) {
    const auto [key, values] = keyAndValues(text);
    if (values.empty())
        return fmt::format("\"{}\" is not KEY=VALUE,...", text);
    for (const std::string& value : values)
        if (const std::string defect = valueDefect(key, value); !defect.empty())
            return fmt::format("{}: {}", key, defect);
    return {};
}

SettingsSweep variedSettings(const std::vector<std::string>& texts) {
    SettingsSweep sweep;
    for (const std::string& text : texts) {
        auto [key, values] = keyAndValues(text);
        sweep[key] = std::move(values);
    }
    return sweep;
}

} // namespace limn

// SPDX-License-Identifier: MIT
#include "app/commands/technique_options.h"

#include "engine/techniques/technique_table.h"

#include <cmath>

#include <fmt/format.h>

namespace limn {

void addTechniqueOptions(Command& command, TechniqueOptions& options) {
    command
        .option("--technique", options.technique,
                "Technique that computes bounced light, instead of the document's: " +
                    techniqueNames())
        .check([](const std::string& name) {
            return findTechnique(name) ? std::string()
                                       : fmt::format("\"{}\" is not {}", name, techniqueNames());
        });
    command.option("--set", options.settings,
                   "Setting of the technique, KEY=NUMBER; may be repeated");
}

Result<void> chooseTechnique(const TechniqueOptions& options, TechniqueChoice& choice) {
    if (!options.technique.empty())
        choice.technique = options.technique;
    for (const std::string& setting : options.settings) {
        const std::size_t equals = setting.find('=');
        const std::optional<double> value =
            equals != std::string::npos ? numberOf(setting.substr(equals + 1)) : std::nullopt;
        if (!value || !std::isfinite(*value))
            return fail(fmt::format("--set: \"{}\" is not KEY=NUMBER", setting));
        choice.settings[setting.substr(0, equals)] = *value;
    }
    const std::string defect = choiceDefect(choice);
    return defect.empty() ? Result<void>{} : fail(defect);
}

} // namespace limn

// SPDX-License-Identifier: MIT
#include "app/program_version.h"

#include "engine/techniques/technique_table.h"

#include <fmt/format.h>
#include <generated/build_facts.h>

namespace limn {

std::string programVersion() {
    std::string text = fmt::format("limn {}", kProgramVersion);
    for (const Technique* technique : techniques())
        if (technique->precomputation && technique->precomputation->version > 0)
            text += fmt::format(", baker of {} {}", technique->name,
                                technique->precomputation->version);
    return text;
}

} // namespace limn

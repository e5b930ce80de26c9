// SPDX-License-Identifier: MIT
#include "app/program_version.h"

#include <generated/build_facts.h>

namespace limn {

std::string programVersion() {
    return std::string("limn ") + kProgramVersion;
}

} // namespace limn

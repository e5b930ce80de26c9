// SPDX-License-Identifier: MIT
#include "tests/core/source_path.h"

namespace limn {

std::string sourcePath(const std::string& inside) {
    return LIMN_SOURCE_DIR "/" + inside;
}

} // namespace limn

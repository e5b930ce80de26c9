// SPDX-License-Identifier: MIT
#pragma once

#include "engine/export/export_format.h"

namespace limn {

/// A folder with a page on which visitors change the light.
extern const ExportFormat kWebFormat;

} // namespace limn

// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/json/json.h"

#include <string>

namespace limn {

/// What `limn info` says of a relightable transport file: its version, its counts and the bytes of
/// each section. The message of a failure names the file and what is wrong with it, for instance
/// the section that is damaged.
Result<Json> describeTransport(const std::string& file);

} // namespace limn

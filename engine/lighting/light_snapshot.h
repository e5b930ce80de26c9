// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

/// Copy of a technique's light for its overlays. Each technique that has overlays of light derives
/// its own and is the only one to look inside.
class LightSnapshot {
public:
    virtual ~LightSnapshot() = default;
};

} // namespace limn

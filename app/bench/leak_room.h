// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/light_place.h"

#include "engine/core/result.h"
#include "engine/lighting/technique.h"
#include "engine/scene/camera.h"

#include <cstdint>
#include <memory>
#include <string>

namespace limn {

/// Two generated rooms, one lit, the other sealed: any light in that is a leak.
class LeakRoom {
public:
    /// `samplesPerPixel`: of the reference of the lit room.
    explicit LeakRoom(std::uint32_t samplesPerPixel);

    /// What walls the rooms have, for people.
    const std::string& description() const { return m_description; }

    /// Mean irradiance that the technique gives the sealed room, over that of the reference in the
    /// lit one. Fails where the technique cannot precompute its data, when cancelled, and as
    /// LightPlace::light().
    Result<double> leak(const LightPlace& place, const Technique& technique,
                        const TechniqueChoice& choice, const BakeSettings& bake,
                        const Progress& progress = {}) const;

private:
    std::string m_description;
    Scene m_scene;
    std::unique_ptr<TraceScene> m_trace;
    Camera m_dark;
    double m_outside = 0; ///< mean irradiance [W m^-2]
};

} // namespace limn

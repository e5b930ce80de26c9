// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/light/light_profile.h"

#include <string>
#include <string_view>

namespace limn {

/// What a photometric file says of a luminaire. `profile.peak` has the factors of the file in it:
/// multiplier, ballast and ballast-lamp factor.
struct PhotometricFile {
    LightProfile profile;
    float ratedFlux = 0;    ///< of all lamps together [lm]; 0: absolute photometry, which has none
    bool resampled = false; ///< angles lie closer than profiles hold, and were interpolated
};

/// Reads a file of the standard IES LM-63 (1986 to 2019) with photometry of type C and no tilt.
/// Fails for other types, for TILT=INCLUDE and tilt files, for a file that ends early, has angles
/// that do not increase or cover no known range, has no light, or more than 1e10 cd. Negative
/// intensities become 0. The size of the luminous opening is ignored.
/// ANSI/IES LM-63-19. Approved Method: IES Standard File Format for the Electronic Transfer of
/// Photometric Data. 2019
Result<PhotometricFile> parseIes(std::string_view text);

/// A file of the standard LM-63-2002 with the profile's intensities [cd], as absolute photometry.
/// parseIes() gives the profile back where its angles are thousandths of degrees.
std::string writeIes(const LightProfile& profile);

/// Reads a file of at most 16 MB. Failures name it.
Result<PhotometricFile> readIes(const std::string& path);

} // namespace limn

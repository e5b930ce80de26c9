// SPDX-License-Identifier: MIT
#include "engine/files/exr_color.h"

#include <cmath>

namespace limn {

namespace {

glm::dvec3 xyz(const Imath::V2f& xy) {
    return {double(xy.x) / xy.y, 1, (1. - xy.x - xy.y) / xy.y};
}

/// From linear RGB to XYZ, where white has a Y of 1.
glm::dmat3 xyzFromRgb(const Imf::Chromaticities& c) {
    const glm::dmat3 primaries(xyz(c.red), xyz(c.green), xyz(c.blue));
    const glm::dvec3 share = glm::inverse(primaries) * xyz(c.white);
    return {primaries[0] * share.x, primaries[1] * share.y, primaries[2] * share.z};
}

/// Makes the colours seen under one white those seen under another.
glm::dmat3 adaptation(const Imath::V2f& from, const Imath::V2f& to) {
    // Lindbloom. Chromatic Adaptation, brucelindbloom.com; the columns of its matrix.
    const glm::dmat3 cones({0.8951, -0.7502, 0.0389}, {0.2664, 1.7135, -0.0685},
                           {-0.1614, 0.0367, 1.0296});
    const glm::dvec3 scale = (cones * xyz(to)) / (cones * xyz(from));
    const glm::dmat3 diagonal({scale.x, 0, 0}, {0, scale.y, 0}, {0, 0, scale.z});
    return glm::inverse(cones) * diagonal * cones;
}

bool nearlyEqual(const Imath::V2f& a, const Imath::V2f& b) {
    constexpr float kRounding = 5e-4f; // to three digits, as in many files
    return a.equalWithAbsError(b, kRounding);
}

} // namespace

Result<void> toRec709(ImageF& image, const Imf::Chromaticities& from) {
    const Imf::Chromaticities to; // Rec. 709
    if (nearlyEqual(from.red, to.red) && nearlyEqual(from.green, to.green) &&
        nearlyEqual(from.blue, to.blue) && nearlyEqual(from.white, to.white))
        return {};
    const glm::dmat3 convert =
        glm::inverse(xyzFromRgb(to)) * adaptation(from.white, to.white) * xyzFromRgb(from);
    for (int c = 0; c < 3; ++c)
        if (const double sum = convert[c].x + convert[c].y + convert[c].z; !std::isfinite(sum))
            return fail("chromaticities: no colours can be made of them");
    for (glm::vec3& rgb : image.rgb)
        rgb = glm::vec3(convert * glm::dvec3(rgb));
    return {};
}

} // namespace limn

// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/illuminance.h"

namespace limn {

constinit const Technique kIlluminanceTechnique = {
    .name = "illuminance",
    .label = "Illuminance composition",
    .summary = "Surfels light clusters, clusters light caches of spherical harmonics through "
               "precomputed links. Needs a bake; every light then moves freely",
    .source =
        "Jendersie, Kuri, Grosch. Real-Time Global Illumination Using Precomputed Illuminance "
        "Composition with Chrominance Compression. 2016",
    .settings = {},
    .light = nullptr};

} // namespace limn

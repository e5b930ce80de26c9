// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"

namespace limn {

/// Sparse radiance probes with local reconstruction: Silvennoinen, Lehtinen. Real-time Global
/// Illumination by Precomputed Local Reconstruction from Sparse Radiance Probes. 2017. Few probes
/// hold the radiance around them as spherical harmonics; precomputed matrices make of those of the
/// eight nearest probes the irradiance of each lightmap texel, by what both see. The lightmap
/// lights the probes in turn.
///
/// Its precomputed data is a PreparedSparse. Receivers have a fixed number of probes, where the
/// paper keeps those within a fixed radius.
extern const Technique kSparseProbesTechnique;

} // namespace limn

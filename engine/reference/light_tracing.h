// SPDX-License-Identifier: MIT
#pragma once

#include "engine/reference/reference.h"

namespace limn {

/// Whether renderLightTraced() can show the view: Lit, Irradiance and Indirect.
bool canBeLightTraced(View view);

/// Ground truth with caustics: follows photons from all sources of light by tracePhoton() and
/// connects each of their arrivals with the eye, so that it holds light that mirrors and glass have
/// led to a diffuse surface, which paths from the eye do not find. The views are those of
/// renderReference() and agree with it where nothing is metallic or transmissive;
/// ReferenceOptions::maxBounces counts diffuse reflections only, and 0 leaves the caustics of
/// lights. In Lit, the photons light the surfaces that the eye sees itself; what it sees in mirrors
/// and through glass is that of renderReference(). Emits samplesPerPixel photons a pixel; noise and
/// sampling by halves are those of renderReference().
/// Arvo. Backward Ray Tracing. 1986; Dutré, Lafortune, Willems. Monte Carlo Light Tracing with
/// Direct Computation of Pixel Intensities. 1993
/// The result is identical for any number of threads. A cancelled call returns the photons so far,
/// in whole rounds.
ReferenceResult renderLightTraced(const TraceScene& trace, const ReferenceOptions& options,
                                  const Progress& progress = {});

} // namespace limn

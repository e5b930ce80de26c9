// SPDX-License-Identifier: MIT
// How a texel or cell of a field packs kBands bands, of which kChroma are in colour: engine/field/field_packing.h.
// Coefficients in colour, then grey ones, in layers of four values.
const int kColoured = kChroma < kBands ? kChroma * kChroma : kCoefficients;
const int kGreyFrom = 3 * kChroma * kChroma;
const int kValues = kChroma < kBands ? kGreyFrom + kCoefficients - kColoured : 3 * kCoefficients;
const int kLayers = (kValues + 3) / 4;

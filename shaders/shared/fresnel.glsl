// SPDX-License-Identifier: MIT
// The share of light that a smooth boundary between dielectrics reflects, as limn::fresnelDielectric() computes it.

float fresnelDielectric(float cosine, float eta) {
    const float incident = clamp(cosine, 0.0, 1.0);
    const float sine2 = max(1.0 - incident * incident, 0.0) / eta / eta;
    if (!(sine2 < 1.0))
        return 1.0;
    const float transmitted = sqrt(1.0 - sine2);
    const float parallel = (eta * incident - transmitted) / (eta * incident + transmitted);
    const float perpendicular = (incident - eta * transmitted) / (incident + eta * transmitted);
    return (parallel * parallel + perpendicular * perpendicular) / 2.0;
}

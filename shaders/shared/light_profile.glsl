// SPDX-License-Identifier: MIT
// How the intensity of a light with a profile varies with direction, as profileShare() of
// engine/scene/light/light_profile.cpp has it. The including shader must declare profiles[]: the buffer of all lights as
// floats, in which the values of profiles follow the lights.

// Value between two rows of a profile's column.
float profileInColumn(GpuLight light, uint rows, uint column, uint row, float along) {
    const uint first = light.profile + column * rows + row;
    return mix(profiles[first], profiles[first + 1u], along);
}

// Relative intensity in a unit direction away from the light; 1 without a profile.
float profileShare(GpuLight light, vec3 direction) {
    if (light.profile == 0u)
        return 1.0;
    const uint rows = light.profileSize & 0xffffu, columns = light.profileSize >> 16;
    const vec3 height = cross(light.halfWidth, light.direction);
    const vec3 local = vec3(dot(direction, light.halfWidth), dot(direction, height), dot(direction, light.direction));
    const float vertical = degrees(atan(length(local.xy), local.z));
    if (vertical < light.firstVertical - 1e-3 || vertical > light.lastVertical + 1e-3)
        return 0.0;
    const float step = (light.lastVertical - light.firstVertical) / float(rows - 1u);
    const float y = clamp((vertical - light.firstVertical) / step, 0.0, float(rows - 1u));
    const uint row = min(uint(y), rows - 2u);
    const float turns = dot(local.xy, local.xy) > 0.0 ? fract(atan(local.y, local.x) / (2.0 * kPi)) : 0.0;
    const float x = turns * float(columns);
    const uint column = min(uint(x), columns - 1u);
    return mix(profileInColumn(light, rows, column, row, y - float(row)),
               profileInColumn(light, rows, (column + 1u) % columns, row, y - float(row)), x - float(column));
}

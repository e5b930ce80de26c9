// SPDX-License-Identifier: MIT
// Direct light of any number of points, spots and suns: their numbers lie in a texture, over which every lit pixel loops. three.js'
// own lights end at some 15 to 27, where a shader runs out of textures or varyings; and here another lamp compiles no shader.
// The equations are those of docs/transport-format.md.
import * as THREE from 'three';
import { kMaxLayers, ShadowMaps } from './shadow_maps.js';
import { LightKind } from './transport.js';

const kTexels = 8; // of a lamp

const declarations = `
uniform highp sampler2D limnLamps;
uniform highp sampler2DArray limnNear, limnSuns;
uniform int limnLampCount;
uniform float limnFar, limnSunTexel, limnSmooth;

/** Share of light at \`place\` [texels] in a part of a layer: four comparisons, interpolated. */
float limnTap(const in highp sampler2DArray maps, vec2 low, float size, vec2 place, int layer, float depth) {
  vec2 p = clamp(place, vec2(0.5), vec2(size - 0.5)) - 0.5, f = fract(p);
  ivec2 i = ivec2(low) + ivec2(p), last = ivec2(low) + int(size) - 1;
  vec4 lit;
  for (int k = 0; k < 4; ++k) {
    vec4 bytes = texelFetch(maps, ivec3(min(i + ivec2(k & 1, k >> 1), last), layer), 0);
    lit[k] = step(depth, dot(bytes, vec4(1.0, 1.0 / 255.0, 1.0 / 65025.0, 1.0 / 16581375.0)));
  }
  return mix(mix(lit.x, lit.y, f.x), mix(lit.z, lit.w, f.x), f.y);
}

/** The same over \`wide\` texels, those of a pixel, whose shadow's edge would be jagged otherwise. */
float limnShadow(const in highp sampler2DArray maps, vec2 low, float size, vec2 place, int layer, float depth, float wide) {
  if (wide <= 1.0) return limnTap(maps, low, size, place, layer, depth);
  float lit = 0.0;
  for (int k = 0; k < 4; ++k) lit += limnTap(maps, low, size, place + (vec2(k & 1, k >> 1) - 0.5) * 0.5 * wide, layer, depth);
  return 0.25 * lit;
}

/** \`v\`: from the lamp to the surface. Faces are 3 by 2 to a layer. */
float limnPointShadow(vec3 v, int layer, float size, float wide) {
  vec3 a = abs(v);
  vec2 st, face;
  if (a.x >= a.y && a.x >= a.z) { st = vec2(v.x > 0.0 ? v.z : -v.z, v.y) / a.x; face = vec2(v.x > 0.0 ? 0 : 1, 0); }
  else if (a.y >= a.z) { st = vec2(v.y > 0.0 ? v.x : -v.x, v.z) / a.y; face = v.y > 0.0 ? vec2(2, 0) : vec2(0, 1); }
  else { st = vec2(v.z > 0.0 ? -v.x : v.x, v.y) / a.z; face = vec2(v.z > 0.0 ? 1 : 2, 1); }
  return limnShadow(limnNear, face * size, size, (st * 0.5 + 0.5) * size, layer, length(v) * 0.999 / limnFar, wide);
}

float limnMapShadow(const in highp sampler2DArray maps, float size, vec4 clip, int layer, float depth, float wide) {
  vec2 place = clip.xy / clip.w;
  return max(abs(place.x), abs(place.y)) > 1.0 ? 1.0 : limnShadow(maps, vec2(0), size, (place * 0.5 + 0.5) * size, layer, depth, wide);
}
`;

const loop = `
#ifdef RE_Direct
{
  #ifdef STANDARD
  material.multiScatteringCompensation = 1.0 + material.specularColorBlended * (1.0 / (material.dfg.x + material.dfg.y) - 1.0);
  #endif
  vec3 limnPlace = (vec4(geometryPosition - viewMatrix[3].xyz, 0.0) * viewMatrix).xyz;
  vec3 limnNormal = normalize((vec4(nonPerturbedNormal, 0.0) * viewMatrix).xyz);
  float limnPixel = limnSmooth * length(fwidth(limnPlace)); // [m]
  for (int k = 0; k < limnLampCount; ++k) {
    vec4 a = texelFetch(limnLamps, ivec2(0, k), 0), b = texelFetch(limnLamps, ivec2(1, k), 0);
    vec4 c = texelFetch(limnLamps, ivec2(2, k), 0), d = texelFetch(limnLamps, ivec2(3, k), 0);
    int kind = int(a.w), layer = int(c.w);
    vec3 v = kind == ${LightKind.directional} ? b.xyz : limnPlace - a.xyz; // the way of light
    float distance = length(v), lit = 1.0;
    v /= distance;
    if (kind != ${LightKind.directional}) {
      lit = 1.0 / max(distance * distance, 1e-4);
      if (b.w > 0.0) lit *= clamp(1.0 - pow(distance / b.w, 4.0), 0.0, 1.0);
      if (kind == ${LightKind.spot}) { float s = clamp((dot(v, b.xyz) - d.y) / (d.x - d.y), 0.0, 1.0); lit *= s * s; }
    }
    if (!(lit > 0.0) || dot(limnNormal, v) >= 0.0) continue;
    // A surface looks up its shadow in front of itself, one and a half texels and a part of what it looks up.
    float texel = kind == ${LightKind.directional} ? limnSunTexel : distance * (kind == ${LightKind.spot} ? d.z : 2.0) / d.w;
    float wide = min(limnPixel / texel, 8.0);
    vec3 place = limnPlace + limnNormal * ((1.5 + 0.25 * wide) * texel);
    if (layer < 0) {} // there are no maps for so many
    else if (kind == ${LightKind.point}) lit *= limnPointShadow(place - a.xyz, layer, d.w, wide);
    else {
      vec4 clip = mat4(texelFetch(limnLamps, ivec2(4, k), 0), texelFetch(limnLamps, ivec2(5, k), 0), texelFetch(limnLamps, ivec2(6, k), 0),
        texelFetch(limnLamps, ivec2(7, k), 0)) * vec4(place, 1.0);
      if (kind == ${LightKind.spot}) lit *= limnMapShadow(limnNear, 2.0 * d.w, clip, layer, length(place - a.xyz) * 0.999 / limnFar, wide);
      else lit *= limnMapShadow(limnSuns, float(textureSize(limnSuns, 0).x), clip, layer, clip.z * 0.5 + 0.5 - 1e-4, wide);
    }
    directLight.color = c.rgb * lit;
    directLight.direction = -(viewMatrix * vec4(v, 0.0)).xyz;
    directLight.visible = true;
    RE_Direct(directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight);
  }
}
#endif
`;

export class LampLight {
  constructor(renderer, casters, bounds, maxLights) {
    const size = new THREE.Vector3(), extent = bounds.getSize(size).length();
    this.maps = new ShadowMaps(renderer, casters, bounds.getCenter(new THREE.Vector3()), extent);
    this.data = new Float32Array(4 * kTexels * maxLights);
    this.texture = new THREE.DataTexture(this.data, kTexels, maxLights, THREE.RGBAFormat, THREE.FloatType);
    this.uniforms = { limnLamps: { value: this.texture }, limnNear: this.maps.near.texture, limnSuns: this.maps.suns.texture,
      limnLampCount: { value: 0 }, limnFar: { value: this.maps.far }, limnSunTexel: { value: 0 },
      limnSmooth: { value: 1 } };
    this.drawn = new Map(); // lamp: what its shadow map shows
  }

  /** Makes a material's shader loop over the lamps. `more(shader)` changes it further. */
  light(material, more, key = '') {
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, this.uniforms);
      shader.fragmentShader = shader.fragmentShader.replace('#include <common>', `#include <common>\n${declarations}`)
        .replace('#include <lights_fragment_begin>', `#include <lights_fragment_begin>\n${loop}`);
      more?.(shader);
    };
    material.customProgramCacheKey = () => `limn${key}`;
  }

  /**
   * Brings the numbers and shadow maps up to the lamps' state. Maps are drawn where a lamp or the number of maps has changed, with a
   * quarter of the texels a side and unsmoothed if it has to be done `quickly`.
   */
  update(lamps, quickly = false) {
    const lit = lamps.filter((l) => l.lights[0].kind !== LightKind.rectangle);
    const near = lit.filter((l) => l.lights[0].kind !== LightKind.directional), suns = lit.filter((l) => !near.includes(l));
    if (this.maps.near.reserve(near.length)) near.forEach((l) => this.drawn.delete(l));
    if (this.maps.suns.reserve(suns.length)) suns.forEach((l) => this.drawn.delete(l));
    let row = 0;
    for (const lamp of lit) {
      const l = lamp.lights[0], place = (near.includes(lamp) ? near : suns).indexOf(lamp);
      const layer = place < kMaxLayers ? place : -1;
      if (l.on && l.strength > 0) this.write(row++, l, layer, layer < 0 ? null : this.mapOf(lamp, l, layer, quickly));
    }
    for (const lamp of this.drawn.keys()) if (!lit.includes(lamp)) this.drawn.delete(lamp);
    this.uniforms.limnLampCount.value = row;
    this.uniforms.limnSmooth.value = quickly ? 0 : 1;
    this.uniforms.limnSunTexel.value = this.maps.extent / this.maps.suns.texels;
    this.texture.needsUpdate = true;
  }

  /** A lamp's shadow map: its matrix and texels a cube face's side. Drawn again where it shows something else, or too coarsely. */
  mapOf(lamp, l, layer, quickly) {
    const place = [l.position, l.direction, l.outerAngle, layer].join(), known = this.drawn.get(lamp);
    const texels = this.maps.near.texels / (quickly ? 4 : 1);
    if (known?.place === place && known.texels >= texels) return known;
    const position = new THREE.Vector3(...l.position), along = new THREE.Vector3(...l.direction);
    const matrix = l.kind === LightKind.point ? this.maps.point(layer, position, texels)
      : l.kind === LightKind.spot ? this.maps.spot(layer, position, along, l.outerAngle, texels) : this.maps.sun(layer, along);
    this.drawn.set(lamp, { place, matrix, texels });
    return this.drawn.get(lamp);
  }

  write(row, l, layer, map) {
    const inner = Math.max(Math.cos(l.innerAngle), Math.cos(l.outerAngle) + 1e-4);
    this.data.set([...l.position, l.kind, ...l.direction, l.range, ...l.color.map((v) => v * l.strength), layer,
      inner, Math.cos(l.outerAngle), Math.tan(Math.min(l.outerAngle + 0.01, 1.53)), map?.texels ?? 0, ...(map?.matrix?.elements ?? [])],
      4 * kTexels * row);
  }
}

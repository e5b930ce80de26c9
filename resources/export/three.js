// Shows a scene that Limn exported for three.js.
//
//     import { loadLimn } from './ROOM-three.js';
//     const { scene: room, grid, sky } = await loadLimn('ROOM.gltf', renderer);
//     scene.add(room);
//     if (grid) scene.add(grid); // lights what moves
//     scene.background = sky;
//
// Surfaces with a lightmap keep their own bounced light, and the grid passes them by. The lights of the glTF file are live and cast
// shadows, unless the lightmap has their light; { shadows: false } as the last argument draws none.
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';

async function lightMap(url, renderer) {
    if (!url.endsWith('.exr')) {
        const texture = await ktx2(url, renderer);
        texture.channel = 1;
        return texture;
    }
    const texture = await new EXRLoader().setDataType(THREE.FloatType).loadAsync(url);
    texture.flipY = true; // EXRLoader hands over the bottom row first
    texture.minFilter = texture.magFilter = THREE.LinearFilter;
    texture.channel = 1;
    texture.needsUpdate = true;
    return texture;
}

const shLightmap = `
#include "sh-lightmap.glsl"
`;

/** Shines a lightmap of harmonics on a material. A black lightMap makes three.js hand the texture coordinates to the shader. */
function addHarmonics(shader, map, bands) {
    shader.uniforms.limnLightmap = { value: map };
    shader.fragmentShader = shader.fragmentShader
        .replace('#include <common>', `#include <common>
uniform highp sampler3D limnLightmap;
#define LIMN_BANDS ${bands}
#define LIMN_SH(uv, i) texture(limnLightmap, vec3(uv, (float(i) + 0.5) / ${bands * bands}.0)).rgb
${shLightmap}`)
        .replace('#include <lights_fragment_end>', `irradiance += limnIrradiance(vLightMapUv, normalize((vec4(geometryNormal, 0.0) * viewMatrix).xyz));
#include <lights_fragment_end>`);
}

function black() {
    const texture = new THREE.DataTexture(new Uint8Array([0, 0, 0, 255]), 1, 1);
    texture.channel = 1;
    texture.needsUpdate = true;
    return texture;
}

// What a surface is lit by, it also mirrors, by the share that MeshStandardMaterial gives to its specular lobe: irradiance / pi, and
// the smoother it is, the more of a panorama.
const mirroredLight = `
#ifdef STANDARD
#ifdef USE_ENVMAP
radiance = mix(radiance, irradiance * RECIPROCAL_PI, material.roughness);
#else
radiance += irradiance * RECIPROCAL_PI;
#endif
iblIrradiance = irradiance;
irradiance = vec3(0.0);
#endif
`;

/** A copy of the material that is lit by the lightmap, or by grids if that is null, and mirrors the panorama, which may be null. */
function lit(material, map, bands, panorama) {
    const copy = material.clone();
    if (map) copy.lightMap = bands > 1 ? black() : map;
    copy.lightMapIntensity = 1;
    copy.envMap = panorama;
    copy.shadowSide = THREE.DoubleSide; // as light is blocked in Limn
    copy.onBeforeCompile = (shader) => {
        const begin = THREE.ShaderChunk.lights_fragment_begin, maps = THREE.ShaderChunk.lights_fragment_maps;
        shader.fragmentShader = shader.fragmentShader
            .replace('#include <lights_fragment_begin>', map ? begin.replace(/irradiance \+= getLightProbeGridIrradiance[^;]*;/, ';') : begin);
        if (map && bands > 1) addHarmonics(shader, map, bands);
        shader.fragmentShader = shader.fragmentShader
            .replace('#include <lights_fragment_maps>', maps.replace('iblIrradiance += getIBLIrradiance( geometryNormal );', ''))
            .replace('#include <lights_fragment_end>', `${mirroredLight}#include <lights_fragment_end>`);
    };
    copy.customProgramCacheKey = () => `limn ${map ? bands : 0}`; // three.js cannot see what the function closes over
    return copy;
}

/** Lets the material's textures stay sharp on surfaces that are seen from the side. */
function sharpen(material, renderer) {
    const samples = renderer.capabilities?.getMaxAnisotropy?.() ?? renderer.getMaxAnisotropy?.() ?? 1;
    for (const texture of [material.map, material.emissiveMap, material.normalMap, material.roughnessMap])
        if (texture) texture.anisotropy = samples;
}

/** A panorama that Limn wrote, as a background or an environment. */
async function panorama(uri, url) {
    const response = await fetch(beside(uri, url));
    if (!response.ok) throw new Error(`${uri}: ${response.status}`);
    const { width, height, half, data } = readKtx2(await response.arrayBuffer()), turned = new data.constructor(data.length);
    for (let y = 0; y < height; ++y) turned.set(data.subarray(4 * width * y, 4 * width * (y + 1)), 4 * width * (height - 1 - y));
    const texture = new THREE.DataTexture(turned, width, height, THREE.RGBAFormat, half ? THREE.HalfFloatType : THREE.FloatType);
    texture.mapping = THREE.EquirectangularReflectionMapping;
    texture.minFilter = texture.magFilter = THREE.LinearFilter;
    texture.wrapS = THREE.RepeatWrapping;
    texture.needsUpdate = true;
    return texture;
}

const kShadows = 6; // of all lamps: each takes one of a shader's 16 textures
const kShadowTexels = { DirectionalLight: 4096, SpotLight: 2048, PointLight: 1024 }; // along a side
const kShadowBias = 2; // along the surface's normal [texels]

/** Puts a sun outside of the bounds, so that its shadow map just holds them. Returns the width of a texel. */
function fitSun(sun, bounds, texels) {
    const from = sun.getWorldPosition(new THREE.Vector3()), to = sun.target.getWorldPosition(new THREE.Vector3());
    const direction = to.sub(from).normalize(), size = bounds.getSize(new THREE.Vector3()).length(), { camera } = sun.shadow;
    const eye = bounds.getCenter(new THREE.Vector3()).addScaledVector(direction, -size);
    sun.position.copy(sun.parent.worldToLocal(eye.clone()));
    sun.updateMatrixWorld(true);
    const frame = new THREE.Matrix4().lookAt(eye, eye.clone().add(direction), camera.up).setPosition(eye);
    const seen = bounds.clone().applyMatrix4(frame.invert());
    Object.assign(camera, { left: seen.min.x, right: seen.max.x, bottom: seen.min.y, top: seen.max.y, near: -seen.max.z, far: -seen.min.z });
    camera.updateProjectionMatrix();
    return Math.max(seen.max.x - seen.min.x, seen.max.y - seen.min.y) / texels;
}

/** Lets the suns and the strongest other lamps cast shadows. */
function castShadows(scene, renderer) {
    const bounds = new THREE.Box3().setFromObject(scene), extent = bounds.getSize(new THREE.Vector3()).length(), lamps = [];
    scene.traverse((o) => {
        if (o.isDirectionalLight || o.isSpotLight || o.isPointLight) lamps.push(o);
        if (!o.isMesh) return;
        const { transparent, opacity, transmission = 0 } = o.material;
        o.castShadow = transmission === 0 && !(transparent && opacity < 0.5);
        o.receiveShadow = true;
    });
    lamps.sort((a, b) => Number(Boolean(b.isDirectionalLight)) - Number(Boolean(a.isDirectionalLight)) || b.intensity - a.intensity);
    for (const lamp of lamps.slice(0, kShadows)) {
        const texels = Math.min(kShadowTexels[lamp.type], renderer.capabilities.maxTextureSize), { shadow } = lamp;
        let texel = (lamp.isSpotLight ? Math.tan(lamp.angle) : 1) * extent / texels; // half the extent away
        if (lamp.isDirectionalLight) texel = fitSun(lamp, bounds, texels);
        else Object.assign(shadow.camera, { near: 1e-3 * extent, far: lamp.distance || 2 * extent });
        lamp.castShadow = true;
        shadow.mapSize.set(texels, texels);
        shadow.normalBias = kShadowBias * texel;
        shadow.bias = -1e-4;
    }
    renderer.shadowMap.enabled = true;
}

/** Number of the panorama that a mesh mirrors. A node of several primitives is their parent. */
const reflectionOf = (mesh) => mesh.userData.limn?.reflection ?? mesh.parent?.userData.limn?.reflection ?? 0;

/** The scene of a glTF file, with the textures of its lightmap, the grid and the sky, each null where there is none. */
export async function loadLimn(url, renderer, { shadows = true } = {}) {
    const gltf = await new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).loadAsync(url);
    const { scene } = gltf, { limn } = gltf.asset.extras;
    const uris = limn.lightmap ? limn.lightmap.uris ?? [limn.lightmap.uri] : [];
    const lightMaps = await Promise.all(uris.map((uri) => lightMap(beside(uri, url), renderer)));
    const reflections = await Promise.all((limn.reflections ?? []).map(({ uri }) => panorama(uri, url)));
    const sky = limn.sky ? await panorama(limn.sky.uri, url) : null, grid = limn.grid ? await loadLimnGrid(beside(limn.grid.uri, url), renderer) : null;
    const copies = new Map(), lamps = [];
    scene.updateMatrixWorld(true);
    scene.traverse((object) => {
        if (object.isLight) lamps.push(object);
        if (!object.isMesh) return;
        const { material } = object, page = material.userData.limn?.lightmapPage ?? 0, reflection = reflectionOf(object);
        const map = object.geometry.attributes.uv1 ? lightMaps[page] ?? null : null, key = `${material.uuid} ${Boolean(map)} ${reflection}`;
        sharpen(material, renderer);
        if (!copies.has(key)) copies.set(key, lit(material, map, limn.lightmap?.bands ?? 1, reflections[reflection] ?? null));
        object.material = copies.get(key);
    });
    if (limn.lightmap?.includesDirectLight) for (const lamp of lamps) lamp.removeFromParent();
    else if (shadows) castShadows(scene, renderer);
    return { scene, gltf, lightMaps, reflections, grid, sky };
}

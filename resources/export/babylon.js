// SPDX-License-Identifier: MIT
// Shows a scene that Limn exported for Babylon.js, in left- and right-handed scenes.
//
//     import { loadLimn } from './ROOM-babylon.js';
//     await loadLimn(BABYLON, 'ROOM.gltf', scene);
//
// Babylon.js adds a lightmap to what the lights do, without the albedo. A lightmap of irradiance is therefore multiplied by a change to the
// shader; one of radiance, exported with "--quantity radiance", includes the albedo and needs no change, but is as coarse as its texels.
// Materials without a lightmap get the mean light of the scene's grid as their environment. Metal reflects panoramas of the scene. The
// lights of the glTF file are live and cast shadows, unless the lightmap has their light; { shadows: false } as the last argument draws
// none.

function lightmapTexture(BABYLON, file, scene) {
    const { Constants, Texture } = BABYLON;
    const type = file.half ? Constants.TEXTURETYPE_HALF_FLOAT : Constants.TEXTURETYPE_FLOAT;
    const texture = new BABYLON.RawTexture(file.data, file.width, file.height, Constants.TEXTUREFORMAT_RGBA, scene, false, false,
        Texture.BILINEAR_SAMPLINGMODE, type);
    texture.coordinatesIndex = 1;
    texture.gammaSpace = false;
    texture.wrapU = texture.wrapV = Texture.CLAMP_ADDRESSMODE;
    return texture;
}

/**
 * Makes the material multiply its lightmap by its albedo and `factor`, which makes it irradiance / pi, and mirror it with its specular lobe:
 * the smoother the material, the more it mirrors of its panorama instead.
 */
function multiplyByAlbedo(BABYLON, material, factor) {
    class LimnLightmap extends BABYLON.MaterialPluginBase {
        constructor() {
            super(material, 'LimnLightmap', 200, {}, true, true);
        }
        getClassName() {
            return 'LimnLightmap';
        }
        isCompatible() { // the replaced line is the same in GLSL and WGSL
            return true;
        }
        getCustomCode(type) {
            const light = `lightmapColor.rgb*${factor.toFixed(9)}`;
            const sum = `finalColor.rgb+=${light}*surfaceAlbedo.rgb;
#ifdef ENVIRONMENTBRDF
#ifdef REFLECTION
finalColor.rgb+=roughness*(${light}*colorSpecularEnvironmentReflectance-finalRadianceScaled);
#else
finalColor.rgb+=${light}*colorSpecularEnvironmentReflectance;
#endif
#endif
`;
            return type === 'fragment' ? { '!finalColor\\.rgb\\s*\\+=\\s*lightmapColor\\.rgb\\s*;': sum } : null;
        }
    }
    return new LimnLightmap();
}

/** A direction in glTF's world of a texel of a cube map, laid out as OpenGL has it, that a lookup by the scene finds. */
function cubeDirection(face, x, y, rightHanded) {
    const [a, b, c] = [[1, -y, -x], [-1, -y, x], [x, 1, y], [x, -1, -y], [x, -y, 1], [-x, -y, -1]][face];
    const length = Math.hypot(a, b, c);
    return rightHanded ? [a / length, b / length, -c / length] : [-a / length, b / length, c / length];
}

/** The panorama's radiance in a direction, by linear interpolation. */
function lookUp({ width, height, rgba }, [x, y, z]) {
    const u = (Math.atan2(z, x) / (2 * Math.PI) + 0.5) * width - 0.5, v = Math.acos(Math.min(Math.max(y, -1), 1)) / Math.PI * height - 0.5;
    const left = Math.floor(u), top = Math.floor(v), rgb = [0, 0, 0];
    for (const [column, row, weight] of [[left, top, (left + 1 - u) * (top + 1 - v)], [left + 1, top, (u - left) * (top + 1 - v)],
        [left, top + 1, (left + 1 - u) * (v - top)], [left + 1, top + 1, (u - left) * (v - top)]]) {
        const pixel = 4 * (Math.min(Math.max(row, 0), height - 1) * width + (column + width) % width);
        for (let k = 0; k < 3; ++k) rgb[k] += weight * rgba[pixel + k];
    }
    return rgb;
}

/** A panorama as floats. */
function panorama(BABYLON, { width, height, half, data }) {
    return { width, height, rgba: half ? Float32Array.from(data, (v) => BABYLON.FromHalfFloat(v)) : data };
}

/** The panorama as a cube texture of `size` texels a side. */
function cubeTexture(BABYLON, map, size, scene, mips) {
    const { Constants, Texture } = BABYLON;
    const faces = Array.from({ length: 6 }, (_, face) => {
        const texels = new Float32Array(4 * size * size).fill(1);
        for (let p = 0; p < size * size; ++p)
            texels.set(lookUp(map, cubeDirection(face, 2 * (p % size + 0.5) / size - 1, 2 * (Math.floor(p / size) + 0.5) / size - 1,
                scene.useRightHandedSystem)), 4 * p);
        return texels;
    });
    const cube = new BABYLON.RawCubeTexture(scene, faces, size, Constants.TEXTUREFORMAT_RGBA, Constants.TEXTURETYPE_FLOAT, mips, false,
        mips ? Texture.TRILINEAR_SAMPLINGMODE : Texture.BILINEAR_SAMPLINGMODE);
    cube.gammaSpace = false;
    return cube;
}

/** What metal reflects: blurred for each roughness, and without irradiance, which the lightmap has. */
async function reflection(BABYLON, map, scene) {
    const cube = cubeTexture(BABYLON, map, 128, scene, true);
    cube.sphericalPolynomial = new BABYLON.SphericalPolynomial();
    await new BABYLON.HDRFiltering(scene.getEngine(), { quality: BABYLON.Constants.TEXTURE_FILTERING_QUALITY_HIGH }).prefilter(cube);
    return cube;
}

/** A box around everything that shows the sky. */
function skyBox(BABYLON, map, scene, extent) {
    const box = BABYLON.MeshBuilder.CreateBox('sky', { size: 10 * extent, sideOrientation: BABYLON.Mesh.BACKSIDE }, scene);
    const material = new BABYLON.BackgroundMaterial('sky', scene);
    material.reflectionTexture = cubeTexture(BABYLON, map, map.height > 256 ? 512 : 128, scene, false);
    material.reflectionTexture.coordinatesMode = BABYLON.Texture.SKYBOX_MODE;
    Object.assign(material, { enableNoise: false, useRGBColor: false });
    Object.assign(box, { material, infiniteDistance: true, isPickable: false, ignoreCameraMaxZ: true });
    return box;
}

const kSunTexels = 4096, kLampTexels = 1024; // of shadow maps, along a side
const kShadows = 6; // each takes one of a shader's 16 textures

/** Materials of sheets that were exported as two surfaces, which are primitives of one node. */
function twoSided(meshes) {
    const isPart = (mesh) => /_primitive\d+$/.test(mesh.name), seen = new Set(), found = new Set();
    for (const { parent, material } of meshes.filter(isPart)) {
        const key = `${parent.uniqueId} ${material?.uniqueId}`;
        if (seen.has(key)) found.add(material);
        seen.add(key);
    }
    return found;
}

/**
 * Lets the suns and the strongest other lamps cast shadows of the meshes. A shadow map shows backs, too, as light is blocked in Limn, but
 * not the backs of sheets, whose bias would put them before their fronts.
 */
function castShadows(BABYLON, lights, meshes, extent) {
    const isSun = (light) => light instanceof BABYLON.DirectionalLight;
    const lamps = lights.filter((light) => light instanceof BABYLON.ShadowLight).sort((a, b) => Number(isSun(b)) - Number(isSun(a)) || b.intensity - a.intensity).slice(0, kShadows);
    const sheets = twoSided(meshes), materials = new Set(meshes.map((m) => m.material).filter((m) => m?.backFaceCulling && !sheets.has(m)));
    return lamps.map((light) => {
        const texels = isSun(light) ? kSunTexels : kLampTexels, shadows = new BABYLON.ShadowGenerator(texels, light, true);
        Object.assign(light, isSun(light) ? { autoCalcShadowZBounds: true } : { shadowMinZ: 1e-3 * extent, shadowMaxZ: 2 * extent });
        shadows.usePercentageCloserFiltering = !(light instanceof BABYLON.PointLight); // cubes know none
        shadows.bias = isSun(light) ? 1e-4 : 1e-3;
        shadows.normalBias = 2 * extent / texels;
        const map = shadows.getShadowMap(), cull = (on) => { for (const m of materials) m._backFaceCulling = on; };
        map.renderList = meshes.filter((m) => m.material && !(m.material.alpha < 0.5) && !m.material.subSurface?.isRefractionEnabled);
        map.onBeforeRenderObservable.add(() => cull(false));
        map.onAfterRenderObservable.add(() => cull(true));
        return shadows;
    });
}

/** A cube texture that carries only the probe's irradiance. `probe`: as written for the scene's handedness. */
function environment(BABYLON, probe, scene) {
    const black = Array.from({ length: 6 }, () => new Uint8Array(4));
    const cube = new BABYLON.RawCubeTexture(scene, black, 1, BABYLON.Constants.TEXTUREFORMAT_RGBA,
        BABYLON.Constants.TEXTURETYPE_UNSIGNED_BYTE, false);
    const harmonics = BABYLON.SphericalHarmonics.FromArray(probe);
    harmonics.convertIncidentRadianceToIrradiance();
    harmonics.convertIrradianceToLambertianRadiance();
    cube.sphericalPolynomial = BABYLON.SphericalPolynomial.FromHarmonics(harmonics);
    return cube;
}

/** Number of the panorama that a mesh mirrors. A node of several primitives is their parent. */
const reflectionOf = (mesh) => mesh.metadata?.gltf?.extras?.limn?.reflection ?? mesh.parent?.metadata?.gltf?.extras?.limn?.reflection ?? 0;

/** Imports the glTF file at `url` with its light; resolves to the importer's result, lightmaps, environment, reflections, sky and shadows. */
export async function loadLimn(BABYLON, url, scene, { shadows = true } = {}) {
    const address = new URL(url, document.baseURI);
    const limn = (await (await fetch(address)).json()).asset.extras.limn;
    const texels = async (uri) => readKtx2(await (await fetch(new URL(uri, address))).arrayBuffer());
    const uris = limn.lightmap ? limn.lightmap.uris ?? [limn.lightmap.uri] : [];
    const lightmaps = await Promise.all(uris.map(async (uri) => lightmapTexture(BABYLON, await texels(uri), scene)));
    const probe = limn.probe && limn.probe[scene.useRightHandedSystem ? 'rightHanded' : 'leftHanded'];
    const cube = probe ? environment(BABYLON, probe, scene) : null;
    const reflections = await Promise.all((limn.reflections ?? [])
        .map(async ({ uri }) => reflection(BABYLON, panorama(BABYLON, await texels(uri)), scene)));
    const imported = await BABYLON.SceneLoader.ImportMeshAsync('', new URL('.', address).href, address.pathname.split('/').pop(), scene);
    const factor = limn.lightmap && { irradiance: 1 / Math.PI, 'irradiance-over-pi': 1 }[limn.lightmap.quantity];
    const { min, max } = imported.meshes[0].getHierarchyBoundingVectors(), extent = max.subtract(min).length();
    const lights = limn.lightmap?.includesDirectLight ? [] : imported.lights, copies = new Map();
    if (limn.lightmap?.includesDirectLight) for (const light of imported.lights) light.setEnabled(false);
    for (const mesh of imported.meshes) {
        const material = mesh.material, number = reflectionOf(mesh), key = `${material?.uniqueId} ${number}`;
        if (!material || material.lightmapTexture) continue;
        material.maxSimultaneousLights = Math.max(4, Math.min(lights.length, 12));
        if (lightmaps.length > 0 && mesh.isVerticesDataPresent(BABYLON.VertexBuffer.UV2Kind)) {
            if (!copies.has(key)) {
                const copy = material.clone(material.name);
                copy.lightmapTexture = lightmaps[material.metadata?.gltf?.extras?.limn?.lightmapPage ?? 0];
                copy.reflectionTexture = reflections[number] ?? null;
                if (factor) multiplyByAlbedo(BABYLON, copy, factor);
                copies.set(key, copy);
            }
            mesh.material = copies.get(key);
        } else if (cube) {
            material.reflectionTexture = cube;
        }
        mesh.receiveShadows = shadows;
    }
    const generators = shadows ? castShadows(BABYLON, lights, imported.meshes, extent) : [];
    const sky = limn.sky ? skyBox(BABYLON, panorama(BABYLON, await texels(limn.sky.uri)), scene, extent) : null;
    return { ...imported, lightmaps, environment: cube, reflections, sky, shadows: generators };
}

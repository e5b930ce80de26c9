// SPDX-License-Identifier: MIT
// Shows a scene that Limn exported for Babylon.js, in left- and right-handed scenes.
//
//     import { loadLimn } from './ROOM-babylon.js';
//     await loadLimn(BABYLON, 'ROOM.gltf', scene);
//
// Babylon.js adds a lightmap to what the lights do, without the albedo. A lightmap of irradiance is therefore multiplied by a change to the
// shader; one of radiance, exported with "--quantity radiance", includes the albedo and needs no change, but is as coarse as its texels.
// Materials without a lightmap get the mean light of the scene's grid as their environment.

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

/** Makes the material multiply its lightmap by its albedo and `factor`. */
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
            const sum = `finalColor.rgb+=lightmapColor.rgb*surfaceAlbedo.rgb*${factor.toFixed(9)};`;
            return type === 'fragment' ? { '!finalColor\\.rgb\\s*\\+=\\s*lightmapColor\\.rgb\\s*;': sum } : null;
        }
    }
    return new LimnLightmap();
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

/** Imports the glTF file at `url` with its light; resolves to the importer's result, lightmaps and environment. */
export async function loadLimn(BABYLON, url, scene) {
    const address = new URL(url, document.baseURI);
    const limn = (await (await fetch(address)).json()).asset.extras.limn;
    const beside = async (uri) => (await fetch(new URL(uri, address))).arrayBuffer();
    const uris = limn.lightmap ? limn.lightmap.uris ?? [limn.lightmap.uri] : [];
    const lightmaps = await Promise.all(uris.map(async (uri) => lightmapTexture(BABYLON, readKtx2(await beside(uri)), scene)));
    const probe = limn.probe && limn.probe[scene.useRightHandedSystem ? 'rightHanded' : 'leftHanded'];
    const cube = probe ? environment(BABYLON, probe, scene) : null;
    const imported = await BABYLON.SceneLoader.ImportMeshAsync('', new URL('.', address).href, address.pathname.split('/').pop(), scene);
    const factor = limn.lightmap && { irradiance: 1 / Math.PI, 'irradiance-over-pi': 1 }[limn.lightmap.quantity];
    const copies = new Map();
    for (const mesh of imported.meshes) {
        const material = mesh.material;
        if (!material || material.lightmapTexture) continue;
        if (lightmaps.length > 0 && mesh.isVerticesDataPresent(BABYLON.VertexBuffer.UV2Kind)) {
            if (!copies.has(material)) {
                const copy = material.clone(material.name);
                copy.lightmapTexture = lightmaps[material.metadata?.gltf?.extras?.limn?.lightmapPage ?? 0];
                if (factor) multiplyByAlbedo(BABYLON, copy, factor);
                copies.set(material, copy);
            }
            mesh.material = copies.get(material);
        } else if (cube) {
            material.reflectionTexture = cube;
        }
    }
    return { ...imported, lightmaps, environment: cube };
}

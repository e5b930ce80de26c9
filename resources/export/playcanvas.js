// SPDX-License-Identifier: MIT
// Shows a scene that Limn exported for PlayCanvas.
//
//     import { loadLimn } from './ROOM-playcanvas.js';
//     const room = await loadLimn(pc, app, 'ROOM.gltf');
//     app.root.addChild(room.entity);
//     app.scene.skybox = room.sky;
//
// The lightmap holds irradiance / pi, which PlayCanvas multiplies by the albedo. Materials without a lightmap get the mean light of
// the scene's grid as their ambientSH. Metal reflects panoramas of the scene. The lights of the glTF file are live and cast shadows,
// unless the lightmap has their light; { shadows: false } as the last argument draws none.

function lightMapTexture(pc, device, file) {
    const clamp = pc.ADDRESS_CLAMP_TO_EDGE, linear = pc.FILTER_LINEAR;
    return new pc.Texture(device, {
        width: file.width, height: file.height, format: file.half ? pc.PIXELFORMAT_RGBA16F : pc.PIXELFORMAT_RGBA32F,
        mipmaps: false, minFilter: linear, magFilter: linear, addressU: clamp, addressV: clamp, levels: [file.data],
    });
}

/** A panorama whose middle faces +X, as PlayCanvas wants them: a quarter further to the left. */
function panoramaTexture(pc, device, { width, height, half, data }) {
    const turned = new data.constructor(data.length), row = 4 * width, quarter = width; // a quarter of a row
    for (let begin = 0; begin < data.length; begin += row) {
        turned.set(data.subarray(begin + quarter, begin + row), begin);
        turned.set(data.subarray(begin, begin + quarter), begin + row - quarter);
    }
    return new pc.Texture(device, {
        width, height, format: half ? pc.PIXELFORMAT_RGBA16F : pc.PIXELFORMAT_RGBA32F, projection: pc.TEXTUREPROJECTION_EQUIRECT,
        mipmaps: false, minFilter: pc.FILTER_LINEAR, magFilter: pc.FILTER_LINEAR, addressU: pc.ADDRESS_REPEAT,
        addressV: pc.ADDRESS_CLAMP_TO_EDGE, levels: [turned],
    });
}

/** A texture of an image that `make` draws and that the panorama is no longer needed for. */
function madeOf(panorama, make) {
    const texture = make(panorama);
    panorama.destroy();
    return texture;
}

/** Gives the lamp what glTF says. A lamp of PlayCanvas counts 1 where the irradiance is pi, and reads its colour as gamma-encoded. */
function setStrength(pc, { intensity = 1, color = [1, 1, 1] }, light) {
    const linear = color.map((c) => c * intensity / Math.PI), most = Math.max(...linear, 1);
    light.color = new pc.Color().gamma(new pc.Color(...linear.map((c) => c / most)));
    light.intensity = most;
    light.enabled = true;
}

/**
 * Lets lamps fall off with the square of the distance, to which PlayCanvas adds 1 m^2, and a lightmap be mirrored, too: the smoother the
 * material, the more it mirrors of its panorama instead.
 */
function changeShader(pc, device, material) {
    for (const [language, vec4] of [[pc.SHADERLANGUAGE_GLSL, 'vec4'], [pc.SHADERLANGUAGE_WGSL, 'vec4f']]) {
        const common = pc.ShaderChunks.get(device, language), own = material.getShaderChunks(language), sum = 'addReflection(dReflDirW, litArgs_gloss);';
        own.set('falloffInvSquaredPS', common.get('falloffInvSquaredPS').replace('(sqrDist + 1.0)', 'max(sqrDist, 0.0001)').replace('16.0', '1.0'));
        own.set('litForwardBackendPS', common.get('litForwardBackendPS').replace(sum, `${sum}
#ifdef LIT_LIGHTMAP
    dReflection = ${vec4}(mix(dReflection.rgb, litArgs_lightmap, 1.0 - litArgs_gloss), dReflection.a);
#endif`));
    }
}

const kSunTexels = 4096, kLampTexels = 1024; // of shadow maps, along a side

function castShadows(pc, entity, extent) {
    for (const light of entity.findComponents('light')) {
        const isSun = light.type === 'directional';
        Object.assign(light, { castShadows: true, shadowResolution: isSun ? kSunTexels : kLampTexels, shadowDistance: 2 * extent,
            shadowBias: 0.05, normalOffsetBias: 0.02 });
        if (!isSun) light.range = Math.min(light.range, 2 * extent); // as far as a shadow map reaches
    }
}

/** Diagonal of the box around the entity. */
function extentOf(pc, entity) {
    const box = new pc.BoundingBox();
    entity.findComponents('render').flatMap((r) => r.meshInstances).forEach((m, k) => (k > 0 ? box.add(m.aabb) : box.copy(m.aabb)));
    return 2 * box.halfExtents.length();
}

/** An entity with the glTF file at `url`, the textures of its lightmap, the probe, a Float32Array or null, and the sky's cube map or null. */
export async function loadLimn(pc, app, url, { shadows = true } = {}) {
    const address = new URL(url, document.baseURI);
    const gltf = await (await fetch(address)).json(), limn = gltf.asset.extras.limn;
    const device = app.graphicsDevice, texels = async (uri) => readKtx2(await (await fetch(new URL(uri, address))).arrayBuffer());
    const uris = limn.lightmap ? limn.lightmap.uris ?? [limn.lightmap.uri] : [];
    const lightMaps = await Promise.all(uris.map(async (uri) => lightMapTexture(pc, device, await texels(uri))));
    const panoramas = await Promise.all((limn.reflections ?? []).map(async ({ uri }) => panoramaTexture(pc, device, await texels(uri))));
    const reflections = panoramas.map((panorama) => madeOf(panorama, (source) => pc.EnvLighting.generateAtlas(source)));
    const sky = limn.sky ? madeOf(panoramaTexture(pc, device, await texels(limn.sky.uri)), (source) => pc.EnvLighting.generateSkyboxCubemap(source, 512)) : null;
    const probe = limn.probe ? new Float32Array(limn.probe.ambientSH.flat()) : null;
    const postprocess = (light, lamp) => setStrength(pc, light, lamp.light);
    const asset = new pc.Asset(address.pathname.split('/').pop(), 'container', { url: address.href }, {}, { light: { postprocess } });
    app.assets.add(asset);
    await new Promise((resolve, reject) => {
        asset.once('load', resolve);
        asset.once('error', (error) => reject(new Error(error)));
        app.assets.load(asset);
    });
    const entity = asset.resource.instantiateRenderEntity(), dark = new Float32Array(27);
    const reflectionOf = new Map(); // by the node's entity, which has the node's name
    gltf.nodes.forEach((node) => reflectionOf.set(node.name, node.extras?.limn?.reflection ?? 0));
    const pageOf = (material) => { // the container's materials are those of the file, in its order
        const index = asset.resource.materials.findIndex((m) => m.resource === material);
        return gltf.materials[index]?.extras?.limn?.lightmapPage ?? 0;
    };
    const copies = new Map();
    for (const render of entity.findComponents('render')) {
        for (const instance of render.meshInstances) {
            const hasMap = lightMaps.length > 0 && instance.mesh.vertexBuffer.format.elements.some((e) => e.name === pc.SEMANTIC_TEXCOORD1);
            const reflection = reflectionOf.get(render.entity.name) ?? 0, key = `${instance.material.id} ${hasMap} ${reflection}`;
            if (!copies.has(key)) {
                const copy = instance.material.clone();
                const lightMap = lightMaps[pageOf(instance.material)];
                copy.useSkybox = false;
                changeShader(pc, device, copy);
                if (hasMap) Object.assign(copy, { lightMap, lightMapUv: 1, lightMapChannel: 'rgb', ambientSH: dark });
                else if (probe) copy.ambientSH = probe;
                if (reflections.length > 0) copy.envAtlas = reflections[reflection];
                copy.update();
                copies.set(key, copy);
            }
            instance.material = copies.get(key);
        }
    }
    if (limn.lightmap?.includesDirectLight) for (const light of entity.findComponents('light')) light.enabled = false;
    else if (shadows) castShadows(pc, entity, extentOf(pc, entity));
    return { entity, asset, lightMaps, reflections, probe, sky };
}

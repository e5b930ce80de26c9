// SPDX-License-Identifier: MIT
// Shows a scene that Limn exported for PlayCanvas.
//
//     import { loadLimn } from './ROOM-playcanvas.js';
//     const room = await loadLimn(pc, app, 'ROOM.gltf');
//     app.root.addChild(room.entity);
//
// The lightmap holds irradiance / pi, which PlayCanvas multiplies by the albedo. Materials without a lightmap get the mean light of
// the scene's grid as their ambientSH.

function lightMapTexture(pc, device, file) {
    const clamp = pc.ADDRESS_CLAMP_TO_EDGE, linear = pc.FILTER_LINEAR;
    return new pc.Texture(device, {
        width: file.width, height: file.height, format: file.half ? pc.PIXELFORMAT_RGBA16F : pc.PIXELFORMAT_RGBA32F,
        mipmaps: false, minFilter: linear, magFilter: linear, addressU: clamp, addressV: clamp, levels: [file.data],
    });
}

/** An entity with the glTF file at `url`, the textures of its lightmap, and the probe, a Float32Array or null. */
export async function loadLimn(pc, app, url) {
    const address = new URL(url, document.baseURI);
    const gltf = await (await fetch(address)).json(), limn = gltf.asset.extras.limn;
    const beside = async (uri) => (await fetch(new URL(uri, address))).arrayBuffer();
    const uris = limn.lightmap ? limn.lightmap.uris ?? [limn.lightmap.uri] : [];
    const lightMaps = await Promise.all(uris.map(async (uri) => lightMapTexture(pc, app.graphicsDevice, readKtx2(await beside(uri)))));
    const probe = limn.probe ? new Float32Array(limn.probe.ambientSH.flat()) : null;
    const asset = await new Promise((resolve, reject) => app.assets.loadFromUrl(address.href, 'container',
        (error, loaded) => (error ? reject(new Error(error)) : resolve(loaded))));
    const entity = asset.resource.instantiateRenderEntity();
    const pageOf = (material) => { // the container's materials are those of the file, in its order
        const index = asset.resource.materials.findIndex((m) => m.resource === material);
        return gltf.materials[index]?.extras?.limn?.lightmapPage ?? 0;
    };
    const copies = new Map();
    for (const render of entity.findComponents('render')) {
        for (const instance of render.meshInstances) {
            const hasMap = lightMaps.length > 0 && instance.mesh.vertexBuffer.format.elements.some((e) => e.name === pc.SEMANTIC_TEXCOORD1);
            const key = `${instance.material.id} ${hasMap}`;
            if (!copies.has(key)) {
                const copy = instance.material.clone();
                const lightMap = lightMaps[pageOf(instance.material)];
                if (hasMap) Object.assign(copy, { lightMap, lightMapUv: 1, lightMapChannel: 'rgb' });
                else if (probe) copy.ambientSH = probe;
                copy.update();
                copies.set(key, copy);
            }
            instance.material = copies.get(key);
        }
    }
    return { entity, asset, lightMaps, probe };
}

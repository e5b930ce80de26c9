// Shows a scene that Limn exported for three.js.
//
//     import { loadLimn } from './ROOM-three.js';
//     const { scene: room, grid } = await loadLimn('ROOM.gltf', renderer);
//     scene.add(room);
//     if (grid) scene.add(grid); // lights what moves
//
// Surfaces with a lightmap keep their own bounced light, and the grid passes them by. The lights of the glTF file are live.
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
        .replace('#include <lights_fragment_maps>', `#include <lights_fragment_maps>
irradiance += limnIrradiance(vLightMapUv, normalize((vec4(geometryNormal, 0.0) * viewMatrix).xyz));`);
}

function black() {
    const texture = new THREE.DataTexture(new Uint8Array([0, 0, 0, 255]), 1, 1);
    texture.channel = 1;
    texture.needsUpdate = true;
    return texture;
}

/** A copy of the material that is lit by the lightmap and not by grids. */
function lit(material, map, bands) {
    const copy = material.clone();
    copy.lightMap = bands > 1 ? black() : map;
    copy.lightMapIntensity = 1;
    copy.onBeforeCompile = (shader) => {
        const chunk = THREE.ShaderChunk.lights_fragment_begin.replace(/irradiance \+= getLightProbeGridIrradiance[^;]*;/, ';');
        shader.fragmentShader = shader.fragmentShader.replace('#include <lights_fragment_begin>', chunk);
        if (bands > 1) addHarmonics(shader, map, bands);
    };
    copy.customProgramCacheKey = () => `limn ${bands}`; // three.js cannot see what the function closes over
    return copy;
}

/** The scene of a glTF file, with the textures of its lightmap, and the grid, which is null where there is none. */
export async function loadLimn(url, renderer) {
    const gltf = await new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).loadAsync(url);
    const limn = gltf.asset.extras.limn;
    const uris = limn.lightmap ? limn.lightmap.uris ?? [limn.lightmap.uri] : [];
    const lightMaps = await Promise.all(uris.map((uri) => lightMap(beside(uri, url), renderer)));
    const copies = new Map();
    gltf.scene.traverse((object) => {
        if (!object.isMesh || !object.geometry.attributes.uv1 || lightMaps.length === 0) return;
        const material = object.material, page = material.userData.limn?.lightmapPage ?? 0;
        if (!copies.has(material)) copies.set(material, lit(material, lightMaps[page], limn.lightmap.bands ?? 1));
        object.material = copies.get(material);
    });
    const grid = limn.grid ? await loadLimnGrid(beside(limn.grid.uri, url), renderer) : null;
    return { scene: gltf.scene, gltf, lightMaps, grid };
}

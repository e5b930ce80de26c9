// SPDX-License-Identifier: MIT
// Shadow maps of any number of lamps, in the layers of two textures: one for lamps that have a place, one for suns. Maps become
// smaller where there are many, so that they take 64 MiB of each texture.
import * as THREE from 'three';

export const kMaxLayers = 256; // WebGL 2 has as many
const kNear = [[0, 1], [2, 1024], [10, 512], [42, 256], [170, 128], [kMaxLayers, 64]]; // lamps at most, texels of a cube face's side
const kSuns = [[0, 1], [1, 2048], [4, 2048], [16, 1024], [64, 512], [kMaxLayers, 256]];
const kFaces = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];

/** What casts shadows, drawn as depth: as the distance to `eye` in units of its w, or the camera's depth where w is 0. */
export class Casters {
  constructor() {
    this.scene = new THREE.Scene();
    this.eye = { value: new THREE.Vector4() };
    this.materials = new Map(); // by texture
    this.added = new Map(); // by positions
  }

  /** Textures with holes let light through where their alpha is below the cutoff. */
  material(of) {
    const cutoff = of.alphaTest > 0 ? of.alphaTest : of.transparent ? 0.5 : 0, key = cutoff > 0 && of.map ? of.map.uuid + cutoff : '';
    if (!this.materials.has(key)) this.materials.set(key, new THREE.ShaderMaterial({
      side: THREE.DoubleSide,
      uniforms: { eye: this.eye, map: { value: key ? of.map : null }, turn: { value: key ? of.map.matrix : new THREE.Matrix3() },
        cutoff: { value: cutoff / Math.max(of.opacity, 1e-3) } },
      defines: key ? { HOLES: '', MAP_UV: of.map.channel > 0 ? `uv${of.map.channel}` : 'uv' } : {},
      vertexShader: `
        varying vec3 place;
        #ifdef HOLES
        uniform mat3 turn;
        varying vec2 mapUv;
        #endif
        void main() {
          vec4 world = modelMatrix * vec4(position, 1.0);
          place = world.xyz;
          #ifdef HOLES
          mapUv = (turn * vec3(MAP_UV, 1.0)).xy;
          #endif
          gl_Position = projectionMatrix * viewMatrix * world;
        }`,
      fragmentShader: `
        uniform vec4 eye;
        varying vec3 place;
        #ifdef HOLES
        uniform sampler2D map;
        uniform float cutoff;
        varying vec2 mapUv;
        #endif
        void main() {
          #ifdef HOLES
          if (texture2D(map, mapUv).a < cutoff) discard;
          #endif
          float depth = eye.w > 0.0 ? distance(place, eye.xyz) / eye.w : gl_FragCoord.z;
          vec4 bytes = fract(min(depth, 0.9999) * vec4(1.0, 255.0, 65025.0, 16581375.0));
          gl_FragColor = bytes - bytes.yzww * vec4(1.0 / 255.0, 1.0 / 255.0, 1.0 / 255.0, 0.0);
        }`,
    }));
    return this.materials.get(key);
  }

  /** A surface with two sides is two meshes of the same triangles, of which one casts the shadow. */
  add(mesh) {
    const { position } = mesh.geometry.attributes, others = this.added.get(position) ?? [];
    this.added.set(position, [...others, mesh]);
    if (others.some((o) => o.geometry.index?.count === mesh.geometry.index?.count && o.matrixWorld.equals(mesh.matrixWorld))) return;
    const caster = new THREE.Mesh(mesh.geometry, this.material(mesh.material));
    caster.matrixAutoUpdate = false;
    caster.matrixWorldAutoUpdate = false;
    caster.matrixWorld.copy(mesh.matrixWorld);
    this.scene.add(caster);
  }
}

/** A texture with a layer of shadow maps for each lamp. */
class Layers {
  constructor(sizes, width, height) {
    Object.assign(this, { sizes, width, height, capacity: -1, texels: 1, target: null });
    this.texture = { value: null };
    this.reserve(0);
  }
  /** Makes room for `count` lamps. Returns whether all maps must be drawn again. */
  reserve(count) {
    const [capacity, texels] = this.sizes.find(([most]) => count <= most) ?? this.sizes.at(-1);
    if (capacity === this.capacity) return false;
    this.target?.dispose();
    this.target = new THREE.WebGLArrayRenderTarget(this.width * texels, this.height * texels, Math.max(capacity, 1), {
      minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter, generateMipmaps: false, depthBuffer: true });
    this.target.scissorTest = true;
    this.texture.value = this.target.texture;
    Object.assign(this, { capacity, texels });
    return true;
  }
}

export class ShadowMaps {
  /** `extent` [m] is the longest way across the scene, `centre` its middle. */
  constructor(renderer, casters, centre, extent) {
    Object.assign(this, { renderer, casters, centre, extent, far: 4 * extent });
    this.near = new Layers(kNear, 3, 2);
    this.suns = new Layers(kSuns, 1, 1);
    this.perspective = new THREE.PerspectiveCamera(90, 1, 1e-3 * extent, this.far);
    this.parallel = new THREE.OrthographicCamera(-extent / 2, extent / 2, extent / 2, -extent / 2, 0, 2 * extent);
  }

  /** Draws one map into a part of a layer and returns the camera's matrix. */
  draw(layers, layer, x, y, size, camera, from, along, eyeW) {
    const { renderer, casters } = this, { target } = layers;
    camera.up.set(0, Math.abs(along.y) > 0.999 ? 0 : 1, Math.abs(along.y) > 0.999 ? 1 : 0);
    camera.position.copy(from);
    camera.lookAt(from.clone().add(along));
    camera.updateMatrixWorld();
    camera.updateProjectionMatrix();
    casters.eye.value.set(from.x, from.y, from.z, eyeW);
    target.viewport.set(x, y, size, size);
    target.scissor.set(x, y, size, size);
    const color = renderer.getClearColor(new THREE.Color()), alpha = renderer.getClearAlpha();
    renderer.setClearColor(0xffffff, 1);
    renderer.setRenderTarget(target, layer);
    renderer.render(casters.scene, camera);
    renderer.setRenderTarget(null);
    renderer.setClearColor(color, alpha);
    return new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
  }

  /** `s`: texels of a cube face's side, at most those of `near`. */
  point(layer, position, s) {
    this.perspective.fov = 90;
    kFaces.forEach((face, f) =>
      this.draw(this.near, layer, s * (f % 3), s * Math.floor(f / 3), s, this.perspective, position, new THREE.Vector3(...face), this.far));
  }
  spot(layer, position, along, outerAngle, s) {
    this.perspective.fov = Math.min(2 * outerAngle * 180 / Math.PI + 1, 175);
    return this.draw(this.near, layer, 0, 0, 2 * s, this.perspective, position, along, this.far);
  }
  sun(layer, along) {
    return this.draw(this.suns, layer, 0, 0, this.suns.texels, this.parallel, this.centre.clone().addScaledVector(along, -this.extent), along, 0);
  }
}

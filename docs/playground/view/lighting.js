// Lights, surfaces and sky. Surfaces are lit a vertex rather than a pixel, in the colours as they are given, as MuJoCo's
// own fixed pipeline does: that is cheap, which is what a machine without a graphics card needs.

import * as THREE from "three";

/** @import {Light, Texture} from "../engine/assets.js" */

THREE.ColorManagement.enabled = false;

const MAX_LIGHTS = 6;
const VERTEX = `
  uniform vec3 ambient;
  uniform vec3 diffuse[${MAX_LIGHTS}];
  uniform vec3 place[${MAX_LIGHTS}];
  uniform vec3 aim[${MAX_LIGHTS}];
  uniform vec3 cone[${MAX_LIGHTS}]; // whether it is a spot, cosine of its half angle, exponent
  uniform vec2 repeat;
  varying vec3 vColor;
  varying vec2 vUv;
  void main() {
    vec4 world = instanceMatrix * vec4(position, 1.0);
    mat3 turn = mat3(instanceMatrix);
    vec3 squares = vec3(dot(turn[0], turn[0]), dot(turn[1], turn[1]), dot(turn[2], turn[2]));
    vec3 up = normalize(turn * (normal / squares));
    if (dot(up, cameraPosition - world.xyz) < 0.0 && TWO_SIDED) up = -up;
    vec3 light = ambient;
    for (int i = 0; i < ${MAX_LIGHTS}; i++) {
      vec3 towards = cone[i].x > 0.5 ? normalize(place[i] - world.xyz) : -aim[i];
      float share = max(dot(up, towards), 0.0);
      if (cone[i].x > 0.5) {
        float inside = dot(-towards, aim[i]);
        share *= inside < cone[i].y ? 0.0 : pow(inside, cone[i].z);
      }
      light += share * diffuse[i];
    }
    vColor = min(instanceColor * light, 1.0);
    vUv = uv * repeat;
    gl_Position = projectionMatrix * viewMatrix * world;
  }`;
const FRAGMENT = `
  uniform float opacity;
  uniform sampler2D map;
  varying vec3 vColor;
  varying vec2 vUv;
  void main() {
    vec3 color = vColor;
    #ifdef TEXTURED
    color *= texture2D(map, vUv).rgb;
    #endif
    gl_FragColor = vec4(color, opacity);
  }`;

/** The lights of a scene, shared by all its surfaces. */
export class Lights {
  constructor() {
    const vectors = () => Array.from({ length: MAX_LIGHTS }, () => new THREE.Vector3());
    this.uniforms = {
      ambient: { value: new THREE.Vector3() },
      diffuse: { value: vectors() },
      place: { value: vectors() },
      aim: { value: vectors() },
      cone: { value: vectors() },
    };
    this.head = -1;
  }

  /**
   * Takes over the model's lights.
   * @param {Light[]} lights
   */
  load(lights) {
    const { ambient, diffuse, place, aim, cone } = this.uniforms;
    ambient.value.set(0, 0, 0);
    for (let i = 0; i < MAX_LIGHTS; i++) {
      const light = lights[i];
      diffuse.value[i].fromArray(light?.diffuse ?? [0, 0, 0]);
      if (!light) continue;
      ambient.value.add(new THREE.Vector3(...light.ambient));
      place.value[i].fromArray(light.pos);
      aim.value[i].fromArray(light.dir).normalize();
      const spot = !light.directional && !light.head;
      cone.value[i].set(Number(spot), Math.cos((light.cutoff * Math.PI) / 180), light.exponent);
    }
    this.head = lights.slice(0, MAX_LIGHTS).findIndex(({ head }) => head);
  }

  /**
   * Points the headlight where the camera looks.
   * @param {THREE.Vector3} ahead
   */
  aimHeadlight(ahead) {
    if (this.head >= 0) this.uniforms.aim.value[this.head].copy(ahead);
  }

  /**
   * A material for instances that these lights shine on.
   * @param {{opacity: number, twoSided: boolean, map: THREE.Texture | null, repeat: [number, number]}} look
   */
  material({ opacity, twoSided, map, repeat }) {
    return new THREE.ShaderMaterial({
      uniforms: { ...this.uniforms, opacity: { value: opacity }, map: { value: map }, repeat: { value: new THREE.Vector2(...repeat) } },
      defines: { TWO_SIDED: String(twoSided), ...(map ? { TEXTURED: "" } : {}) },
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      transparent: opacity < 1,
      depthWrite: opacity === 1,
      side: twoSided ? THREE.DoubleSide : THREE.FrontSide,
    });
  }
}

/**
 * A texture that repeats.
 * @param {Texture} texture
 */
export function dataTexture({ rgba, width, height }) {
  const made = new THREE.DataTexture(rgba, width, height);
  made.wrapS = made.wrapT = THREE.RepeatWrapping;
  made.magFilter = THREE.LinearFilter;
  made.minFilter = THREE.LinearMipmapNearestFilter;
  made.generateMipmaps = true;
  made.needsUpdate = true;
  return made;
}

/**
 * A sphere around everything in the colours of a skybox, which come as six square faces in a column: right, left, up,
 * down, front, back, with y up. Colours are taken at the sphere's vertices, which is exact for a gradient.
 * @param {Texture} texture
 */
export function sky({ rgba, width }) {
  const geometry = new THREE.SphereGeometry(1, 16, 12).rotateX(Math.PI / 2);
  const { position } = geometry.attributes;
  const colours = new Float32Array(3 * position.count);
  for (let i = 0; i < position.count; i++) {
    const [x, y, z] = [position.getX(i), position.getZ(i), -position.getY(i)];
    const size = Math.max(Math.abs(x), Math.abs(y), Math.abs(z));
    const [face, u, v] =
      size === Math.abs(x) ? [x > 0 ? 0 : 1, x > 0 ? -z : z, -y] : size === Math.abs(y) ? [y > 0 ? 2 : 3, x, y > 0 ? z : -z] : [z > 0 ? 4 : 5, z > 0 ? x : -x, -y];
    const pixel = (/** @type {number} */ w) => Math.min(width - 1, Math.floor(((w / size + 1) / 2) * width));
    const at = 4 * ((face * width + pixel(v)) * width + pixel(u));
    colours.set([rgba[at] / 255, rgba[at + 1] / 255, rgba[at + 2] / 255], 3 * i);
  }
  geometry.setAttribute("color", new THREE.BufferAttribute(colours, 3));
  const material = new THREE.ShaderMaterial({
    vertexShader: `
      attribute vec3 color;
      varying vec3 vColor;
      void main() {
        vColor = color;
        gl_Position = (projectionMatrix * vec4(mat3(viewMatrix) * position, 1.0)).xyww;
      }`,
    fragmentShader: "varying vec3 vColor; void main() { gl_FragColor = vec4(vColor, 1.0); }",
    side: THREE.BackSide,
    depthWrite: false,
  });
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = 1;
  return mesh;
}

// The geometries that instances are made of: unit shapes about the z axis, and the model's meshes and height fields.

import * as THREE from "three";

/** @import {Assets, Shape} from "../engine/assets.js" */

const ROUND = 24; // segments about an axis
const HEAD_WIDTH = 1.75; // of an arrow, in widths of its shaft

/**
 * The geometries by the names that `Scene` draws them by.
 * @param {Assets} assets
 * @returns {Map<string, THREE.BufferGeometry>}
 */
export function geometries({ meshes, hulls, fields }) {
  const alongZ = (/** @type {THREE.BufferGeometry} */ made) => made.rotateX(Math.PI / 2);
  const made = new Map([
    ["plane", new THREE.PlaneGeometry(2, 2, 12, 12)],
    ["box", new THREE.BoxGeometry(2, 2, 2)],
    ["sphere", alongZ(new THREE.SphereGeometry(1, ROUND, ROUND / 2))],
    ["cap", alongZ(new THREE.SphereGeometry(1, ROUND, ROUND / 4, 0, 2 * Math.PI, 0, Math.PI / 2))],
    ["tube", alongZ(new THREE.CylinderGeometry(1, 1, 2, ROUND, 1, true))],
    ["cylinder", alongZ(new THREE.CylinderGeometry(1, 1, 2, ROUND))],
    ["cone", alongZ(new THREE.ConeGeometry(1, 2, ROUND))],
  ]);
  meshes.forEach((shape, i) => made.set(`mesh-${i}`, geometry(shape)));
  hulls.forEach((shape, i) => shape && made.set(`hull-${i}`, geometry(shape)));
  fields.forEach((shape, i) => made.set(`field-${i}`, geometry(shape)));
  return made;
}

/**
 * The parts of an arrow that starts at the geom's centre and points along its z axis, as MuJoCo draws them: its size is
 * twice the length, a third of the length is the head.
 * @param {number} radius
 * @param {number} size
 * @param {boolean} wide whether the head is wider than the shaft
 * @returns {{shape: string, scale: number[], lift: number}[]}
 */
export function arrow(radius, size, wide) {
  const [length, head] = [size / 2, size / 6];
  const base = wide ? HEAD_WIDTH * radius : radius;
  const shaft = (length - head) / 2;
  return [
    { shape: "cylinder", scale: [radius, radius, shaft], lift: shaft },
    { shape: "cone", scale: [base, base, head / 2], lift: length - head / 2 },
  ];
}

/** @param {Shape} shape with flat faces */
function geometry({ vertices, faces }) {
  const positions = new Float32Array(3 * faces.length);
  faces.forEach((vertex, i) => positions.set(vertices.subarray(3 * vertex, 3 * vertex + 3), 3 * i));
  const made = new THREE.BufferGeometry();
  made.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  made.computeVertexNormals();
  return made;
}

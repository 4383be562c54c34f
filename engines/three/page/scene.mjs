// Builds the scene in three.js: meshes of a .glb file, a camera, and a light with its shadow's camera.
import * as THREE from "three";

import { planesOf } from "../common/planes.mjs";

/** Meshes for objects of a .glb file, with flat normals. Those that the camera does not see are on layer 1. */
export function makeMeshes(objects) {
  return objects.map(({ place, positions, normals, casts, isSeen }) => {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
    geometry.setAttribute("normal", new THREE.BufferAttribute(normals, 3));
    geometry.setAttribute("place", new THREE.BufferAttribute(new Float32Array(positions.length / 3).fill(place), 1));
    const object = new THREE.Mesh(geometry);
    object.castShadow = casts;
    object.receiveShadow = true;
    if (!isSeen) object.layers.set(1);
    return object;
  });
}

/** The camera, with planes around the visible objects. */
export function makeCamera(description, aspect, objects) {
  const { eye, target, up, vertical_fov_deg: fov, orthographic_height: height } = description;
  const { near, far } = planesOf(description, objects);
  const camera = height === undefined ? new THREE.PerspectiveCamera(fov, aspect, near, far)
    : new THREE.OrthographicCamera((-height * aspect) / 2, (height * aspect) / 2, height / 2, -height / 2, near, far);
  camera.up.set(...up);
  camera.position.set(...eye);
  camera.lookAt(...target);
  return camera;
}

/** The light; `placeShadow` places its shadow's camera. */
export function makeLight({ type, position, cone_deg: cone }) {
  if (type === "directional") return new THREE.DirectionalLight();
  if (type === "point") {
    const point = new THREE.PointLight();
    point.position.set(...position);
    return point;
  }
  const spot = new THREE.SpotLight();
  spot.angle = (cone * Math.PI) / 360;
  return spot;
}

/** Sets the size, planes and frustum of the light's shadow. */
export function placeShadow(light, { camera: placed, near, far, resolution, castShadow, radius, blurSamples }) {
  const { shadow } = light;
  light.castShadow = castShadow;
  shadow.map?.dispose();
  shadow.mapPass?.dispose();
  Object.assign(shadow, { map: null, mapPass: null, radius, blurSamples });
  shadow.mapSize.set(resolution, resolution);
  Object.assign(shadow.camera, { near, far });
  shadow.camera.layers.enableAll();
  if (placed) {
    const { left, right, top, bottom } = placed;
    light.position.set(...placed.position);
    light.target.position.set(...placed.position).add(new THREE.Vector3(...placed.forward));
    shadow.camera.up.set(...placed.up);
    if (light.isSpotLight) shadow.focus = (Math.atan(top) - Math.atan(bottom)) / (2 * light.angle);
    else Object.assign(shadow.camera, { left, right, top, bottom });
    light.target.updateMatrixWorld();
  }
  shadow.camera.updateProjectionMatrix();
  light.updateMatrixWorld();
}

// The scene as three.js has it: meshes of a .glb file, a camera, and a light with its shadow's camera.
import * as THREE from "three";

const array = { 5126: Float32Array, 5125: Uint32Array, 5123: Uint16Array };
const width = { VEC3: 3, SCALAR: 1 };

function values(gltf, blob, index) {
  const { bufferView, byteOffset = 0, componentType, count, type } = gltf.accessors[index];
  const start = (gltf.bufferViews[bufferView].byteOffset ?? 0) + byteOffset;
  return new array[componentType](blob, start, count * width[type]);
}

/**
 * The objects of a .glb file as meshes with a normal for each triangle.
 * Of those in `noCast` no shadow falls, and those in `noReceive` are on layer 1, which the camera does not see.
 */
export async function loadMeshes(address, noCast, noReceive) {
  const data = await (await fetch(address)).arrayBuffer();
  const length = new DataView(data).getUint32(12, true);
  const gltf = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 20, length)));
  const blob = data.slice(28 + length);
  return gltf.nodes.flatMap(({ name, mesh }, place) => gltf.meshes[mesh].primitives.map(({ attributes, indices }) => {
    const shared = new THREE.BufferGeometry();
    shared.setAttribute("position", new THREE.BufferAttribute(values(gltf, blob, attributes.POSITION), 3));
    shared.setIndex(new THREE.BufferAttribute(values(gltf, blob, indices), 1));
    const geometry = shared.toNonIndexed();
    geometry.computeVertexNormals();
    const count = geometry.attributes.position.count;
    geometry.setAttribute("place", new THREE.BufferAttribute(new Float32Array(count).fill(place), 1));
    const object = new THREE.Mesh(geometry);
    object.castShadow = !noCast.includes(name);
    object.receiveShadow = true;
    if (noReceive.includes(name)) object.layers.set(1);
    return object;
  }));
}

/** The camera, with planes around what it can see of the meshes. */
export function makeCamera({ eye, target, up, vertical_fov_deg: fov, orthographic_height: height }, aspect, meshes) {
  const box = new THREE.Box3();
  meshes.forEach(({ geometry }) => box.union(new THREE.Box3().setFromBufferAttribute(geometry.attributes.position)));
  const diagonal = box.getSize(new THREE.Vector3()).length();
  const far = (box.distanceToPoint(new THREE.Vector3(...eye)) + diagonal) * 1.01;
  const near = height === undefined ? diagonal * 1e-3 : -far;
  const camera = height === undefined ? new THREE.PerspectiveCamera(fov, aspect, near, far)
    : new THREE.OrthographicCamera((-height * aspect) / 2, (height * aspect) / 2, height / 2, -height / 2, near, far);
  camera.up.set(...up);
  camera.position.set(...eye);
  camera.lookAt(...target);
  return camera;
}

/** The light alone; its shadow's camera is placed by `placeShadow`. */
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

/** Gives the light's shadow its settings: bias, size, planes, and what its map covers. */
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

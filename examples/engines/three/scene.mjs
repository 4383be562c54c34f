// A courtyard at noon. The page shows it, and the gate judges it; both import this module.
import * as THREE from "three";

/** A mesh that casts and receives shadows, unlike three.js's default. */
function solid(name, geometry, material, [x, y, z]) {
  const mesh = new THREE.Mesh(geometry, material);
  mesh.name = name;
  mesh.position.set(x, y, z);
  mesh.castShadow = true;
  mesh.receiveShadow = true;
  return mesh;
}

function makeSun() {
  const sun = new THREE.DirectionalLight("white", 3);
  sun.position.set(-8, 7, 4);
  sun.castShadow = true;
  sun.shadow.mapSize.set(1024, 1024);
  Object.assign(sun.shadow.camera, { left: -9, right: 9, top: 9, bottom: -9, near: 1, far: 25 });
  sun.shadow.bias = -0.0005;
  return sun;
}

/** Creates the scene, its camera, the light whose shadows are judged, and their filter. */
export function makeProject() {
  const stone = new THREE.MeshStandardMaterial({ color: "tan", side: THREE.FrontSide });
  const scene = new THREE.Scene();
  scene.background = new THREE.Color("lightsteelblue");
  scene.add(solid("ground", new THREE.BoxGeometry(16, 0.2, 12), stone, [0, -0.1, 0]));
  scene.add(solid("wall", new THREE.BoxGeometry(10, 3, 0.3), stone, [0, 1.5, -4]));
  scene.add(solid("dome", new THREE.SphereGeometry(1.4, 48, 24), stone, [3, 1.2, 0.5]));
  scene.add(solid("ring", new THREE.TorusGeometry(1.1, 0.25, 24, 64), stone, [-0.4, 1.4, 1.6]));
  for (let i = 0; i < 6; ++i) scene.add(solid(`column ${i}`, new THREE.CylinderGeometry(0.2, 0.25, 2.6, 24), stone, [-6 + 1.1 * i, 1.3, -1.5]));
  scene.add(new THREE.AmbientLight("white", 0.4));
  const light = makeSun();
  scene.add(light, light.target);
  const camera = new THREE.PerspectiveCamera(40, 16 / 9, 0.1, 60);
  camera.position.set(5.5, 5, 9.5);
  camera.lookAt(0, 0.8, 0);
  return { scene, camera, light, shadowMapType: THREE.PCFShadowMap };
}

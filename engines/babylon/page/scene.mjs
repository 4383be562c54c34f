// The scene as Babylon.js has it: meshes, a camera, and a light with its shadow generator.
import { clipFromWorld } from "../common/light_matrix.mjs";
import { planesOf } from "../common/planes.mjs";

const B = globalThis.BABYLON;
const vector = (numbers) => new B.Vector3(...numbers);

/** Paints world position and shadow in place of a colour; the weights of PCF sum up to 1 but for a rounding. */
class Seen extends B.MaterialPluginBase {
  constructor(material) {
    super(material, "Seen", 200, {}, true, true);
  }

  getCustomCode(shaderType) {
    return shaderType === "fragment" ? { CUSTOM_FRAGMENT_BEFORE_FRAGCOLOR: "color = vec4(vPositionW, min(shadow, 1.0));" } : null;
  }
}

/** A camera that looks where it is told: Babylon.js's own turn by angles, and forget `up`. */
class GivenCamera extends B.Camera {
  constructor({ eye, target, up }, scene) {
    super("camera", vector(eye), scene);
    this.given = B.Matrix.LookAtRH(vector(eye), vector(target), vector(up));
  }

  _getViewMatrix() {
    return this.given;
  }
}

/** The standard material, white and without highlights; `noted` it paints what it knows of its shadow. */
export function makeMaterial({ backFaceCulling }, scene, isNoted) {
  const material = new B.StandardMaterial("seen", scene);
  Object.assign(material, { backFaceCulling, sideOrientation: B.Material.CounterClockWiseSideOrientation, specularColor: B.Color3.Black() });
  if (isNoted) new Seen(material);
  return material;
}

/** Meshes for objects of a .glb file. */
export function makeMeshes(objects, material, scene) {
  return objects.map(({ name, positions, normals, isSeen, casts }) => {
    const mesh = new B.Mesh(name, scene);
    const indices = Uint32Array.from({ length: positions.length / 3 }, (_, i) => i);
    Object.assign(new B.VertexData(), { positions, normals, indices }).applyToMesh(mesh);
    return Object.assign(mesh, { material, receiveShadows: true, metadata: { isSeen, casts } });
  });
}

/** The camera, with planes around what it can see of the objects. */
export function makeCamera(description, aspect, objects, scene) {
  const { vertical_fov_deg: fov, orthographic_height: height } = description;
  const { near: minZ, far: maxZ } = planesOf(description, objects);
  const camera = new GivenCamera(description, scene);
  if (height === undefined) return Object.assign(camera, { minZ, maxZ, fov: (fov * Math.PI) / 180 });
  return Object.assign(camera, { minZ, maxZ, mode: B.Camera.ORTHOGRAPHIC_CAMERA, orthoLeft: (-height * aspect) / 2,
    orthoRight: (height * aspect) / 2, orthoBottom: -height / 2, orthoTop: height / 2 });
}

/**
 * Babylon.js's projection for its own view of the light, so that the map covers what Gnomon's does. That view is left-handed:
 * its map is the mirror of Gnomon's, and the same faces are front faces as without this.
 */
function projectionBuilder(camera, near, far) {
  const [x, y, z, w] = clipFromWorld(camera, near, far);
  const rows = [x.map((value) => -value), y, z, w];
  const clip = B.Matrix.FromArray([0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column])));
  return (view, _, result) => B.Matrix.Invert(view).multiplyToRef(clip, result);
}

/** The light, where the map's camera stands. */
export function makeLight({ type, position, direction, target, cone_deg: cone }, { camera, near, far, engine: { shadowEnabled } }, scene) {
  const light = makeKind();
  Object.assign(light, { shadowMinZ: near, shadowMaxZ: far, shadowEnabled });
  if (camera) {
    light.position = vector(camera.position);
    light.customProjectionMatrixBuilder = projectionBuilder(camera, near, far);
  }
  return light;

  function makeKind() {
    if (type === "directional") return new B.DirectionalLight("light", vector(direction), scene);
    if (type === "point") return new B.PointLight("light", vector(position), scene);
    const way = vector(target).subtract(vector(position)).normalize();
    return new B.SpotLight("light", vector(position), way, (cone * Math.PI) / 180, 0, scene);
  }
}

/** The light's shadow generator, with the settings of the engine's keys. */
export function makeShadows(light, { resolution, engine }, meshes) {
  const { filter, filteringQuality, useFloat32TextureType, shadowEnabled: _, backFaceCulling: __, ...named } = engine;
  const shadows = new B.ShadowGenerator(resolution, light, useFloat32TextureType);
  Object.assign(shadows, named, { filter: B.ShadowGenerator[`FILTER_${filter}`], filteringQuality: B.ShadowGenerator[`QUALITY_${filteringQuality}`] });
  shadows.getShadowMap().renderList = meshes.filter(({ metadata }) => metadata.casts);
  return shadows;
}

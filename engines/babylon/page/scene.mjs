// Builds the scene in Babylon.js: meshes, a camera, and a light with its shadow generator.
import { clipFromWorld } from "../common/light_matrix.mjs";
import { planesOf } from "../common/planes.mjs";

const B = globalThis.BABYLON;
const vector = (numbers) => new B.Vector3(...numbers);

/** Paints world position and shadow instead of a colour. The weights of PCF sum to 1 except for rounding. */
class Seen extends B.MaterialPluginBase {
  constructor(material) {
    super(material, "Seen", 200, {}, true, true);
  }

  getCustomCode(shaderType) {
    return shaderType === "fragment" ? { CUSTOM_FRAGMENT_BEFORE_FRAGCOLOR: "color = vec4(vPositionW, min(shadow, 1.0));" } : null;
  }
}

/** A camera with a given view matrix. Babylon.js's own cameras use angles, and ignore `up`. */
class GivenCamera extends B.Camera {
  constructor({ eye, target, up }, scene) {
    super("camera", vector(eye), scene);
    this.given = B.Matrix.LookAtRH(vector(eye), vector(target), vector(up));
  }

  _getViewMatrix() {
    return this.given;
  }
}

/** The standard material, white and without highlights. If `isNoted`, it paints position and shadow. */
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

/** The camera, with planes around the visible objects. */
export function makeCamera(description, aspect, objects, scene) {
  const { vertical_fov_deg: fov, orthographic_height: height } = description;
  const { near: minZ, far: maxZ } = planesOf(description, objects);
  const camera = new GivenCamera(description, scene);
  if (height === undefined) return Object.assign(camera, { minZ, maxZ, fov: (fov * Math.PI) / 180 });
  return Object.assign(camera, { minZ, maxZ, mode: B.Camera.ORTHOGRAPHIC_CAMERA, orthoLeft: (-height * aspect) / 2,
    orthoRight: (height * aspect) / 2, orthoBottom: -height / 2, orthoTop: height / 2 });
}

/**
 * A projection that makes Babylon.js's map cover the same area as Gnomon's. Babylon.js's view of the light is left-handed, so the
 * map is mirrored; front faces stay front faces.
 */
function projectionBuilder(camera, near, far) {
  const [x, y, z, w] = clipFromWorld(camera, near, far);
  const rows = [x.map((value) => -value), y, z, w];
  const clip = B.Matrix.FromArray([0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column])));
  return (view, _, result) => B.Matrix.Invert(view).multiplyToRef(clip, result);
}

/** The light, at the position of the map's camera. */
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

/** The light's shadow generator, with the settings of the [engine] keys. */
export function makeShadows(light, { resolution, engine }, meshes) {
  const { filter, filteringQuality, useFloat32TextureType, shadowEnabled: _, backFaceCulling: __, ...named } = engine;
  const shadows = new B.ShadowGenerator(resolution, light, useFloat32TextureType);
  Object.assign(shadows, named, { filter: B.ShadowGenerator[`FILTER_${filter}`], filteringQuality: B.ShadowGenerator[`QUALITY_${filteringQuality}`] });
  shadows.getShadowMap().renderList = meshes.filter(({ metadata }) => metadata.casts);
  return shadows;
}

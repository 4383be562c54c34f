// Builds the scene in PlayCanvas: meshes, a camera, and a light with its shadow.
import * as pc from "playcanvas";
import { planesOf } from "../common/planes.mjs";

const vector = (numbers) => new pc.Vec3(...numbers);
export const nothing = 1e9; // P of background pixels; PlayCanvas does not accept NaN as clear colour

/** The standard material, white and without highlights. */
function whiteMaterial(cull) {
  return Object.assign(new pc.StandardMaterial(), { cull: pc[`CULLFACE_${cull}`] });
}

/** The white material, modified to paint world position and shadow. */
function notingMaterial(device, cull) {
  const own = pc.ShaderChunks.get(device, pc.SHADERLANGUAGE_GLSL);
  const material = whiteMaterial(cull);
  material.shaderChunksVersion = "2.8";
  const chunks = material.getShaderChunks(pc.SHADERLANGUAGE_GLSL);
  const noted = (name, line) => {
    const source = own.get(name);
    if (!source.includes(line)) throw new Error(`PlayCanvas's ${name} is not the known version`);
    chunks.set(name, source.replaceAll(line, `${line} gShadow = shadow;`));
  };
  chunks.set("litUserDeclarationPS", "float gShadow = 1.0;");
  noted("lightFunctionLightPS", "dAtten *= shadow;");
  noted("clusteredLightPS", "falloffAttenuation *= mix(1.0, shadow, light.shadowIntensity);");
  chunks.set("outlineOutputPS", "gl_FragColor = vec4(vPositionW, min(gShadow, 1.0));"); // weights sum to 1 except for rounding
  return material;
}

/** Adds the objects of a .glb file. Those that the camera does not see are on the layer `unseen`. */
export function addMeshes(app, objects, { cull }, unseen, isNoted) {
  const material = isNoted ? notingMaterial(app.graphicsDevice, cull) : whiteMaterial(cull);
  material.update();
  objects.forEach(({ name, positions, normals, casts, isSeen }) => {
    const mesh = new pc.Mesh(app.graphicsDevice);
    mesh.setPositions(positions);
    mesh.setNormals(normals);
    mesh.update(pc.PRIMITIVE_TRIANGLES);
    const entity = new pc.Entity(name, app);
    entity.addComponent("render", { meshInstances: [new pc.MeshInstance(mesh, material)], castShadows: casts, receiveShadows: true,
      layers: [isSeen ? pc.LAYERID_WORLD : unseen] });
    app.root.addChild(entity);
  });
}

/** A target of 32-bit floats. */
export function makeTarget(device, { width, height }) {
  const colorBuffer = new pc.Texture(device, { width, height, format: pc.PIXELFORMAT_RGBA32F, mipmaps: false,
    minFilter: pc.FILTER_NEAREST, magFilter: pc.FILTER_NEAREST });
  return new pc.RenderTarget({ colorBuffer, depth: true, samples: 1 });
}

/** Adds the camera, with planes around the visible objects. */
export function addCamera(app, description, renderTarget, objects) {
  const { eye, target, up, vertical_fov_deg: fov, orthographic_height: height } = description;
  const { near: nearClip, far: farClip } = planesOf(description, objects);
  const lens = height === undefined ? { fov } : { projection: pc.PROJECTION_ORTHOGRAPHIC, orthoHeight: height / 2 };
  const entity = new pc.Entity("camera", app);
  entity.addComponent("camera", { ...lens, nearClip, farClip, renderTarget, layers: [pc.LAYERID_WORLD],
    clearColor: new pc.Color(nothing, nothing, nothing, nothing), aspectRatioMode: pc.ASPECT_MANUAL, aspectRatio: renderTarget.width / renderTarget.height });
  entity.camera.gammaCorrection = pc.GAMMA_NONE;
  entity.camera.toneMapping = pc.TONEMAP_NONE;
  app.root.addChild(entity);
  entity.setPosition(...eye);
  entity.lookAt(vector(target), vector(up));
  return entity.camera;
}

const kinds = { directional: "directional", spot: "spot", point: "omni" };

/** Adds the light, which shines along its entity's -y. */
export function addLight(app, { type, position, target, direction, cone_deg: cone }, { engine, resolution, range }, unseen) {
  const { shadowType, vsmBlurMode, cull: _, clusteredLightingEnabled: __, ...named } = engine;
  const isClustered = app.scene.clusteredLightingEnabled && type !== "directional";
  const [ofAll, ofLight] = isClustered ? [shadowType, "PCF3_32F"] : ["PCF3_32F", shadowType];
  Object.assign(app.scene.lighting, { shadowType: pc[`SHADOW_${ofAll}`], shadowAtlasResolution: type === "point" ? 3 * resolution : resolution });
  const entity = new pc.Entity("light", app);
  entity.addComponent("light", { ...named, type: kinds[type], layers: [pc.LAYERID_WORLD, unseen], shadowResolution: resolution,
    shadowType: pc[`SHADOW_${ofLight}`], vsmBlurMode: pc[`BLUR_${vsmBlurMode}`],
    falloffMode: pc.LIGHTFALLOFF_LINEAR, ...(range && { range }), ...(cone && { outerConeAngle: cone / 2, innerConeAngle: cone / 2 - 0.01 }) });
  app.root.addChild(entity);
  if (position) entity.setPosition(...position);
  const way = direction ?? target?.map((value, k) => value - position[k]);
  if (way) entity.setRotation(new pc.Quat().setFromDirections(new pc.Vec3(0, -1, 0), vector(way).normalize()));
  return entity.light;
}

// Builds the scene in Filament: a glTF asset, a camera and a light. The global `Filament` is replaced when it is initialized.
import { planesOf } from "../common/planes.mjs";
import { writeGlb } from "./glb.mjs";

function makeLight(engine, { type, position, direction, target, cone_deg: cone }, range, castShadows) {
  const kinds = Filament.LightManager$Type;
  const entity = Filament.EntityManager.get().create();
  const builder = Filament.LightManager.Builder({ spot: kinds.SPOT, directional: kinds.DIRECTIONAL }[type]);
  builder.color([1, 1, 1]).intensity(1e5).castShadows(castShadows);
  if (position) builder.position(position).falloff(range);
  builder.direction(direction ?? target.map((value, k) => value - position[k]));
  if (type === "spot") builder.spotLightCone((cone * Math.PI) / 361, (cone * Math.PI) / 360); // half angles [rad]
  builder.build(engine, entity);
  return entity;
}

function makeCamera(engine, description, objects, aspect) {
  const { eye, target, up, vertical_fov_deg: fov, orthographic_height: height } = description;
  const { near, far } = planesOf(description, objects);
  const entity = Filament.EntityManager.get().create();
  const camera = engine.createCamera(entity);
  camera.lookAt(eye, target, up);
  if (height === undefined) camera.setProjectionFov(fov, aspect, near, far, Filament.Camera$Fov.VERTICAL);
  else camera.setProjection(Filament.Camera$Projection.ORTHO, (-height * aspect) / 2, (height * aspect) / 2, -height / 2, height / 2, near, far);
  return { entity, camera };
}

/** Loads the objects of a .glb file into the scene. */
async function addMeshes(engine, scene, loader, objects, doubleSided) {
  const asset = loader.createAsset(writeGlb(objects, doubleSided));
  await new Promise((resolve) => { asset.loadResources(resolve, null, null, null); });
  const renderables = engine.getRenderableManager();
  objects.forEach(({ casts }, i) => {
    const instance = renderables.getInstance(asset.getEntitiesByName(String(i))[0]);
    renderables.setCastShadows(instance, casts);
    renderables.setReceiveShadows(instance, true);
    instance.delete();
  });
  asset.getRenderableEntities().forEach((entity) => scene.addEntity(entity));
  return asset;
}

/** A view of the scene, and a function that releases it. */
export async function makeView(engine, loader, { objects, camera: description, light, image: { width, height } }, { engine: { castShadows, doubleSided }, range }) {
  const scene = engine.createScene();
  const asset = await addMeshes(engine, scene, loader, objects, doubleSided);
  const lamp = makeLight(engine, light, range, castShadows);
  scene.addEntity(lamp);
  const { entity, camera } = makeCamera(engine, description, objects, width / height);
  const view = engine.createView();
  view.setScene(scene);
  view.setCamera(camera);
  view.setViewport([0, 0, width, height]);
  view.setPostProcessingEnabled(false);
  return {
    view,
    release() {
      engine.destroyView(view);
      engine.destroyScene(scene);
      engine.destroyCameraComponent(entity);
      engine.destroyEntity(lamp);
      loader.destroyAsset(asset);
    },
  };
}

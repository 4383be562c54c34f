// Describes three.js for ../common/adapter.mjs, with scenes from Gnomon or from a project.
import { dirname } from "node:path";
import { fileURLToPath } from "node:url";
import { keysOfProject, planProject, refusalOfProject } from "./project.mjs";
import { keys, plan } from "./settings.mjs";

export const engine = {
  name: "three",
  folder: dirname(fileURLToPath(import.meta.url)),
  modules: ["three"],
  options: { api: ["webgl", "webgpu"] },
  takesModule: true,
  title: ({ api }) => ({ webgl: "three.js", webgpu: "three.js WebGPU" })[api],
  page: ({ api, module }) => {
    if (module && api !== "webgl") throw new Error("a project's own scene is drawn by WebGL; omit --api");
    return module ? "project.html" : `${api}.html`;
  },
  keys: ({ project }) => (project ? keysOfProject(project) : keys),
  refusal: (scene, device) => (device?.project ? refusalOfProject(scene, device.project) : undefined),
  plan: (scene, order, device) => (device.project ? planProject(order, device) : plan(scene, order, device)),
};

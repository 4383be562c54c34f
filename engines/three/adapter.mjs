#!/usr/bin/env node
// three.js as a renderer that Gnomon drives: docs/renderer_protocol.md. README.md says how it is made to say what it does.
import { dirname } from "node:path";
import { fileURLToPath } from "node:url";
import { drive } from "../common/adapter.mjs";
import { keys, plan } from "./settings.mjs";

drive({
  name: "three",
  folder: dirname(fileURLToPath(import.meta.url)),
  modules: ["three"],
  options: { api: ["webgl", "webgpu"] },
  title: ({ api }) => ({ webgl: "three.js", webgpu: "three.js WebGPU" })[api],
  page: ({ api }) => `${api}.html`,
  keys,
  plan,
});

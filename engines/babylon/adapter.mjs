#!/usr/bin/env node
// Babylon.js as a renderer that Gnomon drives: docs/renderer_protocol.md. README.md says how it is made to say what it does.
import { dirname } from "node:path";
import { fileURLToPath } from "node:url";
import { drive } from "../common/adapter.mjs";
import { keys, plan } from "./settings.mjs";

drive({
  name: "babylon",
  folder: dirname(fileURLToPath(import.meta.url)),
  modules: ["babylonjs"],
  options: { samplers: ["declared", "highp"] },
  title: () => "Babylon.js",
  page: ({ samplers }) => `webgl.html?samplers=${samplers}`,
  keys,
  plan,
});

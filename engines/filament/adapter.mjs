#!/usr/bin/env node
// Filament as a renderer that Gnomon drives: docs/renderer_protocol.md. README.md says how it is made to say what it does.
import { dirname } from "node:path";
import { fileURLToPath } from "node:url";
import { drive } from "../common/adapter.mjs";
import { keys, plan, refusal } from "./settings.mjs";

drive({
  name: "filament",
  folder: dirname(fileURLToPath(import.meta.url)),
  modules: ["filament", "gl-matrix"],
  options: { precision: ["declared", "highp"] },
  title: () => "Filament",
  page: ({ precision, mask }) => `webgl.html?precision=${precision}&mask=${mask}`,
  keys,
  plan,
  refusal,
});

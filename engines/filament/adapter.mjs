#!/usr/bin/env node
// Lets Gnomon drive Filament (docs/renderer_protocol.md). README.md explains how.
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

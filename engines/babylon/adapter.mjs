#!/usr/bin/env node
// Lets Gnomon drive Babylon.js (docs/renderer_protocol.md). README.md explains how.
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

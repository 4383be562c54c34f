#!/usr/bin/env node
// Lets Gnomon drive PlayCanvas (docs/renderer_protocol.md). README.md explains how.
import { dirname } from "node:path";
import { fileURLToPath } from "node:url";
import { drive } from "../common/adapter.mjs";
import { keys, plan, refusal } from "./settings.mjs";

drive({
  name: "playcanvas",
  folder: dirname(fileURLToPath(import.meta.url)),
  modules: ["playcanvas"],
  options: {},
  title: () => "PlayCanvas",
  page: () => "webgl.html",
  keys,
  plan,
  refusal,
});

#!/usr/bin/env node
// PlayCanvas as a renderer that Gnomon drives: docs/renderer_protocol.md. README.md says how it is made to say what it does.
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

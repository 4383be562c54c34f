#!/usr/bin/env node
// export.mjs MODULE FOLDER: exports a three.js project to FOLDER/scene.glb and FOLDER/job.toml.
import { mkdirSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { Browser } from "../common/browser.mjs";
import { openPage } from "../common/adapter.mjs";
import { engine } from "./engine.mjs";
import { encodeGlb } from "./glb.mjs";

const width = 640; // [px]

function table(name, entries) {
  return `\n[${name}]\n${Object.entries(entries).map(([key, value]) => `${key} = ${JSON.stringify(value)}\n`).join("")}`;
}

function jobOf(module, { meshes, camera, light, aspect, resolution }) {
  const noCast = meshes.filter(({ casts }) => !casts).map(({ name }) => name);
  return `# Written by export.mjs of ${basename(module)}: do not edit; what the project sets of its shadows, the renderer says itself.\n`
    + table("scene", { file: "scene.glb", ...(noCast.length > 0 && { no_cast: noCast }) }) + table("camera", camera)
    + table("image", { width, height: Math.round(width / aspect) }) + table("light", light) + table("shadow_map", { resolution });
}

async function exportProject(module, folder) {
  const browser = new Browser(() => {});
  try {
    await openPage(engine, [module], browser);
    const described = await browser.call("describe", null);
    const meshes = described.meshes.map(({ name }, i) => {
      const [positions, bits] = [browser.take(`positions${i}`), browser.take(`indices${i}`)];
      return { name, positions, indices: new Uint32Array(bits.buffer, bits.byteOffset, bits.length) };
    });
    mkdirSync(folder, { recursive: true });
    writeFileSync(join(folder, "scene.glb"), encodeGlb(meshes));
    writeFileSync(join(folder, "job.toml"), jobOf(module, described));
  } finally {
    await browser.close();
  }
}

const [module, folder, ...others] = process.argv.slice(2);
if (!module || !folder || module.startsWith("-") || others.length > 0) {
  process.stderr.write("usage: export.mjs MODULE FOLDER\n");
  process.exit(2);
}
exportProject(module, folder).then(() => process.exit(0), (problem) => {
  process.stderr.write(`export.mjs: ${problem.message}\n`);
  process.exit(1);
});

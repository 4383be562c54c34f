// Loads the page's scripts, which share one scope, for tests without a browser.

import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { join } from "node:path";

export const assets = fileURLToPath(new URL("../../reports/page/assets", import.meta.url));

/**
 * @param {string[]} files  of reports/page/assets, in the order of scripts.txt
 * @param {string[]} names  of what they declare
 * @return {object}  the declarations by name
 */
export function loadScripts(files, names) {
  const source = files.map((file) => readFileSync(join(assets, file), "utf8")).join("\n");
  return new Function(`"use strict";\n${source}\nreturn { ${names.join(", ")} };`)();
}

/** Random numbers from 0 to 1 by seed (mulberry32). */
export function seededRandom(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

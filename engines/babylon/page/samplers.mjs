// ?samplers=highp reads textures with full precision. Babylon.js declares no precision for the map's sampler, so GLSL ES uses
// `lowp`, and a driver may round depths to halves.

const context = WebGL2RenderingContext.prototype;
const { shaderSource } = context;

if (new URLSearchParams(location.search).get("samplers") === "highp") {
  context.shaderSource = function source(shader, text) {
    const kinds = ["sampler2D", "samplerCube"].map((kind) => `precision highp ${kind};\n`).join("");
    return shaderSource.call(this, shader, text.replace("precision highp float;", `precision highp float;\n${kinds}`));
  };
}

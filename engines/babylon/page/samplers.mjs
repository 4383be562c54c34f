// With ?samplers=highp: textures are read with all the bits they hold. Babylon.js declares no precision for a map's sampler,
// and without one GLSL ES takes `lowp`, by which a driver may round what it reads to halves.

const context = WebGL2RenderingContext.prototype;
const { shaderSource } = context;

if (new URLSearchParams(location.search).get("samplers") === "highp") {
  context.shaderSource = function source(shader, text) {
    const kinds = ["sampler2D", "samplerCube"].map((kind) => `precision highp ${kind};\n`).join("");
    return shaderSource.call(this, shader, text.replace("precision highp float;", `precision highp float;\n${kinds}`));
  };
}

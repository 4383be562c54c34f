// Hooks WebGL, because Filament's materials are precompiled, and its canvas has 8 bits a channel.

const context = WebGL2RenderingContext.prototype;
const { bindFramebuffer, getExtension, getSupportedExtensions, shaderSource } = context;
const lookup = /(_\d+) = [^;\n]*texture\(light_shadowMap[^;\n]*;/g;
const end = /}\s*$/; // of main
const withoutWaiting = "KHR_parallel_shader_compile"; // with it, a frame omits objects whose shaders are not compiled yet
const asked = new URLSearchParams(location.search);
const isExact = asked.get("precision") === "highp";
const isPicture = asked.get("mask") === "picture"; // shaders stay unchanged
let target = null;

/** Makes lit shaders paint the position relative to the camera, and 2 + the result of their shadow lookup. */
function noting(text) {
  if (isPicture || !text.includes("vec3 shading_position;") || !text.includes("fragColor")) return text;
  return text.replace(lookup, "$& visibilityFound = $1;")
    .replace(end, "fragColor = vec4(shading_position, 2.0 + min(visibilityFound, 1.0));\n}\n")
    .replace("highp vec3 shading_position;", "highp vec3 shading_position;\nhighp float visibilityFound = 1.0;");
}

/** The number of shader sources so far that contain the known lookup. */
export let lookupsFound = 0;

context.shaderSource = function source(shader, text) {
  if (lookup.test(text)) lookupsFound += 1;
  lookup.lastIndex = 0;
  const noted = noting(text);
  return shaderSource.call(this, shader, isExact ? noted.replaceAll("mediump", "highp") : noted);
};
context.getSupportedExtensions = function supported() {
  return getSupportedExtensions.call(this).filter((name) => name !== withoutWaiting);
};
context.getExtension = function extension(name) {
  return name === withoutWaiting ? null : getExtension.call(this, name);
};
context.bindFramebuffer = function bind(kind, framebuffer) {
  return bindFramebuffer.call(this, kind, framebuffer ?? target);
};

/** A target of 32-bit floats that replaces the canvas until `release`. */
export function divert(gl, { width, height }) {
  const [color, depth] = [gl.createRenderbuffer(), gl.createRenderbuffer()];
  target = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  [[color, gl.RGBA32F, gl.COLOR_ATTACHMENT0], [depth, gl.DEPTH_COMPONENT32F, gl.DEPTH_ATTACHMENT]].forEach(([buffer, format, attachment]) => {
    gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
    gl.renderbufferStorage(gl.RENDERBUFFER, format, width, height);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, buffer);
  });
  return {
    read() {
      const pixels = new Float32Array(4 * width * height);
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
      gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, pixels);
      return pixels;
    },
    release() {
      gl.deleteFramebuffer(target);
      target = null;
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
      [color, depth].forEach((buffer) => gl.deleteRenderbuffer(buffer));
    },
  };
}

// What Filament draws by WebGL, made to say what it found: its materials come compiled, and its page has 8 bits a colour.

const context = WebGL2RenderingContext.prototype;
const { bindFramebuffer, getExtension, getSupportedExtensions, shaderSource } = context;
const lookup = /(_\d+) = [^;\n]*texture\(light_shadowMap[^;\n]*;/g;
const end = /}\s*$/; // of main
const withoutWaiting = "KHR_parallel_shader_compile"; // with it a frame leaves out whatever is not compiled yet
const asked = new URLSearchParams(location.search);
const isExact = asked.get("precision") === "highp";
const isPicture = asked.get("mask") === "picture"; // shaders are left as they are
let target = null;

/** Shaders that look a shadow map up note its result, and all that are lit paint position from the camera, and 2 + shadow. */
function noting(text) {
  if (isPicture || !text.includes("vec3 shading_position;") || !text.includes("fragColor")) return text;
  return text.replace(lookup, "$& visibilityFound = $1;")
    .replace(end, "fragColor = vec4(shading_position, 2.0 + min(visibilityFound, 1.0));\n}\n")
    .replace("highp vec3 shading_position;", "highp vec3 shading_position;\nhighp float visibilityFound = 1.0;");
}

/** How many of the sources until now hold the lookup that is known here. */
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

/** A target of 32-bit floats that stands in for the page's own until it is `released`. */
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

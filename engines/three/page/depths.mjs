// Reads back a shadow map's depths as 32-bit floats.

const vertex = `#version 300 es
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }`;

const fragment = (isCube) => `#version 300 es
precision highp float;
uniform highp ${isCube ? "samplerCube" : "sampler2D"} map;
uniform int face;
uniform float size;
out vec4 depth;
void main() {
${isCube ? `
  vec2 p = gl_FragCoord.xy / size * 2.0 - 1.0; // OpenGL 4.6, table 8.19, read from right to left
  vec3 directions[6] = vec3[](vec3(1.0, -p.y, -p.x), vec3(-1.0, -p.y, p.x), vec3(p.x, 1.0, p.y),
                              vec3(p.x, -1.0, -p.y), vec3(p.x, -p.y, 1.0), vec3(-p.x, -p.y, -1.0));
  depth = texture(map, directions[face]);`
  : `
  depth = texelFetch(map, ivec2(gl_FragCoord.xy), 0);`}
}`;

function compile(gl, isCube) {
  const program = gl.createProgram();
  for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment(isCube)]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    gl.deleteShader(shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(`reading depths: ${gl.getProgramInfoLog(program) || "the WebGL context was lost"}`);
  return program;
}

function floatTarget(gl, size) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, size, size);
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
  return { texture, framebuffer };
}

/** Reads a texture without comparison and filtering, then restores its parameters. */
function withoutComparison(gl, kind, read) {
  const names = [gl.TEXTURE_COMPARE_MODE, gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER];
  const before = names.map((name) => gl.getTexParameter(kind, name));
  [gl.NONE, gl.NEAREST, gl.NEAREST].forEach((value, i) => gl.texParameteri(kind, names[i], value));
  read();
  names.forEach((name, i) => gl.texParameteri(kind, name, before[i]));
}

/**
 * The depths of a map [size × size] with the bottom row first, or of a cube's six faces.
 * Changes GL's state; the caller must call `renderer.resetState()`.
 */
export function readDepths(gl, map, size, isCube) {
  const program = compile(gl, isCube);
  const kind = isCube ? gl.TEXTURE_CUBE_MAP : gl.TEXTURE_2D;
  const faces = isCube ? 6 : 1;
  const depths = new Float32Array(faces * size * size);
  const pixels = new Float32Array(4 * size * size);
  const { texture, framebuffer } = floatTarget(gl, size);
  [gl.DEPTH_TEST, gl.BLEND, gl.CULL_FACE, gl.SCISSOR_TEST, gl.STENCIL_TEST].forEach((state) => gl.disable(state));
  gl.colorMask(true, true, true, true);
  gl.bindVertexArray(null);
  gl.viewport(0, 0, size, size);
  gl.useProgram(program);
  gl.activeTexture(gl.TEXTURE0);
  gl.bindTexture(kind, map);
  gl.bindSampler(0, null);
  gl.uniform1i(gl.getUniformLocation(program, "map"), 0);
  gl.uniform1f(gl.getUniformLocation(program, "size"), size);
  withoutComparison(gl, kind, () => {
    for (let face = 0; face < faces; ++face) {
      gl.uniform1i(gl.getUniformLocation(program, "face"), face);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
      gl.readPixels(0, 0, size, size, gl.RGBA, gl.FLOAT, pixels);
      for (let i = 0; i < size * size; ++i) depths[face * size * size + i] = pixels[4 * i];
    }
  });
  gl.deleteFramebuffer(framebuffer);
  gl.deleteTexture(texture);
  gl.deleteProgram(program);
  return depths;
}

/** How the device stores three.js's depth format: with 24 bits, or as 32-bit float. */
export function depthFormat(gl) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, 1, 1);
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, texture, 0);
  gl.clearBufferfv(gl.DEPTH, 0, [0.1]); // 1677722 / 16777215 with 24 bits
  const [depth] = readDepths(gl, texture, 1, false);
  gl.deleteFramebuffer(framebuffer);
  gl.deleteTexture(texture);
  return depth === Math.fround(0.1) ? "d32f" : "d24";
}

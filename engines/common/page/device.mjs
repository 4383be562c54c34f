/** The device of a WebGL context; throws if it has no targets of 32-bit floats. */
export function deviceOf(gl) {
  if (!gl.getExtension("EXT_color_buffer_float")) throw new Error("targets of 32-bit floats are not supported: EXT_color_buffer_float is missing");
  return gl.getParameter(gl.getExtension("WEBGL_debug_renderer_info").UNMASKED_RENDERER_WEBGL);
}

/** What draws a WebGL context; refuses one that has no targets of 32-bit floats. */
export function deviceOf(gl) {
  if (!gl.getExtension("EXT_color_buffer_float")) throw new Error("there are no targets of 32-bit floats: EXT_color_buffer_float is missing");
  return gl.getParameter(gl.getExtension("WEBGL_debug_renderer_info").UNMASKED_RENDERER_WEBGL);
}

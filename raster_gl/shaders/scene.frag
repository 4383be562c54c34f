// A fragment of one of the scene's triangles, after the text whose write_fragment() says what is written of it.
uniform uint first_triangle; // of this draw

void main()
{
    write_fragment(first_triangle + uint(gl_PrimitiveID)); // the triangle's index in the scene
}

// A fragment of a scene triangle. Follows the source that defines write_fragment().
uniform uint first_triangle; // of this draw

void main()
{
    write_fragment(first_triangle + uint(gl_PrimitiveID)); // the triangle's index in the scene
}

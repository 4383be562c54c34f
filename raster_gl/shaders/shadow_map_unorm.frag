// Writes depth as an n-bit unsigned normalised code, code = floor(z·(2^n − 1) + ½), exactly: z has
// 24 significant bits and 2^n − 1 at most 24, so product and sum fit in a double's 53 bits wherever
// the floor can depend on them.
layout(location = 0) out uint code;
layout(location = 1) out float unquantised_z;

uniform uint largest_code; // 2^n − 1

void main()
{
    float z = gl_FragCoord.z;
    double steps = double(z) * double(largest_code);
    code = uint(floor(steps + 0.5LF));
    unquantised_z = z;
    gl_FragDepth = float(double(code) / double(largest_code));
}

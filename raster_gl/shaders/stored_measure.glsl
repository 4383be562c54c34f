// What a map stores in place of GL's depth, where a program defines ALONG_RAY or ALONG_AXIS
// (scene/light/map_content.hpp): evenly from `origin` to `far`. Rounded in this order wherever it is computed, so
// that a lookup compares what the map holds.
#if ALONG_RAY || ALONG_AXIS
uniform float origin; // near or 0
uniform float far;

float stored_measure(float measure)
{
    precise float stored = (measure - origin) / (far - origin);
    return stored;
}
#endif

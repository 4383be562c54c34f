// The value that a map stores instead of GL's depth if ALONG_RAY or ALONG_AXIS is defined
// (scene/light/map_content.hpp): linear from `origin` to `far`. All programs round in this order,
// so that lookups compare the stored value.
#if ALONG_RAY || ALONG_AXIS
uniform float origin; // near or 0
uniform float far;

float stored_measure(float measure)
{
    precise float stored = (measure - origin) / (far - origin);
    return stored;
}
#endif

// Codes that colour formats store of a float32 in [0, 1], and the float32s that the codes stand for.
//
// This text is compiled twice: as GLSL for the pass that draws the map, and as C++ by
// depth_format.cpp, so that both are bit-identical. Rounding is done in integers, because GL leaves
// much of it to the driver; of floats there are products with powers of two, which are exact, and
// sums, which are rounded one by one.

// v as a significand and what it is divided by: v · 2^24 = significand / 2^below. Of a subnormal v
// the significand is wrong, and below is so large that it does not count.
uint significand_of(float v)
{
    return (floatBitsToUint(v) & 0x7FFFFFu) | 0x800000u;
}
uint below_of(float v)
{
    return 126u - (floatBitsToUint(v) >> 23u); // of 1 it is −1, and wraps
}

// The bits of the nearest binary16, of two the even one.
uint half_of_float(float v)
{
    uint exponent = floatBitsToUint(v) >> 23u;
    bool is_normal = exponent >= 113u; // from 2^-14 on; below, halves are 2^-24 apart
    uint dropped = is_normal ? 13u : 126u - exponent;
    if (dropped > 24u) {
        return 0u; // less than half of the smallest
    }
    uint significand = significand_of(v);
    uint whole = significand >> dropped;
    uint rest = significand - (whole << dropped);
    uint half_way = 1u << (dropped - 1u);
    bool rounds_up = rest > half_way || (rest == half_way && (whole & 1u) == 1u);
    // The significand's leading one counts as one in the exponent; a carry does, too.
    return (is_normal ? (exponent - 113u) << 10u : 0u) + whole + (rounds_up ? 1u : 0u);
}

float float_of_half(uint bits)
{
    if (bits < 0x400u) {
        return float(bits) * uintBitsToFloat(0x33800000u); // 2^-24
    }
    return uintBitsToFloat((bits << 13u) + (112u << 23u));
}

// A component that is k/256, as an 8-bit unorm: floor(255·k/256 + ½).
uint byte_of_component(uint k)
{
    return (255u * k + 128u) >> 8u;
}

// The last component, which is rest/2^32, in the same way: floor(255·rest/2^32 + ½).
uint byte_of_rest(uint rest)
{
    uint upper = 255u * (rest >> 16u) + 0x8000u;
    uint lower = 255u * (rest & 0xFFFFu);
    return (upper + (lower >> 16u)) >> 16u;
}

// Lessons' packing, the first byte the uppermost one: with c = fract(v·(1, 2^8, 2^16, 2^24)), less
// (c.yzw, 0)/256, the first three components are digits to the base of 256, over 256, and the last
// is what is left. 1 is white, the colour of a cleared map.
uint packed_of_float(float v)
{
    if (v >= 1.0f) {
        return 0xFFFFFFFFu;
    }
    uint significand = significand_of(v);
    uint below = below_of(v);
    uint digits = below < 24u ? significand >> below : 0u;
    uint rest = 0u; // of v · 2^24 the fraction, in 2^-32
    if (below > 0u && below <= 32u) {
        rest = significand << (32u - below);
    } else if (below > 32u && below < 56u) {
        rest = significand >> (below - 32u);
    }
    return (byte_of_component(digits >> 16u) << 24u) |
           (byte_of_component((digits >> 8u) & 0xFFu) << 16u) |
           (byte_of_component(digits & 0xFFu) << 8u) | byte_of_rest(rest);
}

// The float32 next to byte/255, which in binary repeats the byte without end: never half-way between
// two, and told by 32 bits of it.
float float_of_byte(uint byte)
{
    if (byte == 0u) {
        return 0.0f;
    }
    uint repeated = byte * 0x01010101u;
    uint top = uint(findMSB(repeated));
    uint significand = ((repeated >> (top - 24u)) + 1u) >> 1u;
    return float(significand) * uintBitsToFloat((top + 72u) << 23u); // 2^(top − 55)
}

// Lessons' dot(bytes/255, (1, 2^-8, 2^-16, 2^-24)), summed up in this order. Only white is more than
// 1, and is limited to it.
float float_of_packed(uint bytes)
{
    precise float sum = float_of_byte(bytes >> 24u);
    sum = sum + float_of_byte((bytes >> 16u) & 0xFFu) * uintBitsToFloat(0x3B800000u);
    sum = sum + float_of_byte((bytes >> 8u) & 0xFFu) * uintBitsToFloat(0x37800000u);
    sum = sum + float_of_byte(bytes & 0xFFu) * uintBitsToFloat(0x33800000u);
    return sum > 1.0f ? 1.0f : sum;
}

// e^x. Each step is monotone in x, so that it never falls when x rises: 2^n times a polynomial of
// the remainder with positive coefficients, at most 2. 0 below 2^-126; finite. Relative error at
// most (1.5·|x| + 4)·2^-24.
float exponential(float x)
{
    precise float power = clamp(x * 1.44269504, -127.0, 127.99999);
    precise float whole = floor(power);
    precise float rest = power - whole;
    precise float series = 1.01780860e-7;
    series = 1.32154868e-6 + rest * series;
    series = 1.52527338e-5 + rest * series;
    series = 1.54035304e-4 + rest * series;
    series = 1.33335581e-3 + rest * series;
    series = 9.61812911e-3 + rest * series;
    series = 5.55041087e-2 + rest * series;
    series = 0.240226507 + rest * series;
    series = 0.693147181 + rest * series;
    series = 1.0 + rest * series;
    precise float scaled = uintBitsToFloat(uint(int(whole) + 127) << 23) * min(series, 2.0);
    return scaled;
}

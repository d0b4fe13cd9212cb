// fog(x, y, z) = 0.5 + 0.1 z | integral
// What the sum of a and b was rounded by to s (Knuth, TwoSum). The zero, bit 2 of an odd square, is one that no compiler knows:
// with it nothing is reassociated.
fn sum_rest(a: f32, b: f32, s: f32) -> f32 {
    let odd = bitcast<u32>(a) | 1u;
    let zero = (odd * odd) & 4u;
    let part = bitcast<f32>(bitcast<u32>(s - a) ^ zero);
    let back = bitcast<f32>(bitcast<u32>(s - part) ^ zero);
    return bitcast<f32>(bitcast<u32>(a - back) ^ zero) + bitcast<f32>(bitcast<u32>(b - part) ^ zero);
}

// The density is 0.1 times the height above the plane z = -5.
fn fog_integral(o: vec3f, d: vec3f, a: f32, b: f32) -> f32 {
    let height = o.z + 5.0;
    let rest = sum_rest(o.z, 5.0, height);
    let ends = fma(d.z, a, height) + fma(d.z, b, height);
    return 0.05 * (b - a) * (ends + 2.0 * rest);
}

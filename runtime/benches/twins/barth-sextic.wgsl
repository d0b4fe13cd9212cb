const PHI2: f32 = 2.618034;

fn f(p: vec3f) -> f32 {
    let q = p * p;
    let k = PHI2 * q - q.yzx;
    let s = q.x + q.y + q.z - 1.0;
    return 4.0 * k.x * k.y * k.z - 4.236068 * s * s;
}

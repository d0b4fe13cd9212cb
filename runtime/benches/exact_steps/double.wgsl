alias real = f64;
fn from_f32(x: f32) -> real { return f64(x); }
fn to_pair(x: real) -> vec2f { let hi = f32(x); return vec2f(hi, f32(x - f64(hi))); }
fn plus(a: real, b: real) -> real { return a + b; }
fn minus(a: real, b: real) -> real { return a - b; }
fn times(a: real, b: real) -> real { return a * b; }

alias real = f32;
fn from_f32(x: f32) -> real { return x; }
fn to_pair(x: real) -> vec2f { return vec2f(x, 0.0); }
fn plus(a: real, b: real) -> real { return a + b; }
fn minus(a: real, b: real) -> real { return a - b; }
fn times(a: real, b: real) -> real { return a * b; }

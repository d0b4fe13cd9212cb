// What an adapter does to binary32 arithmetic. One row (a, b) in; results in the order of `probe.rs`.

struct Batch { count: u32, zero: u32, time: f32, pixel: f32, columns: u32, results: u32 }

@group(0) @binding(0) var<storage, read> rows: array<f32>;
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
@group(0) @binding(2) var<storage, read_write> results: array<f32>;
@group(0) @binding(3) var<uniform> batch: Batch;

// The same number, but the shader compiler cannot know.
fn opaque(x: f32) -> f32 { return bitcast<f32>(bitcast<u32>(x) ^ batch.zero); }

// Sum and its rounding error (Knuth).
fn two_sum(a: f32, b: f32) -> vec2f {
    let s = a + b;
    let v = s - a;
    return vec2f(s, (a - (s - v)) + (b - v));
}

fn two_sum_opaque(a: f32, b: f32) -> vec2f {
    let s = opaque(a + b);
    let v = opaque(s - a);
    let w = opaque(s - v);
    return vec2f(s, opaque(a - w) + opaque(b - v));
}

// Product and its rounding error, if fma rounds once.
fn two_prod_fma(a: f32, b: f32) -> vec2f {
    let p = opaque(a * b);
    return vec2f(p, fma(a, b, -p));
}

// Upper half of the significand (Veltkamp).
fn upper(a: f32) -> f32 {
    let c = opaque(4097.0 * a);
    return opaque(c - opaque(c - a));
}

// Product and its rounding error by halves (Dekker).
fn two_prod_split(a: f32, b: f32) -> vec2f {
    let p = opaque(a * b);
    let ah = upper(a);
    let al = opaque(a - ah);
    let bh = upper(b);
    let bl = opaque(b - bh);
    let e1 = opaque(opaque(ah * bh) - p);
    let e2 = opaque(e1 + opaque(ah * bl));
    let e3 = opaque(e2 + opaque(al * bh));
    return vec2f(p, e3 + opaque(al * bl));
}

@compute @workgroup_size(64)
fn compute_main(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let index = id.x + id.y * groups.x * 64u;
    if index >= batch.count {
        return;
    }
    let a = rows[2u * index];
    let b = rows[2u * index + 1u];
    let sum = two_sum(a, b);
    let sum_opaque = two_sum_opaque(a, b);
    let prod_fma = two_prod_fma(a, b);
    let prod_split = two_prod_split(a, b);
    // The least normal number, halved and doubled again.
    let half = opaque(opaque(bitcast<f32>(0x00800000u)) * opaque(0.5));
    let subnormal = half * opaque(2.0);
    let nan = opaque(bitcast<f32>(0x7fc00000u ^ batch.zero));
    let infinity = 1.0 / opaque(0.0);
    let first = index * 13u;
    results[first] = sum.x;
    results[first + 1u] = sum.y;
    results[first + 2u] = sum_opaque.x;
    results[first + 3u] = sum_opaque.y;
    results[first + 4u] = prod_fma.x;
    results[first + 5u] = prod_fma.y;
    results[first + 6u] = prod_split.x;
    results[first + 7u] = prod_split.y;
    results[first + 8u] = a / b;
    results[first + 9u] = sqrt(a);
    results[first + 10u] = select(0.0, 1.0, bitcast<u32>(subnormal) == 0x00800000u);
    results[first + 11u] = select(0.0, 1.0, nan != nan);
    results[first + 12u] = select(0.0, 1.0, infinity > 3.4e38);
}

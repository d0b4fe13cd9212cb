// The exact steps, which stand in front, on a row (a, b).

@group(0) @binding(0) var<storage, read> rows: array<u32>;
@group(0) @binding(1) var<storage, read_write> results: array<u32>;
@group(0) @binding(2) var<uniform> batch: vec4u;

fn put(index: u32, v: vec2f) {
    results[index] = bitcast<u32>(v.x);
    results[index + 1u] = bitcast<u32>(v.y);
}

@compute @workgroup_size(64)
fn compute_main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= batch.x {
        return;
    }
    let a = bitcast<f32>(rows[2u * id.x]);
    let b = bitcast<f32>(rows[2u * id.x + 1u]);
    let zero = hidden_zero(a);
    let sum = two_sum(a, b, zero);
    let product = two_product(a, b, zero);
    let first = 10u * id.x;
    put(first, sum);
    put(first + 2u, product);
    put(first + 4u, two_sum(opaque(a * b, zero), b, zero));
    // An error may be a summand of the next exact sum.
    put(first + 6u, two_sum(sum.y, product.y, zero));
    put(first + 8u, quick_two_sum(sum.x, product.y * 0.000244140625, zero));
}

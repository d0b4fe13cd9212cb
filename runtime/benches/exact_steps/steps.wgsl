// Sums and products of a row (a, b) with their errors. The exact steps stand in front of this text.

@group(0) @binding(0) var<storage, read> rows: array<u32>;
@group(0) @binding(1) var<storage, read_write> results: array<u32>;
@group(0) @binding(2) var<uniform> batch: vec4u;

@compute @workgroup_size(64)
fn compute_main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= batch.x {
        return;
    }
    let a = bitcast<f32>(rows[2u * id.x]);
    let b = bitcast<f32>(rows[2u * id.x + 1u]);
    let zero = batch.y;
    let sum = two_sum(a, b, zero);
    let of_product = two_sum(opaque(a * b, zero), b, zero);
    let product = two_product(a, b, zero);
    // An error may be a summand of the next exact sum.
    let of_errors = two_sum(sum.y, product.y, zero);
    let first = 8u * id.x;
    results[first] = bitcast<u32>(sum.x);
    results[first + 1u] = bitcast<u32>(sum.y);
    results[first + 2u] = bitcast<u32>(of_product.x);
    results[first + 3u] = bitcast<u32>(of_product.y);
    results[first + 4u] = bitcast<u32>(product.x);
    results[first + 5u] = bitcast<u32>(product.y);
    results[first + 6u] = bitcast<u32>(of_errors.x);
    results[first + 7u] = bitcast<u32>(of_errors.y);
}

// Evaluates a formula for rows of numbers in a wide format, each as two words. The type `real` is defined in front.

struct Batch {
    count: u32,    // rows
    zero: u32,     // always 0, but the shader compiler does not know
    time: f32,     // seconds
    pixel: f32,    // world units per pixel
    columns: u32,  // numbers in a row
    results: u32,  // numbers in a result
}

@group(0) @binding(0) var<storage, read> rows: array<vec2u>;
@group(0) @binding(2) var<storage, read_write> results: array<vec2u>;
@group(0) @binding(4) var<uniform> batch: Batch;

fn real_from_words(w: vec2u) -> real { return real(); }
fn real_to_words(x: real) -> vec2u { return vec2u(); }

// The results of one row.
fn evaluate(row: array<real, 16>) -> array<real, 40> { return array<real, 40>(); }

@compute @workgroup_size(64)
fn compute_main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(num_workgroups) groups: vec3u,
) {
    let index = id.x + id.y * groups.x * 64u;
    if index >= batch.count {
        return;
    }
    var row: array<real, 16>;
    for (var k = 0u; k < min(batch.columns, 16u); k++) {
        row[k] = real_from_words(rows[index * batch.columns + k]);
    }
    var values = evaluate(row);
    for (var k = 0u; k < min(batch.results, 40u); k++) {
        results[index * batch.results + k] = real_to_words(values[k]);
    }
}

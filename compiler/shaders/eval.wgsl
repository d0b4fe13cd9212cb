// Evaluates a formula for rows of numbers: the pocket calculator on the GPU.

struct Batch {
    count: u32,    // rows
    zero: u32,     // always 0, but the shader compiler does not know
    time: f32,     // seconds
    pixel: f32,    // world units per pixel
    columns: u32,  // numbers in a row
    results: u32,  // numbers in a result
}

@group(0) @binding(0) var<storage, read> rows: array<f32>;
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
@group(0) @binding(2) var<storage, read_write> results: array<f32>;
@group(0) @binding(4) var<uniform> batch: Batch;

// The results of one row.
fn evaluate(row: array<f32, 16>) -> array<f32, 40> { return array<f32, 40>(); }

@compute @workgroup_size(64)
fn compute_main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(num_workgroups) groups: vec3u,
) {
    let index = id.x + id.y * groups.x * 64u;
    if index >= batch.count {
        return;
    }
    var row: array<f32, 16>;
    for (var k = 0u; k < min(batch.columns, 16u); k++) {
        row[k] = rows[index * batch.columns + k];
    }
    var values = evaluate(row);
    for (var k = 0u; k < min(batch.results, 40u); k++) {
        results[index * batch.results + k] = values[k];
    }
}

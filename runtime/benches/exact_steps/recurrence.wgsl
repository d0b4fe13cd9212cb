// z² + c many times, from 0; c is the row. A format stands in front of this text.

@group(0) @binding(0) var<storage, read> rows: array<u32>;
@group(0) @binding(1) var<storage, read_write> results: array<u32>;
@group(0) @binding(2) var<uniform> batch: vec4u;

@compute @workgroup_size(64)
fn compute_main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= batch.x {
        return;
    }
    let c_re = from_f32(bitcast<f32>(rows[2u * id.x]));
    let c_im = from_f32(bitcast<f32>(rows[2u * id.x + 1u]));
    var re = from_f32(0.0);
    var im = from_f32(0.0);
    for (var k = 0u; k < batch.z; k++) {
        let half = times(re, im);
        re = plus(minus(times(re, re), times(im, im)), c_re);
        im = plus(plus(half, half), c_im);
    }
    let x = to_pair(re);
    let y = to_pair(im);
    let first = 4u * id.x;
    results[first] = bitcast<u32>(x.x);
    results[first + 1u] = bitcast<u32>(x.y);
    results[first + 2u] = bitcast<u32>(y.x);
    results[first + 3u] = bitcast<u32>(y.y);
}

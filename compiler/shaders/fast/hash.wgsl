// Hashing of lattice points in the tier `fast`. Stands for the function of the same name in `math`.

struct LatticeCell {
    low: vec4f,
    high: vec4f,
}

fn hash_word(v: u32) -> u32 { return 0u; }
fn lattice_face(x0: u32, x1: u32, y0: u32, y1: u32, inner: u32, shift: u32) -> vec4f { return vec4f(); }

/// The same digits below 2^23, without care for what is beyond, where neighbours of the lattice are no neighbours of f32.
fn lattice_cell(x: f32, y: f32, z: f32, w: f32, shift: u32) -> LatticeCell {
    let x0 = bitcast<u32>(i32(x));
    let y0 = bitcast<u32>(i32(y));
    let z0 = bitcast<u32>(i32(z));
    let inner = hash_word(bitcast<u32>(i32(floor(w))));
    return LatticeCell(
        lattice_face(x0, x0 + 1u, y0, y0 + 1u, hash_word(z0 + inner), shift),
        lattice_face(x0, x0 + 1u, y0, y0 + 1u, hash_word(z0 + 1u + inner), shift),
    );
}

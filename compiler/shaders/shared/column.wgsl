// Columns: exact integrals of a medium's density along parts of rays.

// The optical depth of a column of the medium's values to its power, from `field_column`: negative where that has been compiled for
// another density or not at all, and where the column is no number.
fn depth_of_column(column: vec3f, medium: Medium) -> f32 {
    let same = column.y == medium.power && column.z == f32(medium.signs);
    let depth = medium.density * (column.x * plain_power(1.0 / medium.scale, medium.power));
    return select(-1.0, max(depth, 0.0), same && !is_nan(depth) && !is_inf(depth));
}

// A column of the values above 0, or what is the most that it can be: negative where none has been compiled, and where it is no number.
fn column_within(column: vec3f, most: f32) -> f32 {
    let known = column.y == 1.0 && column.z == 1.0 && !is_nan(column.x) && !is_inf(column.x);
    return select(-1.0, clamp(column.x, 0.0, most), known);
}

// x to a power; to 1 and 2 without the error of `pow`.
fn plain_power(x: f32, power: f32) -> f32 {
    return select(select(pow(x, power), x * x, power == 2.0), x, power == 1.0);
}

// What lies even along the optical depth d sends (1 - exp(-d)) to the eye; what grows from -1/2 at the near to 1/2 at the far end
// sends this: ∫ (x/d - 1/2) exp(-x) dx, negative, as the near part hides the far one.
fn leaning_part(d: f32) -> f32 {
    let series = -d * d * (1.0 / 12.0 - d * (1.0 / 24.0 - d * (1.0 / 80.0 - d * (1.0 / 360.0 - d / 2016.0))));
    let whole = (absorbed_part(d) - d * exp(-d)) / max(d, 0.5) - 0.5 * absorbed_part(d);
    return select(whole, series, d < 0.5);
}

// A stretch of one colour and this optical depth behind what has been seen.
fn seen_through_depth(seen: Seen, colour: vec3f, depth: f32) -> Seen {
    let kept = min(depth, 80.0);
    return Seen(seen.light + seen.through * absorbed_part(kept) * colour, seen.through * exp(-kept));
}

// A stretch of this optical depth whose matter is known at the two points of the rule of Gauss and Legendre: with its mean colour,
// and with that changing evenly along the optical depth. The error falls as the fourth power of the stretch's length.
fn seen_through_column(seen: Seen, near: Matter, far: Matter, depth: f32) -> Seen {
    let kept = min(depth, 80.0);
    let whole = near.extinction + far.extinction;
    let part = select(0.5, near.extinction / whole, whole > 0.0);
    let mean = mix(far.colour, near.colour, part);
    let change = 1.7320508075688772 * (far.colour - near.colour);
    let light = max(mean * absorbed_part(kept) + change * leaning_part(kept), vec3f(0.0));
    return Seen(seen.light + seen.through * light, seen.through * exp(-kept));
}

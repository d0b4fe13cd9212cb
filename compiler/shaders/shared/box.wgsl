// Axis-aligned boxes, given by centre and half size.

// Parameters at which a ray enters and leaves the box (x and y); x > y where it misses. The slab method (Kay and
// Kajiya 1986); a direction component of 0 is replaced by a tiny one, so no 0 · ∞ arises.
fn box_span(origin: vec3f, direction: vec3f, center: vec3f, half_size: vec3f) -> vec2f {
    let size = max(abs(direction), vec3f(1e-12));
    let rate = 1.0 / select(size, -size, direction < vec3f(0.0));
    let middle = (center - origin) * rate;
    let reach = abs(half_size * rate);
    let enter = middle - reach;
    let leave = middle + reach;
    return vec2f(max(enter.x, max(enter.y, enter.z)), min(leave.x, min(leave.y, leave.z)));
}

// Outward unit normal of the face that a point of the box's surface lies on.
fn box_normal(p: vec3f, center: vec3f, half_size: vec3f) -> vec3f {
    let q = (p - center) * (1.0 / max(half_size, vec3f(1e-20)));
    let a = abs(q);
    let across_x = (a.x >= a.y) & (a.x >= a.z);
    let across_y = !across_x & (a.y >= a.z);
    let side = select(vec3f(-1.0), vec3f(1.0), q >= vec3f(0.0));
    return select(vec3f(0.0), side, vec3<bool>(across_x, across_y, !(across_x | across_y)));
}

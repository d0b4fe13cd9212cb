const PI: f32 = 3.14159265;

fn f(p: vec2f) -> f32 {
    let a = PI * params[0].x;
    let b = PI * params[0].y;
    return cos(a * p.x) * cos(b * p.y) - cos(b * p.x) * cos(a * p.y);
}

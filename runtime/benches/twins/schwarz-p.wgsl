fn f(p: vec3f) -> f32 {
    let c = cos(params[0].y * 3.14159265 * p);
    return c.x + c.y + c.z - params[0].x;
}

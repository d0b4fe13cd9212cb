fn along_ray(o: vec3f, d: vec3f, a: f32, b: f32) -> f32 {
    return field_integral(o, d, a, b);
}

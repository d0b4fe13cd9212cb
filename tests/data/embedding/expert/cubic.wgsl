// cubic(x, y) = x³ y + y² | hessian
struct CubicHessian {
    value: f32,
    dx: f32,
    dy: f32,
    dxx: f32,
    dxy: f32,
    dyy: f32,
}

fn cubic_hessian(x: f32, y: f32) -> CubicHessian {
    let x2 = x * x;
    let x3 = x2 * x;
    return CubicHessian(x3 * y + y * y, 3.0 * x2 * y, x3 + 2.0 * y, 6.0 * x * y, 3.0 * x2, 2.0);
}

//! The densities that are integrated.

/// A density of x, y and z in the box from -2 to 2.
#[derive(Clone, Copy, Debug)]
pub struct Density {
    /// What it is called.
    pub name: &'static str,
    /// Its formula.
    pub formula: &'static str,
}

const fn density(name: &'static str, formula: &'static str) -> Density {
    Density { name, formula }
}

/// Twenty of them. The first five are those of volumes of light that are drawn without marching today, and are in the
/// gallery, with the clock at a constant.
pub const DENSITIES: [Density; 20] = [
    density("constant", "1"),
    density("sine", "0.5 + 0.5 sin(9 z - 2.5)"),
    density(
        "clamped falloff, linear",
        "if 0 < z + 1 and z + 1 < 2 then z + 1 else 0",
    ),
    density("clamped falloff, quadratic", "clamp((z + 1.5)/3, 0, 1)^2"),
    density("rainbow, one channel", "0.5 + 0.5 sin(2 pi (z + 1/3))"),
    density("Gaussian", "exp(-4 (x^2 + y^2 + z^2))"),
    density("Lorentz", "1/(x^2 + y^2 + z^2 + 0.01)"),
    density("Lorentz, squared", "1/(x^2 + y^2 + z^2 + 0.05)^2"),
    density("root of a quadratic", "sqrt(x^2 + y^2 + z^2 + 0.04)"),
    density("distance", "length((x, y, z))"),
    density("logarithm", "log(x^2 + y^2 + z^2 + 0.01)"),
    density("height fog", "exp(-2.5 (z + 1))"),
    density(
        "gyroid, squared",
        "(sin(3 x) cos(3 y) + sin(3 y) cos(3 z) + sin(3 z) cos(3 x))^2",
    ),
    density("sphere, squared", "(x^2 + y^2 + z^2 - 1)^2"),
    density("product of sines", "sin(6 x) sin(6 y) sin(6 z)"),
    density("compact blob", "max(0, 1 - x^2 - y^2 - z^2)^3"),
    density("sech²", "1/cosh(4 z)^2"),
    density("smoothstep", "smoothstep(-1, 1, z)"),
    density(
        "fog in waves",
        "exp(-3 (z + 1)) (1 + 0.3 cos(6 x) cos(6 y))",
    ),
    density("ring", "(x^2 + y^2) exp(-2 (x^2 + y^2 + z^2))"),
];

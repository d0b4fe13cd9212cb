//! The formulas of which gradients are found, with those that are derived by hand.

/// A formula of x, y and z.
#[derive(Clone, Copy, Debug)]
pub struct Gradient {
    /// What it is called.
    pub name: &'static str,
    /// Its formula.
    pub formula: &'static str,
    /// The gradient and the value by hand: the body of a function of `p` in WGSL.
    pub by_hand: &'static str,
}

const fn gradient([name, formula, by_hand]: [&'static str; 3]) -> Gradient {
    Gradient {
        name,
        formula,
        by_hand,
    }
}

/// Polynomials, waves, lengths and exponentials, as an expert writes their gradients.
pub const GRADIENTS: [Gradient; 8] = [
    gradient([
        "gyroid",
        "sin(x) cos(y) + sin(y) cos(z) + sin(z) cos(x)",
        "let s = sin(p); let c = cos(p); return vec4f(c * c.yzx - s * s.zxy, dot(s, c.yzx));",
    ]),
    gradient([
        "schwarz-p",
        "cos(2 x) + cos(2 y) + cos(2 z)",
        "return vec4f(-2.0 * sin(2.0 * p), dot(cos(2.0 * p), vec3f(1.0)));",
    ]),
    gradient([
        "tanglecube",
        "x^4 - 5 x^2 + y^4 - 5 y^2 + z^4 - 5 z^2 + 11.8",
        "let q = p * p; return vec4f(p * (4.0 * q - 10.0), dot(q, q - 5.0) + 11.8);",
    ]),
    gradient([
        "heart",
        "(x^2 + 2.25 y^2 + z^2 - 1)^3 - x^2 z^3 - 0.1125 y^2 z^3",
        "let q = p * p; let a = q.x + 2.25 * q.y + q.z - 1.0; let g = 6.0 * a * a; let z3 = q.z * p.z; \
         let b = q.x + 0.1125 * q.y; \
         return vec4f(p.x * (g - 2.0 * z3), p.y * (2.25 * g - 0.225 * z3), p.z * g - 3.0 * q.z * b, a * a * a - z3 * b);",
    ]),
    gradient([
        "torus",
        "sqrt((sqrt(x^2 + y^2) - 1)^2 + z^2) - 0.4",
        "let r = length(p.xy); let q = vec2f(r - 1.0, p.z); let l = length(q); \
         return vec4f(p.xy * (q.x / (r * l)), q.y / l, l - 0.4);",
    ]),
    gradient([
        "gaussian",
        "exp(-(x^2 + y^2 + z^2))",
        "let e = exp(-dot(p, p)); return vec4f(-2.0 * e * p, e);",
    ]),
    gradient([
        "airlight",
        "1/(x^2 + y^2 + z^2 + 1)",
        "let v = 1.0 / (dot(p, p) + 1.0); return vec4f(-2.0 * v * v * p, v);",
    ]),
    gradient([
        "waves",
        "sin(x y) + cos(y z) exp(-x^2)",
        "let a = p.x * p.y; let b = p.y * p.z; let e = exp(-p.x * p.x); let c = cos(a); let d = cos(b) * e; \
         let s = -sin(b) * e; return vec4f(p.y * c - 2.0 * p.x * d, p.x * c + p.z * s, p.y * s, sin(a) + d);",
    ]),
];

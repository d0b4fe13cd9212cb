//! Names that mean something in mathematics or in other languages, and how that is written here.

/// How the meaning of a name is written, if it has one that many readers would expect. `in_plane`: whether x and y are
/// at hand.
pub fn name(text: &str, in_plane: bool) -> Option<&'static str> {
    Some(match text {
        "θ" | "theta" | "ϑ" if in_plane => {
            "for the angle of the point write `atan2(y, x)`, or `… where θ = atan2(y, x)`"
        }
        "r" | "ρ" | "rho" | "radius" if in_plane => {
            "for the distance from the origin write `hypot(x, y)`, or `… where r = hypot(x, y)`"
        }
        "iTime" | "u_time" | "uTime" | "iGlobalTime" | "t" | "clock" => {
            "for the animation clock write `time`"
        }
        "iResolution" | "u_resolution" | "resolution" | "fragCoord" | "gl_FragCoord" | "uv" => {
            "the point of the plane is (x, y), in units of the plane: there are no pixels to divide by"
        }
        "iMouse" | "u_mouse" | "mouse" => "use a slider: `param a = 0 in -1..1`",
        "dx" | "dy" | "dz" | "dt" | "d" | "∂x" | "∂y" => {
            "for a derivative write `diff(expression, x)` or `f'(x)`"
        }
        "I" | "j" => "the imaginary unit is `i`",
        "Pi" | "PI" => "write `pi`",
        "xor" | "XOR" => "between conditions write `!=`",
        "AND" | "And" => "write `and`",
        "OR" | "Or" => "write `or`",
        "NOT" | "Not" => "write `not`",
        "Re" | "Im" | "Abs" | "Arg" | "Sin" | "Cos" => {
            "functions are written in small letters, and their arguments in brackets: `re(z)`"
        }
        "infinity" | "Infinity" | "oo" => "write `inf`",
        "deg" | "degree" => "angles are in radians: write `radians(90)` for 90°",
        _ => return None,
    })
}

/// How a function that many readers would expect is written, with the text of its arguments.
pub fn function(text: &str, args: &[String]) -> Option<String> {
    let arg = |k: usize, otherwise: &str| args.get(k).map_or(otherwise, String::as_str).to_owned();
    let (first, second) = (arg(0, "a"), arg(1, "b"));
    Some(match text {
        "random" | "rand" => {
            "a formula has the same value each time: write `noise(x, y)`, or `hash(x, y, 0, 0)` at whole numbers"
                .to_owned()
        }
        "perlin" | "simplex" | "snoise" | "cnoise" | "pnoise" => {
            format!("write `noise({})`", args.join(", "))
        }
        "worley" | "voronoi" => format!("write `cellular({})`", args.join(", ")),
        "union" | "opUnion" => format!("write `min({first}, {second})` for a union of shapes"),
        "intersection" | "intersect" | "opIntersection" => {
            format!("write `max({first}, {second})` for what shapes have in common")
        }
        "subtract" | "subtraction" | "opSubtraction" => {
            format!("to cut the second out of the first write `max({first}, -{second})`")
        }
        "translate" | "move" | "shift" => {
            "move the point instead: `sphere(p - (1, 0, 0), 1)` has its centre at (1, 0, 0)".to_owned()
        }
        "scale" => "scale the point instead: `2 sphere(p/2, 1)` is twice as large".to_owned(),
        "int" | "integer" => format!("write `trunc({first})`"),
        "nthroot" | "nthRoot" | "root" | "surd" => {
            let degree = args.len() == 2;
            if degree && first.parse::<f64>().is_ok() {
                format!("a root is a power: `{}^(1/{first})`", in_power(&second))
            } else if degree {
                format!("a root is a power: `{}^(1/{second})`", in_power(&first))
            } else {
                "a root is a power: `x^(1/3)`, or `cbrt(x)`".to_owned()
            }
        }
        "factorial" | "fact" => format!("write `{}!`", in_power(&first)),
        "binomial" | "choose" | "comb" | "nCr" | "Binomial" => {
            "write it with factorials: `n!/(k! (n - k)!)`".to_owned()
        }
        "derivative" | "deriv" | "D" | "Derivative" if args.len() == 2 => {
            format!("write `diff({first}, {second})`")
        }
        "derivative" | "deriv" | "D" | "Derivative" => "write `diff(expression, x)`".to_owned(),
        "dx" | "dy" | "dt" => {
            let variable = text.trim_start_matches('d');
            format!("for a derivative write `diff({first}, {variable})`")
        }
        "gradient" | "nabla" | "Grad" => format!("write `grad({})`", args.join(", ")),
        "Δ" | "Laplacian" | "laplace" => format!("write `laplacian({})`", args.join(", ")),
        "divergence" => format!("write `div({})`", args.join(", ")),
        "rot" => format!("write `curl({})` for the rotation of a field, `rotate(p, angle)` to turn a vector", args.join(", ")),
        "lim" | "limit" | "Limit" => "there are no limits; write the value itself".to_owned(),
        "mag" | "magnitude" | "modulus" | "cabs" => format!("write `|{first}|`"),
        "If" | "IF" | "ifelse" | "iif" | "IIf" | "where" | "select" | "Which" => match args {
            [c, a, b] => format!("a choice is written `if {c} then {a} else {b}`"),
            _ => "a choice is written `if c then a else b`".to_owned(),
        },
        "switch" | "Switch" | "case" | "Piecewise" | "piecewise" => {
            "cases are written `{ x < 0: -x, else: x }`".to_owned()
        }
        "plot" | "Plot" | "Plot3D" | "ContourPlot" | "draw" | "graph" | "print" | "render" => {
            "write the formula alone: what a program has is drawn, or `show levels(formula)`".to_owned()
        }
        "Module" | "With" | "Block" => "local names stand behind: `a + y where a = x`".to_owned(),
        "Sum" | "Σ" => "write `sum(k in 1..n, term)`".to_owned(),
        "Integrate" | "integrate" | "NIntegrate" => "write `integral(expression, t, a, b)`".to_owned(),
        "texture" | "texture2D" | "sample" => "there are no images; write a formula".to_owned(),
        "average" | "mean" | "avg" => match args {
            [a, b] => format!("write `({a} + {b})/2`"),
            _ => "write the sum, divided by the number".to_owned(),
        },
        _ => return None,
    })
}

/// The text of an operand as the base of a power.
fn in_power(text: &str) -> String {
    let is_simple = text.chars().all(char::is_alphanumeric);
    if is_simple {
        text.to_owned()
    } else {
        format!("({text})")
    }
}

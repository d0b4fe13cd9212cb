//! The proof of integrals: every closed form passes it, and a wrong one does not.

use pullback_compiler::integrate::{Otherwise, field_integral, prove};
use pullback_compiler::ir::{Graph, Id, Op, Prim};

use super::{VALUES, densities, formula};

pub(super) const CLASSES: [&str; 13] = [
    "polynomials",
    "waves",
    "exponentials",
    "mixed",
    "pieces",
    "algebraic",
    "affine",
    "bells",
    "scenes",
    "products",
    "gaussians",
    "fractions",
    "random",
];

/// How many of the densities are proven by normal forms, at least; the others on rays in f64, and by the 60 digits of the oracle.
const SYMBOLIC: usize = 41;

#[test]
fn integrals_are_proven() {
    let (mut count, mut symbolic, mut rays, mut worst) = (0, 0, 0, 0.0_f64);
    let (mut wrong, mut by_class) = (String::new(), String::new());
    for class in CLASSES {
        let known = (count, symbolic);
        for density in densities(class) {
            let of = formula(&density.text);
            let made = field_integral(&of, Otherwise::Refuse).unwrap();
            let proof = prove(&of, &made, &VALUES);
            count += 1;
            symbolic += usize::from(proof.is_symbolic);
            rays += proof.rays;
            worst = worst.max(proof.worst);
            if !proof.holds() {
                wrong += &format!("{}: {proof:?}\n", density.text);
            }
        }
        by_class += &format!(
            "    {class}: {} of {}\n",
            symbolic - known.1,
            count - known.0
        );
    }
    println!(
        "{count} integrals, {symbolic} of them symbolically, {} numerically alone:\n{by_class}{rays} rays, worst {worst:.1e}",
        count - symbolic
    );
    assert!(wrong.is_empty(), "{wrong}");
    assert!(symbolic >= SYMBOLIC, "only {symbolic} by normal forms");
}

/// A copy of a graph in which one operation is another.
pub(super) fn with_other(graph: &Graph, root: Id, at: Id, other: Prim) -> Option<(Graph, Id)> {
    let mut out = Graph::new();
    let found = pullback_compiler::ir::transcribe(graph, &[root], &mut out, |to, node, args| {
        match node.op {
            Op::Apply(_) if *node == *graph.node(at) => to.apply(other, args),
            Op::Apply(prim) => to.apply(prim, args),
            op => to.leaf(op, node.ty),
        }
    });
    found.first().map(|&root| (out, root))
}

/// Another operation with as many operands, where there is one that a slip of the pen would put there.
pub(super) fn slip(prim: Prim) -> Option<Prim> {
    Some(match prim {
        Prim::Add => Prim::Sub,
        Prim::Sub => Prim::Add,
        Prim::Mul => Prim::Div,
        Prim::Sin => Prim::Cos,
        Prim::Cos => Prim::Sin,
        Prim::Sinc => Prim::Sinhc,
        Prim::Exprel => Prim::Exp,
        Prim::Sqrt => Prim::Abs,
        Prim::Atan2Quotient => Prim::Atan2,
        Prim::Min => Prim::Max,
        Prim::Max => Prim::Min,
        Prim::PowInt(n) => Prim::PowInt(n + 1),
        Prim::AtanQuotient(0) => Prim::AtanQuotient(1),
        Prim::Erfcx(n) => Prim::Erfcx(n + 1),
        Prim::SphericalJ(n) => Prim::SphericalJ(n + 1),
        _ => return None,
    })
}

fn value(graph: &Graph, root: Id, ray: &[f64; 8]) -> f64 {
    use pullback_compiler::eval::{Leaves, Tape};
    use pullback_compiler::table::Number;
    let inputs = ray.map(Number::Real);
    let leaves = Leaves {
        inputs: &inputs,
        params: &VALUES,
        time: 0.375,
        pixel: 1e-3,
    };
    let mut out = f64::NAN;
    Tape::new(graph, &[root]).run(&leaves, |v| {
        if let Number::Real(x) = v {
            out = x;
        }
    });
    out
}

/// Each operation of some integrals is replaced in turn. Where that changes the integral on a ray of a sample, the proof
/// fails.
#[test]
fn wrong_rules_do_not_pass() {
    const SAMPLE: [[f64; 8]; 4] = [
        [0.2, -0.3, 0.4, 0.6, -0.5, 0.62, -0.4, 1.3],
        [0.1, 0.6, -0.2, 0.3, 0.7, -0.6, 0.2, 2.0],
        [-0.5, 0.1, 0.3, 0.9, 0.1, 0.4, -1.0, 1.5],
        [0.3, 0.2, 0.1, 0.5, 0.5, 0.7, 1.2, -0.6],
    ];
    let (mut planted, mut caught) = (0, 0);
    let mut missed = String::new();
    for text in [
        "x^2*y + z",
        "sin(3*x + 1)*y",
        "exp(-2*y)*cos(x)",
        "1/(x^2 + y^2 + z^2 + 0.1)",
        "sqrt(x^2 + y^2 + z^2 + 0.1)",
        "1/(x^2 + y^2 + z^2 + 0.1)^2",
        "exp(-(x^2 + y^2 + z^2))",
        "exp(-(x^2 + y^2))*sin(5*z)",
        "log(x^2 + y^2 + 0.5)",
        "clamp(y, 0, 1)^2",
        "(y + 8)^(3/2)",
    ] {
        let of = formula(text);
        let made = field_integral(&of, Otherwise::Refuse).unwrap();
        let (graph, roots) = made.graph.compacted(&[made.integral.value]);
        if graph.has_loops() {
            continue;
        }
        let step = graph.nodes().len() / 40 + 1;
        for at in graph.ids().step_by(step) {
            let Op::Apply(prim) = graph.node(at).op else {
                continue;
            };
            let Some(other) = slip(prim) else { continue };
            let Some((wrong, root)) = with_other(&graph, roots[0], at, other) else {
                continue;
            };
            let differs = SAMPLE.iter().any(|ray| {
                let (right, wrong) = (value(&graph, roots[0], ray), value(&wrong, root, ray));
                let error = (right - wrong).abs() / right.abs().max(1e-3);
                error.is_nan() || error > 1e-5
            });
            if !differs {
                continue;
            }
            planted += 1;
            let mut bad = made.clone();
            bad.graph = wrong;
            bad.integral.value = root;
            if prove(&of, &bad, &VALUES).holds() {
                missed += &format!("{text}: {prim:?} as {other:?} at {at:?}\n");
            } else {
                caught += 1;
            }
        }
    }
    println!("{caught} of {planted} wrong integrals are found out");
    assert!(
        planted > 100 && missed.is_empty(),
        "{planted} planted, missed:\n{missed}"
    );
}

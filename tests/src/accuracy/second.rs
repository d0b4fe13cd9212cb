//! Second derivatives of every operation: formulas for them, references, and declared bounds.

use pullback_compiler::What;
use pullback_compiler::derive::{ComplexVariable, forward, jet};
use pullback_compiler::formula::Formula;
use pullback_compiler::ir::{Graph, Id, Op, Prim, Ty};
use pullback_compiler::table::{Bound, Metric};
use pullback_compiler::types::Type;

use super::bounds::permitted;
use super::error::Format;
use super::evaluators::{Machine, Point};
use super::measure::{Errors, Witness, case_error};
use super::subjects::{formula, subjects};
use super::tables::{Domain, Expected, slope};

/// `function domain reference gpu reason`
const BOUNDS: &str = include_str!("second_bounds.tsv");

/// What is differentiated, by what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// A real function, forward mode twice, by each pair of operands.
    Real,
    /// A complex function: the jet of the jet, by each pair of operands.
    Complex,
    /// A real function of z, by its real and imaginary part.
    Plane,
    /// A real function of z: ∂²/∂z², and ∂²/∂z∂z̄, which is real.
    Wirtinger,
}

impl Way {
    fn word(self) -> &'static str {
        match self {
            Self::Real => "real",
            Self::Complex => "complex",
            Self::Plane => "plane",
            Self::Wirtinger => "wirtinger",
        }
    }
}

/// An operation with formulas for its second derivatives and references for them.
#[derive(Clone, Debug)]
pub struct Second {
    /// Its word in the tables.
    pub word: &'static str,
    /// The operation.
    pub prim: Prim,
    /// How it is differentiated.
    pub way: Way,
    /// One formula for each second derivative, in the order of the references.
    pub formulas: Vec<Formula>,
    /// Arguments and second derivatives.
    pub cases: Vec<(Point, Vec<Expected>)>,
}

/// Every operation of the table that has a second derivative.
///
/// # Panics
/// A derivative rule is missing.
#[must_use]
pub fn seconds() -> Vec<Second> {
    let mut out = Vec::new();
    for subject in subjects() {
        let (way, source) = match (subject.domain, subject.word) {
            (Domain::Real, _) => (Way::Real, subject.source.clone()),
            (Domain::Complex, "abs" | "arg") => {
                let word = subject.word;
                out.push(second(
                    word,
                    subject.row.prim,
                    Way::Wirtinger,
                    &subject.source,
                ));
                (Way::Plane, format!("f(x, y) = {word}(x + i y)\n"))
            }
            _ => (Way::Complex, subject.source.clone()),
        };
        out.push(second(subject.word, subject.row.prim, way, &source));
    }
    let source = "f(x, y, z) = length((x, y, z))\n";
    out.push(second("length", Prim::Hypot3, Way::Real, source));
    out
}

fn second(word: &'static str, prim: Prim, way: Way, source: &str) -> Second {
    let plain = formula(source);
    let cases = references(word, way.word());
    let inputs = plain.columns().len();
    let case = |(args, values): (Vec<f64>, Vec<Expected>)| {
        let params = args[inputs..].to_vec();
        let args = args[..inputs].to_vec();
        (Point { args, params }, values)
    };
    Second {
        word,
        prim,
        way,
        formulas: derivatives(&plain, way),
        cases: cases.into_iter().map(case).collect(),
    }
}

const REFERENCES: &str = concat!(
    include_str!("../../data/functions/second.tsv"),
    include_str!("../../data/functions/integral_second.tsv")
);

/// The references of a function, asked about in some way: arguments and second derivatives.
fn references(word: &str, way: &str) -> Vec<(Vec<f64>, Vec<Expected>)> {
    let rows = REFERENCES.lines().filter_map(|line| {
        let cells: Vec<&str> = line.split('\t').collect();
        let &[name, of, args, values] = cells.as_slice() else {
            return None;
        };
        (name == word && of == way).then(|| {
            let number = |cell: &str| cell.parse().expect(cell);
            let args = args.split(' ').map(number).collect();
            let values = values
                .split(' ')
                .map(|cell| rounded(slope(cell).expect(cell)));
            (args, values.collect())
        })
    });
    rows.collect()
}

/// Their bounds in f64 are of what is rounded to f64.
fn rounded(expected: Expected) -> Expected {
    match expected {
        Expected::Number { value, signed, .. } => Expected::Number {
            value,
            rest: 0.0,
            signed,
        },
        Expected::Unstated => Expected::Unstated,
    }
}

/// The formulas of the second derivatives.
fn derivatives(plain: &Formula, way: Way) -> Vec<Formula> {
    let mut g = plain.graph.clone();
    let value = plain.value[0];
    let roots = match way {
        Way::Real | Way::Plane => hessian(&mut g, value, plain.scalars().len()),
        Way::Complex => holomorphic(&mut g, value),
        Way::Wirtinger => {
            let z = ComplexVariable::Whole(Formula::leaf(&mut g, 0, Ty::Complex));
            let first = jet(&mut g, value, z).expect("a rule");
            let twice = jet(&mut g, first.dz, z).expect("a rule");
            let mixed = twice.dzbar.unwrap_or_else(|| g.complex(0.0, 0.0));
            vec![twice.dz, g.apply(Prim::Re, &[mixed])]
        }
    };
    let alone = |&root: &Id| {
        let (graph, value) = g.compacted(&[root]);
        let complex = graph.ty(value[0]) == Ty::Complex;
        Formula {
            ty: if complex { Type::Complex } else { Type::Real },
            value: value.into_iter().collect(),
            graph,
            ..plain.clone()
        }
    };
    roots.iter().map(alone).collect()
}

/// The second partial derivatives of a real node by the first `count` inputs, the upper triangle by rows.
///
/// # Panics
/// A derivative rule is missing.
pub fn hessian(g: &mut Graph, value: Id, count: usize) -> Vec<Id> {
    let leaves: Vec<Id> = (0..count).map(|k| Formula::leaf(g, k, Ty::Real)).collect();
    let mut out = Vec::new();
    for (k, &first) in leaves.iter().enumerate() {
        let slope = directional(g, value, first);
        out.extend(leaves[k..].iter().map(|&leaf| directional(g, slope, leaf)));
    }
    out
}

/// The derivative by one leaf, by forward mode.
///
/// # Panics
/// A derivative rule is missing.
pub fn directional(g: &mut Graph, value: Id, leaf: Id) -> Id {
    let one = g.real(1.0);
    let slope = forward(g, &[value], &[(leaf, one)]).expect("a rule")[0];
    slope.unwrap_or_else(|| g.real(0.0))
}

/// Second derivatives of a holomorphic function of z, and where it has one of its second operand a + b i.
fn holomorphic(g: &mut Graph, value: Id) -> Vec<Id> {
    let z = ComplexVariable::Whole(Formula::leaf(g, 0, Ty::Complex));
    let mut variables = vec![z];
    let parameter = |op: Op| g.nodes().iter().any(|n| n.op == op);
    if parameter(Op::Param(0)) {
        let parts = [0, 1].map(|k| g.leaf(Op::Param(k), Ty::Real));
        variables.push(ComplexVariable::Parts(parts[0], parts[1]));
    }
    let mut out = Vec::new();
    for (k, &first) in variables.iter().enumerate() {
        let slope = jet(g, value, first).expect("a rule").dz;
        for &variable in &variables[k..] {
            out.push(jet(g, slope, variable).expect("a rule").dz);
        }
    }
    out
}

/// Errors in every metric, in the order of [`Metric::ALL`].
///
/// # Errors
/// The machine cannot evaluate it; in words.
pub fn measure(second: &Second, machine: &Machine) -> Result<[Errors; 3], String> {
    let points: Vec<Point> = second.cases.iter().map(|c| c.0.clone()).collect();
    let mut results = vec![Vec::new(); points.len()];
    for formula in &second.formulas {
        let columns = machine.run(formula, What::Value, &points)?;
        for (result, columns) in results.iter_mut().zip(columns) {
            result.extend(columns);
        }
    }
    Ok(Metric::ALL.map(|metric| judge(second, machine.format(), &results, metric)))
}

fn judge(second: &Second, format: Format, results: &[Vec<f64>], metric: Metric) -> Errors {
    let mut errors = Errors::default();
    for ((point, expected), got) in second.cases.iter().zip(results) {
        assert_eq!(got.len(), expected.len(), "{}", second.word);
        errors.add(case_error(format, got, expected, metric), || Witness {
            what: format!("{} ({:?})", second.word, second.way),
            at: [&point.args[..], &point.params].concat(),
            got: got.clone(),
            expected: expected.clone(),
        });
    }
    errors
}

/// The bound of second derivatives, and why it is high.
///
/// # Errors
/// There is none, or it breaks the rules for bounds; in words.
pub fn declared(second: &Second, machine: &Machine) -> Result<Bound, String> {
    let row = BOUNDS
        .lines()
        .map(|line| line.split('\t').collect::<Vec<_>>())
        .find(|cells| cells.len() == 5 && cells[0] == second.word && cells[1] == second.way.word())
        .ok_or("no bound is declared")?;
    let place = if matches!(machine, Machine::Reference) {
        2
    } else {
        3
    };
    let found = Bound::parse(row[place]).ok_or("no bound is declared")?;
    let domain = match second.way {
        Way::Complex | Way::Wirtinger => Domain::Complex,
        Way::Real | Way::Plane => Domain::Real,
    };
    let reason = if row[4] == "-" { "" } else { row[4] };
    permitted(found, domain, machine.format(), reason)?;
    Ok(found)
}

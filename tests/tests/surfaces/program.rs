//! The programs of docs/surfaces.

use pullback_compiler::eval::{Leaves, Tape};
use pullback_compiler::table::Number;
use pullback_compiler::{Program, compile};
use pullback_tests::corpus::{read, root};

use crate::group::Vec3;
use crate::polynomial::Polynomial;

/// A compiled program with the evaluator of its formula.
#[derive(Debug)]
pub struct Subject {
    pub program: Program,
    pub params: Vec<f64>,
    tape: Tape,
}

impl Subject {
    pub fn of(name: &str) -> Self {
        let path = root().join(format!("docs/surfaces/{name}.pull"));
        let answer = compile(&read(&path));
        let program = answer
            .program
            .unwrap_or_else(|| panic!("{name}: {:?}", answer.diagnostics));
        let formula = &program.pictures()[0].formula;
        Self {
            tape: Tape::new(&formula.graph, &formula.value),
            params: program.params().iter().map(|p| p.default).collect(),
            program,
        }
    }

    /// The value at a point, in f64.
    pub fn value(&mut self, p: Vec3) -> f64 {
        let inputs = p.map(Number::Real);
        let leaves = Leaves {
            inputs: &inputs,
            params: &self.params,
            time: 0.0,
            pixel: 0.01,
        };
        let mut out = f64::NAN;
        self.tape.run(&leaves, |number| {
            if let Number::Real(x) = number {
                out = x;
            }
        });
        out
    }

    /// The formula as a polynomial, with these parameters or the defaults.
    pub fn polynomial(&self, params: &[f64]) -> Polynomial {
        let formula = &self.program.pictures()[0].formula;
        let params = if params.is_empty() {
            &self.params
        } else {
            params
        };
        Polynomial::expanded(&formula.graph, formula.value[0], params)
    }
}

//! `pullback explain --what proof`

use std::io::{self, Write};

use pullback_compiler::Picture;
use pullback_compiler::integrate::{Otherwise, PROOF_TOLERANCE, Proof, field_integral, prove};
use serde::Serialize;

use super::super::Console;
use super::super::failure::Failure;
use super::super::source::Source;
use super::{Format, VERSION};

#[derive(Serialize)]
struct Report<'a> {
    version: u32,
    file: &'a str,
    name: &'a str,
    holds: bool,
    symbolic: bool,
    rays: usize,
    worst: f64,
    tolerance: f64,
    fails: Option<&'static str>,
    ray: Option<[f64; 8]>,
}

/// Checks the integral of a picture's formula along rays, for the defaults of its parameters.
pub(super) fn run(
    source: &Source,
    picture: &Picture,
    format: Format,
    console: &Console,
) -> Result<(), Failure> {
    let formula = &picture.formula;
    let made = field_integral(formula, Otherwise::Quadrature)
        .map_err(|problem| vec![problem.diagnostic(formula.span)]);
    let made = source.expect(made, console)?;
    let params = source.program.params();
    let params: Vec<f64> = params.iter().map(|p| p.default).collect();
    let proof = prove(formula, &made, &params);
    let mut out = io::BufWriter::new(io::stdout().lock());
    match format {
        Format::Human => tell(&mut out, &formula.name, &proof),
        Format::Json => write_json(&mut out, &source.name, &formula.name, &proof),
    }
    .and_then(|()| out.flush())
    .map_err(Failure::stdout)
}

fn tell(out: &mut impl Write, name: &str, proof: &Proof) -> io::Result<()> {
    writeln!(
        out,
        "I is the integral of {name} along o + t d if dI/db = {name}(o + b d), dI/da = -{name}(o + a d), I(a, a) = 0 and \
         I(a, b) + I(b, c) = I(a, c)"
    )?;
    if proof.is_symbolic {
        writeln!(
            out,
            "dI/db is {name}(o + b d) and I(a, a) is 0 as expressions, by their normal forms"
        )?;
    }
    match proof.failure {
        None => writeln!(
            out,
            "all hold on {} rays to {:.1e}, in f64 with exact derivatives; {PROOF_TOLERANCE:.0e} is allowed",
            proof.rays, proof.worst
        ),
        Some((what, [ox, oy, oz, dx, dy, dz, a, b])) => writeln!(
            out,
            "{what} fails for o = ({ox}, {oy}, {oz}), d = ({dx}, {dy}, {dz}), t from {a} to {b}: off by {:.1e}",
            proof.worst
        ),
    }
}

fn write_json(out: &mut impl Write, file: &str, name: &str, proof: &Proof) -> io::Result<()> {
    let report = Report {
        version: VERSION,
        file,
        name,
        holds: proof.holds(),
        symbolic: proof.is_symbolic,
        rays: proof.rays,
        worst: proof.worst,
        tolerance: PROOF_TOLERANCE,
        fails: proof.failure.map(|f| f.0),
        ray: proof.failure.map(|f| f.1),
    };
    serde_json::to_writer_pretty(&mut *out, &report)?;
    writeln!(out)
}

//! Gradient, divergence, rotation and their kin, as IR.

use std::ops::RangeInclusive;

use pullback_grammar::Diagnostic;
use smallvec::SmallVec;

use super::partial::Subject;
use super::{Kind, Operator};
use crate::check::{Builder, Value};
use crate::derive::gradient;
use crate::ir::{Graph, Id, Prim};
use crate::types::Type;

/// Rows of real nodes.
pub(super) type Matrix = SmallVec<[SmallVec<[Id; 4]>; 4]>;

impl Kind {
    /// How many real variables it is by.
    pub(super) fn numbers_of_variables(self) -> RangeInclusive<usize> {
        match self {
            Self::Laplacian | Self::Prime | Self::Diff | Self::Integral => 1..=4,
            Self::Grad | Self::Div | Self::Jacobian | Self::Hessian => 2..=4,
            Self::Curl | Self::MeanCurvature => 2..=3,
            Self::GaussianCurvature => 3..=3,
        }
    }
}

impl Builder<'_> {
    /// The operator on a value, by real leaves. `None` where it does not fit; that has been reported.
    pub(super) fn operate(
        &mut self,
        operator: &Operator,
        value: &Value,
        by: &[Id],
        subject: Subject,
    ) -> Option<Value> {
        let value = &self.operand(operator, value, by.len(), subject)?;
        match operator.kind {
            Kind::Grad => self
                .gradient(value.ids()[0], by, subject)
                .map(Value::Vector),
            Kind::Div => {
                let mut total = None;
                for (&component, &leaf) in value.ids().iter().zip(by) {
                    let slope = self.tangents(&[component], leaf, subject)?[0];
                    total = Some(plus(&mut self.graph, total, slope));
                }
                total.map(Value::Scalar)
            }
            Kind::Curl => self.curl(value, by, subject),
            Kind::Laplacian => self.laplacian(value, by, subject),
            Kind::Jacobian => {
                let rows = self.jacobian(&value.ids(), by, subject)?;
                Some(Value::Scalar(determinant(&mut self.graph, &rows)))
            }
            Kind::Hessian => {
                let (_, rows) = self.second_derivatives(value.ids()[0], by, subject)?;
                Some(Value::Scalar(determinant(&mut self.graph, &rows)))
            }
            Kind::MeanCurvature | Kind::GaussianCurvature => {
                let (slopes, rows) = self.second_derivatives(value.ids()[0], by, subject)?;
                let g = &mut self.graph;
                let curvature = if operator.kind == Kind::MeanCurvature {
                    super::curvature::mean(g, &slopes, &rows)
                } else {
                    super::curvature::gaussian(g, &slopes, &rows)
                };
                curvature.map(Value::Scalar)
            }
            Kind::Prime | Kind::Diff | Kind::Integral => None,
        }
    }

    /// The value as what the operator takes, with as many components as there are variables where it must have.
    fn operand(
        &mut self,
        operator: &Operator,
        value: &Value,
        variables: usize,
        subject: Subject,
    ) -> Option<Value> {
        let found = value.ty(&self.graph)?;
        let is_square = |n: u8| usize::from(n) == variables;
        let wanted = match (operator.kind, found) {
            (Kind::Laplacian, Type::Real | Type::Complex | Type::Vector(_)) => {
                return Some(value.clone());
            }
            (
                Kind::Grad | Kind::Hessian | Kind::MeanCurvature | Kind::GaussianCurvature,
                Type::Real,
            ) => return Some(value.clone()),
            (Kind::Div | Kind::Curl | Kind::Jacobian, Type::Vector(n)) if is_square(n) => {
                return Some(value.clone());
            }
            (Kind::Jacobian, Type::Complex) if variables == 2 => {
                let z = value.ids()[0];
                let parts = [Prim::Re, Prim::Im].map(|part| self.graph.apply(part, &[z]));
                return Some(Value::Vector(SmallVec::from_slice(&parts)));
            }
            (Kind::Div | Kind::Curl | Kind::Jacobian, _) => {
                format!("a vector of {variables} components, as there are {variables} variables")
            }
            _ => "a real number".to_owned(),
        };
        let problem = Diagnostic::error(
            "type-mismatch",
            subject.span,
            format!(
                "`{}` is of {wanted}, and this is {}",
                operator.name,
                found.in_words()
            ),
        )
        .with_label(format!("of {}", found.in_words()));
        self.report(match (operator.kind, found) {
            (Kind::Grad, Type::Vector(_)) => {
                problem.with_hint("of a vector, take div, curl, or jacobian; or grad of a component such as v.x")
            }
            (Kind::Div | Kind::Curl | Kind::Jacobian, Type::Real) => {
                problem.with_hint("of a number, take grad or laplacian")
            }
            (Kind::Div | Kind::Curl | Kind::Jacobian, Type::Vector(_)) => problem.with_hint(
                "name as many variables as the vector has components; a swizzle such as v.xy shortens it",
            ),
            _ => problem.with_hint(crate::check::builtins::advice(found, false)),
        });
        None
    }

    fn gradient(&mut self, value: Id, by: &[Id], subject: Subject) -> Option<SmallVec<[Id; 4]>> {
        self.charge(subject)?;
        let stable = self.prepared(&[value]);
        match gradient(&mut self.graph, stable[0], by) {
            Ok(gradient) => Some(gradient.partials.into_iter().collect()),
            Err(missing) => self.no_derivative(missing, subject),
        }
    }

    fn curl(&mut self, value: &Value, by: &[Id], subject: Subject) -> Option<Value> {
        let components = value.ids();
        let mut turn = |i: usize, j: usize| {
            let forth = self.tangents(&[components[j]], by[i], subject)?[0];
            let back = self.tangents(&[components[i]], by[j], subject)?[0];
            Some(self.graph.sub(forth, back))
        };
        if by.len() == 2 {
            return turn(0, 1).map(Value::Scalar);
        }
        let axes = [turn(1, 2)?, turn(2, 0)?, turn(0, 1)?];
        Some(Value::Vector(SmallVec::from_slice(&axes)))
    }

    fn laplacian(&mut self, value: &Value, by: &[Id], subject: Subject) -> Option<Value> {
        let mut total: SmallVec<[Option<Id>; 4]> = SmallVec::from_elem(None, value.ids().len());
        for &leaf in by {
            let first = self.tangents(&value.ids(), leaf, subject)?;
            let second = self.tangents(&first, leaf, subject)?;
            for (sum, term) in total.iter_mut().zip(second) {
                *sum = Some(plus(&mut self.graph, *sum, term));
            }
        }
        let total: Option<SmallVec<[Id; 4]>> = total.into_iter().collect();
        Some(value.with_ids(&total?))
    }

    /// ∂F_i/∂x_j in row i.
    fn jacobian(&mut self, components: &[Id], by: &[Id], subject: Subject) -> Option<Matrix> {
        let mut rows: Matrix = SmallVec::from_elem(SmallVec::new(), components.len());
        for &leaf in by {
            for (row, slope) in rows
                .iter_mut()
                .zip(self.tangents(components, leaf, subject)?)
            {
                row.push(slope);
            }
        }
        Some(rows)
    }

    /// The first derivatives of a real node, and the symmetric matrix of the second.
    fn second_derivatives(
        &mut self,
        value: Id,
        by: &[Id],
        subject: Subject,
    ) -> Option<(SmallVec<[Id; 4]>, Matrix)> {
        let slopes = self.gradient(value, by, subject)?;
        let mut rows: Matrix = SmallVec::from_elem(slopes.clone(), by.len());
        for (j, &leaf) in by.iter().enumerate() {
            // those above the diagonal; the others are equal
            let column = self.tangents(&slopes[..=j], leaf, subject)?;
            for (i, second) in column.into_iter().enumerate() {
                (rows[i][j], rows[j][i]) = (second, second);
            }
        }
        Some((slopes, rows))
    }
}

fn plus(g: &mut Graph, total: Option<Id>, term: Id) -> Id {
    match total {
        Some(total) => g.add(total, term),
        None => term,
    }
}

/// Determinant of a square matrix of at most four rows, by expansion along the first row.
pub(super) fn determinant(g: &mut Graph, rows: &[SmallVec<[Id; 4]>]) -> Id {
    match rows {
        [only] if only.len() == 1 => only[0],
        [a, b] if a.len() == 2 && b.len() == 2 => {
            let (down, up) = (g.mul(a[0], b[1]), g.mul(a[1], b[0]));
            g.sub(down, up)
        }
        [first, rest @ ..] if !rest.is_empty() && first.len() == rows.len() => {
            let mut total = None;
            for (k, &entry) in first.iter().enumerate() {
                let minor: Matrix = rest.iter().map(|row| without(row, k)).collect();
                let minor = determinant(g, &minor);
                let term = g.mul(entry, minor);
                total = Some(match total {
                    None => term,
                    Some(total) if k % 2 == 0 => g.add(total, term),
                    Some(total) => g.sub(total, term),
                });
            }
            total.unwrap_or_else(|| g.real(f64::NAN))
        }
        _ => g.real(f64::NAN),
    }
}

fn without(row: &[Id], k: usize) -> SmallVec<[Id; 4]> {
    let others = row.iter().enumerate().filter(|&(j, _)| j != k);
    others.map(|(_, &entry)| entry).collect()
}

//! Syntax tree to text.
//!
//! The text reads back as the same tree, spans aside, and has no brackets that it does not need.

use crate::ast::{
    BinaryOp, CompareOp, Expr, ExprId, Exprs, File, Function, Item, Param, Range, SeriesKind, Show,
    UnaryOp,
};
use crate::complaint::foreign_statement;
use crate::paste::names::{function_of, is_namespace};
use crate::token::{TokenKind, kind_of_word};

/// How tightly an expression holds together, loosest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Where,
    If,
    Or,
    And,
    Not,
    Compare,
    Sum,
    Product,
    Prefix,
    Power,
    Postfix,
    Atom,
}

/// What is still to be written.
enum Work<'a> {
    Text(&'a str),
    Number(f64),
    /// An expression, in brackets if it is looser than the level; whether `|` would close here.
    Expr(ExprId, Level, bool),
    /// The factor behind a product without a sign.
    Factor(ExprId, bool),
}

/// What is printed, and the text that it was read from where numbers are to be written as they are there.
#[derive(Clone, Copy)]
struct Tree<'a> {
    exprs: &'a Exprs,
    text: Option<&'a str>,
}

impl<'a> Tree<'a> {
    /// Puts the number that an expression is on the stack.
    fn number(self, stack: &mut Vec<Work<'a>>, id: ExprId, value: f64) {
        match self.literal(id, value) {
            // `0...5` would not be a range up to .5
            Some(digits) if digits.starts_with('.') => {
                stack.extend([Work::Text("0"), Work::Text(digits)]);
            }
            Some(digits) => stack.push(Work::Text(digits)),
            None => stack.push(Work::Number(value)),
        }
    }

    /// The digits in the text at the place of a number, if they are its own: what is pasted may stand for others.
    fn literal(self, id: ExprId, value: f64) -> Option<&'a str> {
        let written = self.exprs.span(id).text(self.text?);
        let digits = written.strip_suffix('i').unwrap_or(written);
        let is_own = kind_of_word(digits) == Some(TokenKind::Number)
            && digits.parse::<f64>().ok()?.to_bits() == value.to_bits();
        is_own.then_some(digits)
    }
}

/// The canonical text of a file, one statement a line. Comments are no part of the tree and are not kept.
///
/// A tree without [`Expr::Error`] reads back equal; an error is written as `?`.
#[must_use]
pub fn print(file: &File) -> String {
    let mut out = String::new();
    for item in &file.items {
        let line = print_item(&file.exprs, item);
        // A line that begins with `-` would go on with the line before.
        if line.starts_with('-') && out.pop().is_some() {
            out.push_str(";\n");
        }
        out.push_str(&line);
        out.push('\n');
    }
    out
}

/// The canonical text of one statement.
#[must_use]
pub fn print_item(exprs: &Exprs, item: &Item) -> String {
    item_of(Tree { exprs, text: None }, item)
}

/// The canonical text of one statement of a text, with numbers as they are written there.
pub(crate) fn print_item_of(text: &str, exprs: &Exprs, item: &Item) -> String {
    let text = Some(text);
    item_of(Tree { exprs, text }, item)
}

fn item_of(tree: Tree<'_>, item: &Item) -> String {
    let mut out = String::new();
    match item {
        Item::Function(item) => function(&mut out, tree, item),
        Item::Constant(item) => {
            out.push_str(&item.name.text);
            out.push_str(" = ");
            write(&mut out, tree, item.value, Level::Where);
        }
        Item::Param(item) => param(&mut out, tree, item),
        Item::Show(item) => show(&mut out, tree, item),
        Item::Formula(item) => {
            write(&mut out, tree, item.body, Level::Where);
            if looks_foreign(&out) {
                out = format!("({out})");
            }
        }
    }
    out
}

/// Whether a formula begins like a declaration of another language: with a word, and a name behind it.
fn looks_foreign(text: &str) -> bool {
    let is_letter = |c: char| c.is_alphanumeric() || c == '_';
    let (word, rest) = text.split_at(text.find(|c| !is_letter(c)).unwrap_or(text.len()));
    let mut behind = rest.chars();
    if foreign_statement(word).is_some() {
        return true;
    }
    word.chars().nth(1).is_some()
        && behind.next() == Some(' ')
        && behind.next().is_some_and(|c| c.is_alphabetic() || c == '_')
        && !["if", "not", "pi", "tau", "phi", "time", "pixel"].contains(&word)
}

/// The canonical text of one expression.
#[must_use]
pub fn print_expr(exprs: &Exprs, id: ExprId) -> String {
    let mut out = String::new();
    write(&mut out, Tree { exprs, text: None }, id, Level::Where);
    out
}

/// The shortest text that reads back as this number; a negative number stands in brackets.
fn number(out: &mut String, value: f64) {
    let size = value.abs();
    let is_negative = value.is_sign_negative() && !value.is_nan();
    if is_negative {
        out.push_str("(-");
    }
    if value.is_nan() {
        out.push_str("nan");
    } else if size.is_infinite() {
        out.push_str("inf");
    } else if size == 0.0 || (1e-5..1e16).contains(&size) {
        out.push_str(&size.to_string());
    } else {
        out.push_str(&format!("{size:e}"));
    }
    if is_negative {
        out.push(')');
    }
}

fn function(out: &mut String, tree: Tree<'_>, item: &Function) {
    out.push_str(&item.name.text);
    out.push('(');
    for (index, param) in item.params.iter().enumerate() {
        if index > 0 {
            out.push_str(", ");
        }
        out.push_str(&param.name.text);
        if let Some(ty) = &param.ty {
            out.push_str(": ");
            out.push_str(&ty.text);
        }
    }
    out.push_str(") = ");
    write(out, tree, item.body, Level::Where);
}

fn param(out: &mut String, tree: Tree<'_>, item: &Param) {
    out.push_str("param ");
    out.push_str(&item.name.text);
    out.push_str(" = ");
    write(out, tree, item.default, Level::If);
    if let Some((lower, upper)) = item.range {
        out.push_str(" in ");
        write(out, tree, lower, Level::If);
        out.push_str("..");
        write(out, tree, upper, Level::If);
    }
}

fn show(out: &mut String, tree: Tree<'_>, item: &Show) {
    out.push_str("show ");
    out.push_str(&item.scene.text);
    out.push('(');
    for (index, &arg) in item.args.iter().enumerate() {
        if index > 0 {
            out.push_str(", ");
        }
        write(out, tree, arg, Level::If);
    }
    out.push(')');
    for (index, setting) in item.settings.iter().enumerate() {
        out.push_str(if index == 0 { " { " } else { ", " });
        out.push_str(&setting.name.text);
        out.push_str(" = ");
        write(out, tree, setting.value, Level::If);
        if let Some(upper) = setting.upper {
            out.push_str("..");
            write(out, tree, upper, Level::If);
        }
    }
    if !item.settings.is_empty() {
        out.push_str(" }");
    }
}

/// Writes an expression with a stack of its own, so that trees of any shape can be written.
fn write(out: &mut String, tree: Tree<'_>, id: ExprId, level: Level) {
    let mut stack = vec![Work::Expr(id, level, false)];
    while let Some(work) = stack.pop() {
        match work {
            Work::Text(text) => out.push_str(text),
            Work::Number(value) => number(out, value),
            Work::Expr(id, least, in_bars) => {
                if level_of(&tree.exprs[id]) < least {
                    bracketed(out, &mut stack, id);
                } else {
                    parts(&mut stack, tree, id, in_bars);
                }
            }
            Work::Factor(id, in_bars) => {
                let stands_alone = match &tree.exprs[leftmost(tree.exprs, id)] {
                    Expr::Number(_)
                    | Expr::Imaginary(_)
                    | Expr::If { .. }
                    | Expr::Piecewise { .. } => false,
                    Expr::Unary {
                        op: UnaryOp::Abs,
                        arg,
                    } => !in_bars && !begins_barred(tree.exprs, *arg),
                    _ => true,
                };
                if stands_alone && level_of(&tree.exprs[id]) >= Level::Power {
                    parts(&mut stack, tree, id, in_bars);
                } else {
                    bracketed(out, &mut stack, id);
                }
            }
        }
    }
}

fn bracketed(out: &mut String, stack: &mut Vec<Work<'_>>, id: ExprId) {
    out.push('(');
    stack.push(Work::Text(")"));
    stack.push(Work::Expr(id, Level::Where, false));
}

/// The operand whose text a power or postfix form begins with.
fn leftmost(exprs: &Exprs, mut id: ExprId) -> ExprId {
    loop {
        id = match exprs[id] {
            Expr::Binary {
                op: BinaryOp::Pow,
                lhs: next,
                ..
            }
            | Expr::Unary {
                op: UnaryOp::Factorial,
                arg: next,
            }
            | Expr::Member { base: next, .. }
                if level_of(&exprs[next]) >= Level::Postfix =>
            {
                next
            }
            _ => return id,
        }
    }
}

/// Whether the text of an expression may begin with a bar: with one before it, it would look like `||`.
fn begins_barred(exprs: &Exprs, mut id: ExprId) -> bool {
    loop {
        id = match &exprs[id] {
            Expr::Unary {
                op: UnaryOp::Abs, ..
            } => return true,
            Expr::Binary { lhs: first, .. }
            | Expr::Compare { first, .. }
            | Expr::Member { base: first, .. }
            | Expr::Where { body: first, .. }
            | Expr::Unary {
                op: UnaryOp::Factorial,
                arg: first,
            } => *first,
            _ => return false,
        }
    }
}

/// Whether the text of a factor may begin with a bracket.
fn begins_bracketed(exprs: &Exprs, id: ExprId) -> bool {
    !matches!(
        exprs[leftmost(exprs, id)],
        Expr::Name(_)
            | Expr::Call { .. }
            | Expr::Series { .. }
            | Expr::Iterate { .. }
            | Expr::Integral { .. }
    )
}

/// Whether the text of an operand ends with a name that means a function in other notations, perhaps with a power: a
/// bracket behind it would be read as its argument.
fn ends_applied(exprs: &Exprs, mut id: ExprId) -> bool {
    loop {
        id = match &exprs[id] {
            Expr::Name(name) => return function_of(&name.text).is_some(),
            Expr::Binary {
                op: BinaryOp::Pow,
                lhs,
                rhs,
            } if matches!(exprs[*rhs], Expr::Number(_)) => *lhs,
            Expr::Binary { rhs: last, .. }
            | Expr::Unary {
                op: UnaryOp::Neg | UnaryOp::Not | UnaryOp::Sqrt,
                arg: last,
            } => *last,
            _ => return false,
        }
    }
}

fn level_of(expr: &Expr) -> Level {
    match expr {
        Expr::Where { .. } => Level::Where,
        Expr::If { .. } => Level::If,
        Expr::Compare { .. } => Level::Compare,
        Expr::Unary { op, .. } => match op {
            UnaryOp::Not => Level::Not,
            UnaryOp::Neg => Level::Prefix,
            UnaryOp::Sqrt => Level::Power,
            UnaryOp::Factorial => Level::Postfix,
            UnaryOp::Abs => Level::Atom,
        },
        Expr::Binary { op, .. } => match op {
            BinaryOp::Or => Level::Or,
            BinaryOp::And => Level::And,
            BinaryOp::Add | BinaryOp::Sub => Level::Sum,
            BinaryOp::Mul | BinaryOp::ImplicitMul | BinaryOp::Div => Level::Product,
            BinaryOp::Pow => Level::Power,
        },
        Expr::Member { .. } => Level::Postfix,
        Expr::Error
        | Expr::Number(_)
        | Expr::Imaginary(_)
        | Expr::Name(_)
        | Expr::Call { .. }
        | Expr::Vector(_)
        | Expr::Series { .. }
        | Expr::Iterate { .. }
        | Expr::Integral { .. }
        | Expr::Piecewise { .. } => Level::Atom,
    }
}

/// Puts the parts of an expression on the stack, the first on top.
fn parts<'a>(stack: &mut Vec<Work<'a>>, tree: Tree<'a>, id: ExprId, in_bars: bool) {
    use Work::Text;
    let exprs = tree.exprs;
    let base = stack.len();
    let at = |id: ExprId, level: Level| Work::Expr(id, level, in_bars);
    match &exprs[id] {
        Expr::Error => stack.push(Text("?")),
        Expr::Number(value) => tree.number(stack, id, *value),
        Expr::Imaginary(value) => {
            tree.number(stack, id, *value);
            stack.push(Text("i"));
        }
        Expr::Name(name) => stack.push(Text(&name.text)),
        Expr::Unary { op, arg } => match op {
            UnaryOp::Neg => stack.extend([Text("-"), at(*arg, Level::Prefix)]),
            UnaryOp::Not => stack.extend([Text("not "), at(*arg, Level::Not)]),
            UnaryOp::Sqrt => stack.extend([Text("√"), at(*arg, Level::Prefix)]),
            UnaryOp::Factorial => stack.extend([at(*arg, Level::Postfix), Text("!")]),
            UnaryOp::Abs => {
                stack.extend([Text("|"), Work::Expr(*arg, Level::If, true), Text("|")]);
            }
        },
        Expr::Binary { op, lhs, rhs } => {
            let (sign, left, right) = match op {
                BinaryOp::Or => (" or ", Level::Or, Level::And),
                BinaryOp::And => (" and ", Level::And, Level::Not),
                BinaryOp::Add => (" + ", Level::Sum, Level::Product),
                BinaryOp::Sub => (" - ", Level::Sum, Level::Product),
                BinaryOp::Mul => (" * ", Level::Product, Level::Prefix),
                BinaryOp::Div => (" / ", Level::Product, Level::Prefix),
                BinaryOp::ImplicitMul => (" ", Level::Product, Level::Power),
                BinaryOp::Pow => ("^", Level::Postfix, Level::Prefix),
            };
            let is_division = matches!(
                exprs[*lhs],
                Expr::Binary {
                    op: BinaryOp::Div,
                    ..
                }
            );
            let (left, right) = if *op == BinaryOp::ImplicitMul {
                // `1 / 2 x` reads well, but with a warning.
                let left = if ends_applied(exprs, *lhs) && begins_bracketed(exprs, *rhs) {
                    Level::Postfix
                } else if is_division {
                    Level::Prefix
                } else {
                    left
                };
                (left, Work::Factor(*rhs, in_bars))
            } else {
                (left, at(*rhs, right))
            };
            stack.extend([at(*lhs, left), Text(sign), right]);
        }
        Expr::Compare { first, rest } => {
            stack.push(at(*first, Level::Sum));
            for &(op, operand) in rest {
                stack.extend([Text(comparison(op)), at(operand, Level::Sum)]);
            }
        }
        Expr::Call {
            callee,
            primes,
            args,
        } => {
            stack.push(Text(&callee.text));
            stack.extend((0..*primes).map(|_| Text("'")));
            list(stack, args);
        }
        Expr::Member { base, field } => {
            // `2.x` would look like a number, and `np.x` like a name of NumPy.
            let looks_otherwise = match &exprs[*base] {
                Expr::Number(_) | Expr::Imaginary(_) => true,
                Expr::Name(name) => is_namespace(&name.text),
                _ => false,
            };
            if looks_otherwise {
                stack.extend([Text("("), at(*base, Level::Where), Text(")")]);
            } else {
                stack.push(at(*base, Level::Postfix));
            }
            stack.extend([Text("."), Text(&field.text)]);
        }
        Expr::Vector(items) => list(stack, items),
        Expr::If {
            cond,
            then,
            otherwise,
        } => stack.extend([
            Text("if "),
            at(*cond, Level::If),
            Text(" then "),
            at(*then, Level::If),
            Text(" else "),
            at(*otherwise, Level::If),
        ]),
        Expr::Piecewise { arms, otherwise } => {
            let inside = |id| Work::Expr(id, Level::If, false);
            stack.push(Text("{ "));
            for (index, &(cond, value)) in arms.iter().enumerate() {
                if index > 0 {
                    stack.push(Text(", "));
                }
                stack.extend([inside(cond), Text(": "), inside(value)]);
            }
            if let Some(value) = otherwise {
                let word = if arms.is_empty() {
                    "else: "
                } else {
                    ", else: "
                };
                stack.extend([Text(word), inside(*value)]);
            }
            stack.push(Text(" }"));
        }
        Expr::Where { body, locals } => {
            stack.push(at(*body, Level::Where));
            for (index, local) in locals.iter().enumerate() {
                let word = if index == 0 { " where " } else { ", " };
                stack.extend([Text(word), Text(&local.name.text)]);
                if let Some(field) = &local.field {
                    stack.extend([Text("."), Text(&field.text)]);
                }
                stack.extend([Text(" = "), at(local.value, Level::If)]);
            }
        }
        Expr::Series { kind, ranges, term } => {
            stack.push(Text(match kind {
                SeriesKind::Sum => "sum(",
                SeriesKind::Product => "product(",
            }));
            for found in ranges {
                range(stack, found);
                stack.push(Text(", "));
            }
            stack.extend([Work::Expr(*term, Level::If, false), Text(")")]);
        }
        Expr::Iterate {
            count,
            states,
            steps,
            until,
        } => {
            let inside = |id| Work::Expr(id, Level::If, false);
            stack.extend([Text("iterate("), inside(*count)]);
            for (name, start) in states {
                stack.extend([Text(", "), Text(&name.text), Text(" = "), inside(*start)]);
            }
            for &step in steps {
                stack.extend([Text(", "), inside(step)]);
            }
            if let Some(until) = until {
                stack.extend([Text(" until "), inside(*until)]);
            }
            stack.push(Text(")"));
        }
        Expr::Integral {
            method,
            body,
            range: found,
        } => {
            stack.extend([Text(method.word()), Text("(")]);
            range(stack, found);
            stack.extend([Text(", "), Work::Expr(*body, Level::If, false), Text(")")]);
        }
    }
    if let Some(added) = stack.get_mut(base..) {
        added.reverse();
    }
}

/// `name in lower..upper`
fn range<'a>(stack: &mut Vec<Work<'a>>, range: &'a Range) {
    stack.extend([
        Work::Text(&range.name.text),
        Work::Text(" in "),
        Work::Expr(range.lower, Level::If, false),
        Work::Text(".."),
        Work::Expr(range.upper, Level::If, false),
    ]);
}

/// `(a, b)`
fn list(stack: &mut Vec<Work<'_>>, items: &[ExprId]) {
    stack.push(Work::Text("("));
    for (index, &item) in items.iter().enumerate() {
        if index > 0 {
            stack.push(Work::Text(", "));
        }
        stack.push(Work::Expr(item, Level::If, false));
    }
    stack.push(Work::Text(")"));
}

fn comparison(op: CompareOp) -> &'static str {
    match op {
        CompareOp::Less => " < ",
        CompareOp::LessEqual => " <= ",
        CompareOp::Greater => " > ",
        CompareOp::GreaterEqual => " >= ",
        CompareOp::Equal => " == ",
        CompareOp::NotEqual => " != ",
    }
}

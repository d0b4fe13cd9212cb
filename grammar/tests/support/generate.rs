//! Random programs, the same for the same seed: trees as the parser makes them, of every kind of statement and node.
//!
//! A tree that a text can have calls only what is a function at that place, so names and what hides them are kept
//! track of here as the language has it.

use pullback_grammar::Span;
use pullback_grammar::ast::{
    BinaryOp, CompareOp, Constant, Expr, ExprId, File, Formal, Formula, Function, Item, Local,
    Method, Name, Param, Range, SeriesKind, Setting, Show, UnaryOp,
};
use pullback_grammar::token::tokenize;

use super::is_function;

const VALUES: [&str; 16] = [
    "x", "y", "z", "p", "a", "b", "k", "t", "π", "i", "e", "time", "α₁", "unknown", "∞", "x_2",
];
/// Names of functions, of operators and of forms; all may be hidden.
const FUNCTIONS: [&str; 16] = [
    "f",
    "g",
    "sin",
    "max",
    "length",
    "nowhere",
    "grad",
    "diff",
    "laplacian",
    "mean_curvature",
    "quadrature",
    "sum",
    "product",
    "iterate",
    "integral",
    "h₁",
];
const OPERATORS: [&str; 4] = ["grad", "diff", "laplacian", "mean_curvature"];
const FORMS: [&str; 5] = ["sum", "product", "iterate", "integral", "quadrature"];

/// SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014).
pub struct Random(u64);

impl Random {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// One of `0..count`.
    pub fn below(&mut self, count: usize) -> usize {
        usize::try_from(self.bits() >> 33).unwrap_or(0) % count
    }

    /// True once in `count` times.
    pub fn once_in(&mut self, count: usize) -> bool {
        self.below(count) == 0
    }

    fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }
}

/// A program.
pub fn program(random: &mut Random) -> File {
    let mut maker = Maker {
        random,
        file: File::default(),
        functions: Vec::new(),
        constants: Vec::new(),
        bound: Vec::new(),
    };
    maker.program();
    maker.file
}

struct Maker<'r> {
    random: &'r mut Random,
    file: File,
    functions: Vec<&'static str>,
    constants: Vec<&'static str>,
    /// Names that hold here.
    bound: Vec<&'static str>,
}

fn name(text: &str) -> Name {
    Name {
        text: text.to_owned(),
        span: Span::default(),
    }
}

impl Maker<'_> {
    fn program(&mut self) {
        for _ in 0..self.random.below(3) {
            let name = self.random.pick(&FUNCTIONS);
            if !self.functions.contains(&name) {
                self.functions.push(name);
            }
        }
        for _ in 0..self.random.below(2) {
            let name = self.bindable();
            if !self.functions.contains(&name) && !self.constants.contains(&name) {
                self.constants.push(name);
            }
        }
        for name in self.functions.clone() {
            let item = self.function(name);
            self.add(item);
        }
        for name in self.constants.clone() {
            let item = if self.random.once_in(2) {
                self.param(name)
            } else {
                let (name, value) = (self::name(name), self.expr(4));
                let span = Span::default();
                Item::Constant(Constant { name, value, span })
            };
            self.add(item);
        }
        for index in 0..1 + self.random.below(2) {
            let item = if index > 0 && self.random.once_in(2) {
                self.show()
            } else {
                let size = self.random.below(11);
                let body = self.expr(size);
                let span = Span::default();
                Item::Formula(Formula { body, span })
            };
            self.add(item);
        }
    }

    /// Puts a statement somewhere among the others.
    fn add(&mut self, item: Item) {
        let at = self.random.below(self.file.items.len() + 1);
        self.file.items.insert(at, item);
    }

    fn function(&mut self, name: &'static str) -> Item {
        let formals: Vec<&str> = (0..self.random.below(4)).map(|_| self.bindable()).collect();
        let params = formals
            .iter()
            .map(|text| Formal {
                name: self::name(text),
                ty: (self.random.once_in(3)).then(|| self::name("vec3")),
            })
            .collect();
        let size = self.random.below(8);
        let body = self.within(&formals, |maker| maker.expr(size));
        Item::Function(Function {
            name: self::name(name),
            params,
            body,
            span: Span::default(),
        })
    }

    fn param(&mut self, name: &str) -> Item {
        let default = self.expr(2);
        let range = (self.random.once_in(2)).then(|| (self.expr(2), self.expr(2)));
        Item::Param(Param {
            name: self::name(name),
            default,
            range,
            span: Span::default(),
        })
    }

    fn show(&mut self) -> Item {
        let args = (0..1 + self.random.below(2))
            .map(|_| self.subject(4))
            .collect();
        let settings = (0..self.random.below(3))
            .map(|_| {
                let is_range = self.random.once_in(2);
                Setting {
                    name: name(self.random.pick(&["box", "range", "k", "sin"])),
                    value: if is_range {
                        self.expr(3)
                    } else {
                        self.subject(3)
                    },
                    upper: is_range.then(|| self.expr(3)),
                }
            })
            .collect();
        Item::Show(Show {
            scene: name(self.random.pick(&["surface", "levels"])),
            args,
            settings,
            span: Span::default(),
        })
    }

    /// An expression or the bare name of a function.
    fn subject(&mut self, size: usize) -> ExprId {
        let function = self.random.pick(&FUNCTIONS);
        if self.random.once_in(2) && self.is_known_function(function) {
            return self.push(Expr::Name(name(function)));
        }
        self.expr(size)
    }

    fn push(&mut self, expr: Expr) -> ExprId {
        self.file.exprs.push(expr, Span::default())
    }

    /// A name that a local, a parameter, a state or a constant may have.
    fn bindable(&mut self) -> &'static str {
        if self.random.once_in(4) {
            self.random.pick(&FUNCTIONS)
        } else {
            self.random.pick(&VALUES[..8])
        }
    }

    /// Whether nothing makes a value of this name here.
    fn is_callable(&self, name: &str) -> bool {
        !self.bound.contains(&name)
            && (self.functions.contains(&name) || !self.constants.contains(&name))
    }

    fn is_known_function(&self, name: &str) -> bool {
        let is_own = OPERATORS.contains(&name) || FORMS.contains(&name) || is_function(name);
        self.is_callable(name) && (is_own || self.functions.contains(&name))
    }

    /// Whether the name of a form or operator has its own meaning here.
    fn is_own(&self, name: &str) -> bool {
        self.is_callable(name) && !self.functions.contains(&name)
    }

    /// Makes something where these names hold.
    fn within<T>(&mut self, names: &[&'static str], make: impl FnOnce(&mut Self) -> T) -> T {
        let before = self.bound.len();
        self.bound.extend_from_slice(names);
        let made = make(self);
        self.bound.truncate(before);
        made
    }

    fn several(&mut self, count: usize, size: usize) -> Vec<ExprId> {
        (0..count).map(|_| self.expr(size / count)).collect()
    }

    fn leaf(&mut self) -> Expr {
        match self.random.below(8) {
            0 => Expr::Number(self.number()),
            1 => Expr::Imaginary(self.number()),
            2 | 3 => Expr::Number(f64::from(u8::try_from(self.random.below(100)).unwrap_or(0))),
            4 => {
                let text = self.random.pick(&FUNCTIONS);
                let is_value = !self.is_callable(text);
                Expr::Name(name(if is_value { text } else { "y" }))
            }
            _ => Expr::Name(name(self.random.pick(&VALUES))),
        }
    }

    fn number(&mut self) -> f64 {
        let any = f64::from_bits(self.random.bits()).abs();
        if self.random.once_in(4) && any.is_finite() {
            any
        } else {
            self.random.pick(&[0.0, 0.25, 1.5, 1e-7, 1e20])
        }
    }

    /// An expression of about `size` nodes.
    fn expr(&mut self, size: usize) -> ExprId {
        let expr = if size == 0 {
            self.leaf()
        } else {
            self.node(size - 1)
        };
        self.push(expr)
    }

    fn node(&mut self, size: usize) -> Expr {
        match self.random.below(24) {
            0..4 => self.unary(size),
            4..11 => self.binary(size),
            11 => self.compare(size),
            12..14 => self.call(size),
            14 => Expr::Member {
                base: self.expr(size),
                field: name(self.random.pick(&["x", "xy", "zyx", "count"])),
            },
            15 => {
                let count = 2 + self.random.below(3);
                Expr::Vector(self.several(count, size))
            }
            16 => {
                let parts = self.several(3, size);
                Expr::If {
                    cond: parts[0],
                    then: parts[1],
                    otherwise: parts[2],
                }
            }
            17 => self.piecewise(size),
            18 | 19 => self.locals(size),
            20 => self.series(size),
            21 => self.iterate(size),
            22 => self.integral(size),
            _ => self.leaf(),
        }
    }

    fn unary(&mut self, size: usize) -> Expr {
        use UnaryOp::{Abs, Factorial, Neg, Not, Sqrt};
        let op = self.random.pick(&[Neg, Not, Sqrt, Factorial, Abs]);
        let arg = self.expr(size);
        Expr::Unary { op, arg }
    }

    fn binary(&mut self, size: usize) -> Expr {
        use BinaryOp::{Add, And, Div, ImplicitMul, Mul, Or, Pow, Sub};
        let op = (self.random).pick(&[Add, Sub, Mul, ImplicitMul, ImplicitMul, Div, Pow, And, Or]);
        let (lhs, rhs) = (self.expr(size / 2), self.expr(size - size / 2));
        Expr::Binary { op, lhs, rhs }
    }

    fn compare(&mut self, size: usize) -> Expr {
        use CompareOp::{Equal, Greater, GreaterEqual, Less, LessEqual, NotEqual};
        let first = self.expr(size / 2);
        let rest = (0..1 + self.random.below(2))
            .map(|_| {
                let op =
                    (self.random).pick(&[Equal, Greater, GreaterEqual, Less, LessEqual, NotEqual]);
                (op, self.expr(size / 4))
            })
            .collect();
        Expr::Compare { first, rest }
    }

    fn call(&mut self, size: usize) -> Expr {
        let callee = self.random.pick(&FUNCTIONS);
        let is_form = FORMS.contains(&callee) && self.is_own(callee);
        if is_form || !self.is_callable(callee) {
            return self.unary(size);
        }
        let takes_function = OPERATORS.contains(&callee) && self.is_own(callee);
        let count = self.random.below(4);
        let mut args = Vec::new();
        if takes_function {
            args.push(self.subject(size / (count + 1)));
        }
        args.extend(
            (0..count)
                .map(|_| self.expr(size / (count + 1)))
                .collect::<Vec<_>>(),
        );
        Expr::Call {
            callee: name(callee),
            primes: u32::from(self.random.once_in(4)) * (1 + u32::from(self.random.once_in(2))),
            args,
        }
    }

    fn piecewise(&mut self, size: usize) -> Expr {
        let count = self.random.below(3);
        let arms = (0..count)
            .map(|_| (self.expr(size / 4), self.expr(size / 4)))
            .collect();
        let has_else = count == 0 || self.random.once_in(2);
        let otherwise = has_else.then(|| self.expr(size / 4));
        Expr::Piecewise { arms, otherwise }
    }

    fn locals(&mut self, size: usize) -> Expr {
        let fields = [None, None, Some("x"), Some("zy"), Some("rgba")];
        let names: Vec<_> = (0..1 + self.random.below(3))
            .map(|_| (self.bindable(), self.random.pick(&fields)))
            .collect();
        let new = names.iter().filter(|local| local.1.is_none());
        let bound: Vec<&str> = new.map(|local| local.0).collect();
        self.within(&bound, |maker| {
            let body = maker.expr(size / 2);
            let locals = names
                .iter()
                .map(|&(text, field)| Local {
                    name: name(text),
                    field: field.map(name),
                    value: maker.expr(size / 4),
                })
                .collect();
            Expr::Where { body, locals }
        })
    }

    fn range(&mut self, text: &str, size: usize) -> Range {
        let (lower, upper) = (self.expr(size), self.expr(size));
        let name = name(text);
        Range { name, lower, upper }
    }

    fn series(&mut self, size: usize) -> Expr {
        let kind = self.random.pick(&[SeriesKind::Sum, SeriesKind::Product]);
        let word = match kind {
            SeriesKind::Sum => "sum",
            SeriesKind::Product => "product",
        };
        if !self.is_own(word) {
            return self.binary(size);
        }
        let names: Vec<&str> = (0..1 + self.random.below(2))
            .map(|_| self.bindable())
            .collect();
        let ranges = (0..names.len())
            .map(|index| self.within(&names[..index], |maker| maker.range(names[index], size / 6)))
            .collect();
        let term = self.within(&names, |maker| maker.expr(size / 2));
        Expr::Series { kind, ranges, term }
    }

    fn iterate(&mut self, size: usize) -> Expr {
        if !self.is_own("iterate") {
            return self.binary(size);
        }
        let names: Vec<&str> = (0..1 + self.random.below(3))
            .map(|_| self.bindable())
            .collect();
        let count = self.expr(size / 6);
        let states = names
            .iter()
            .map(|text| (name(text), self.expr(size / 6)))
            .collect();
        self.within(&names, |maker| Expr::Iterate {
            count,
            states,
            steps: maker.several(names.len(), size / 2),
            until: maker.random.once_in(2).then(|| maker.expr(size / 4)),
        })
    }

    fn integral(&mut self, size: usize) -> Expr {
        let method = if self.random.once_in(3) {
            Method::Quadrature
        } else {
            Method::Closed
        };
        if !self.is_own(method.word()) {
            return self.binary(size);
        }
        let text = self.bindable();
        let range = self.range(text, size / 4);
        let body = self.within(&[text], |maker| maker.expr(size / 2));
        Expr::Integral {
            method,
            body,
            range,
        }
    }
}

/// The text of a program with comments and line breaks where they change nothing.
pub fn with_comments(text: &str, random: &mut Random) -> String {
    const INSIDE: [&str; 6] = [", ", " + ", " = ", " where ", " until ", " and "];
    let mut out = String::with_capacity(2 * text.len());
    for line in text.lines() {
        match random.below(6) {
            0 => out.push_str("// a remark: f(x) = (\n"),
            1 => out.push_str("\n\n/* two\nlines { */ "),
            _ => {}
        }
        let mut rest = line;
        while let Some(at) = rest.find(' ') {
            // The character before a blank belongs to the sign around it, as in `, `.
            let start = at.saturating_sub(usize::from(rest[..at].ends_with(',')));
            let sign = INSIDE.iter().find(|sign| rest[start..].starts_with(**sign));
            let end = start + sign.map_or(at + 1 - start, |sign| sign.len());
            out.push_str(&rest[..end]);
            match random.below(12) {
                0 => out.push_str("/* ) */ "),
                1 if sign.is_some() => out.push_str("# , end\n  "),
                _ => {}
            }
            rest = &rest[end..];
        }
        out.push_str(rest);
        if random.once_in(5) {
            out.push_str(" // behind");
        }
        out.push('\n');
    }
    out
}

/// The text of a program with a few tokens left out, doubled, exchanged or put elsewhere.
pub fn damaged(text: &str, random: &mut Random) -> String {
    let (tokens, _) = tokenize(text);
    let mut words: Vec<&str> = Vec::new();
    let mut end = 0;
    for token in &tokens {
        // The blanks before a token are a word of their own, as some of them matter.
        words.push(&text[end..token.span.start as usize]);
        words.push(token.span.text(text));
        end = token.span.end as usize;
    }
    for _ in 0..1 + random.below(2) {
        let (from, to) = (random.below(words.len()), random.below(words.len()));
        match random.below(5) {
            0 => words[from] = "",
            1 => words[from] = random.pick(&["\n", " ", "(", ")", ",", "=", "k in 1..2,", "until"]),
            2 => words[from] = words[to],
            3 => words.swap(from, to),
            _ => words.insert(to, words[from]),
        }
    }
    words.concat()
}
